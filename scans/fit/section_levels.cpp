// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/section_levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Cholesky>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/fit/spline_field.hpp"

namespace treadmark::scans {
namespace {

constexpr double kStrip = 0.25e-3;   // [m]
constexpr double kBlock = 16e-3;     // along the band, in which points are evened out [m]
constexpr double kCoarsest = 32e-3;  // knots [m]

struct Strip {
  double s = 0.0, d = 0.0;  ///< mean place and distance
  double weight = 0.0;      ///< 1/variance of d
};

Strip strip_of(std::vector<Strip>& inside) {
  Strip out;
  constexpr std::size_t kFewest = 8;
  if (inside.size() < kFewest) return out;
  std::vector<double> sizes;
  for (const Strip& p : inside) sizes.push_back(p.d);
  double level = median_of(sizes);
  for (std::size_t k = 0; k < sizes.size(); ++k) sizes[k] = std::fabs(inside[k].d - level);
  const double scale = std::max(kMad * median_of(sizes), 1e-8);
  for (int round = 0; round < 10; ++round) {
    double w_sum = 0.0, d_sum = 0.0, s_sum = 0.0, square = 0.0, slope = 0.0;
    for (const Strip& p : inside) {
      const double x = (p.d - level) / (kTukey * scale);
      if (!(std::fabs(x) < 1.0)) continue;
      const double w = (1.0 - x * x) * (1.0 - x * x);
      w_sum += w;
      d_sum += w * p.d;
      s_sum += w * p.s;
      square += w * w * (p.d - level) * (p.d - level);
      slope += (1.0 - x * x) * (1.0 - 5.0 * x * x);
    }
    const double next = d_sum / w_sum;
    out.s = s_sum / w_sum;
    out.d = next;
    // variance of an M-estimate (Huber 1981)
    out.weight = slope > 0.0 && square > 0.0 ? slope * slope / square : 0.0;
    if (std::fabs(next - level) < 1e-10) break;
    level = next;
  }
  return out;
}

/// Strips across the band. Parts of it that were scanned more densely, as a damage often is, must not count more.
std::vector<Strip> strips_of(const BandPoints& points, std::size_t count) {
  const auto block_rows = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(kBlock / points.cell_a)));
  const std::size_t blocks = (points.rows + block_rows - 1) / block_rows;
  const auto each_point = [&](const auto& visit) {
    for (std::size_t row = 0; row < points.rows; ++row)
      for (std::size_t i = points.first(row, 0); i < points.begin[(row + 1) * points.columns]; ++i)
        if (points.state[i] != PointState::off_band)
          visit(row / block_rows, std::min(count - 1, to_whole<std::size_t>(points.s[i] / kStrip)), i);
  };
  std::vector<std::uint32_t> in_block(blocks * count, 0), usual(count, 0), counts;
  each_point([&](std::size_t block, std::size_t strip, std::size_t) { ++in_block[block * count + strip]; });
  for (std::size_t k = 0; k < count; ++k) {
    counts.clear();
    for (std::size_t b = 0; b < blocks; ++b)
      if (in_block[b * count + k] > 0) counts.push_back(in_block[b * count + k]);
    if (!counts.empty()) usual[k] = median_of(counts);
  }
  std::vector<std::vector<Strip>> inside(count);
  std::vector<std::uint32_t> number(in_block.size(), 0);
  each_point([&](std::size_t block, std::size_t strip, std::size_t i) {
    const std::size_t cell = block * count + strip;
    if (number[cell]++ % (in_block[cell] / (2 * usual[strip]) + 1) == 0)
      inside[strip].push_back({points.s[i], points.d[i], 0.0});
  });
  std::vector<Strip> out(count);
  parallel_for(count, [&](std::size_t k) { out[k] = strip_of(inside[k]); });
  return out;
}

/// Splines across the band from coarse to fine, each fitted to what the coarser ones leave of the strips.
class StripFit {
 public:
  StripFit(std::vector<Strip> strips, double length)
      : strips_(std::move(strips)), length_(length), field_(1.0, length, false) {
    for (const Strip& strip : strips_) residual_.push_back(strip.d);
  }

  const SplineField& field() const { return field_; }

  void add(std::size_t intervals) {
    intervals_ = intervals;
    knot_ = length_ / static_cast<double>(intervals);
    sum_up();
    const Eigen::VectorXd c = solved();
    if (c.size() == 0) return;
    SplineLevel level;
    level.intervals_a = 1;
    level.intervals_s = intervals;
    level.knot_a = 1.0;
    level.knot_s = knot_;
    // the same along the band
    for (std::size_t i = 0; i < 4; ++i)
      for (const double value : c) level.coefficient.push_back(static_cast<float>(value));
    level.active.assign(level.coefficient.size(), 1);
    each_strip([&](std::size_t k, Eigen::Index first, const Eigen::Vector4d& b, double) {
      for (Eigen::Index i = 0; i < 4; ++i) residual_[k] -= b[i] * c[first + i];
    });
    field_.add(std::move(level));
  }

 private:
  /// Calls visit(number, first function, values of functions, weight).
  template <class Visit>
  void each_strip(const Visit& visit) const {
    // beside the noise of the points there is what they are off in company along the whole band, which no number of
    // them averages out
    constexpr double kSystematic = 0.05e-6;
    for (std::size_t k = 0; k < strips_.size(); ++k) {
      if (!(strips_[k].weight > 0.0)) continue;
      const double at = std::clamp(strips_[k].s / knot_, 0.0, static_cast<double>(intervals_));
      const auto interval = std::min(intervals_ - 1, to_whole<std::size_t>(at));
      visit(k, static_cast<Eigen::Index>(interval),
            Eigen::Vector4d(cubic_basis(at - static_cast<double>(interval)).data()),
            1.0 / (1.0 / strips_[k].weight + kSystematic * kSystematic));
    }
  }

  void sum_up() {
    const auto size = static_cast<Eigen::Index>(intervals_ + 3);
    wbr_ = wbb_ = Eigen::VectorXd::Zero(size);
    matrix_ = Eigen::MatrixXd::Zero(size, size);
    each_strip([&](std::size_t k, Eigen::Index first, const Eigen::Vector4d& b, double w) {
      for (Eigen::Index i = 0; i < 4; ++i) {
        wbr_[first + i] += w * b[i] * residual_[k];
        wbb_[first + i] += w * b[i] * b[i];
        for (Eigen::Index j = 0; j < 4; ++j) matrix_(first + i, first + j) += w * b[i] * b[j];
      }
    });
  }

  /// Coefficients of the functions beyond what the largest of so many normal numbers reaches, and of their neighbours;
  /// empty where there are none.
  Eigen::VectorXd solved() {
    const Eigen::Index size = wbr_.size();
    const double most = 2.0 * std::log(static_cast<double>(size)) + 6.0;
    std::vector<bool> active(static_cast<std::size_t>(size), false);
    double chosen = 0.0, signal = 0.0, seen = 0.0;
    for (Eigen::Index f = 0; f < size; ++f) {
      if (!(wbb_[f] > 0.0) || wbr_[f] * wbr_[f] / wbb_[f] < most) continue;
      chosen += 1.0;
      signal += wbr_[f] * wbr_[f] / wbb_[f] - 1.0;
      seen += wbb_[f];
      for (Eigen::Index g = std::max<Eigen::Index>(0, f - 2); g <= std::min(size - 1, f + 2); ++g)
        active[static_cast<std::size_t>(g)] = true;
    }
    if (chosen == 0.0) return {};
    const double ridge = 0.01 * seen / signal;
    for (Eigen::Index f = 0; f < size; ++f) {
      matrix_(f, f) += ridge;
      if (active[static_cast<std::size_t>(f)]) continue;
      matrix_.row(f).setZero();
      matrix_.col(f).setZero();
      matrix_(f, f) = 1.0;
      wbr_[f] = 0.0;
    }
    return matrix_.ldlt().solve(wbr_);
  }

  std::vector<Strip> strips_;
  double length_, knot_ = 0.0;
  SplineField field_;
  std::vector<double> residual_;
  std::size_t intervals_ = 0;
  Eigen::VectorXd wbr_, wbb_;  ///< of the functions, weights times: themselves times residuals, their squares
  Eigen::MatrixXd matrix_;
};

/// The section moved along its normals; moved: by how much at most.
Section moved_by(const SplineField& field, const Section& section, double& moved) {
  std::vector<Vec2> nodes;
  const double length = section.length();
  const auto steps = to_whole<std::size_t>(std::ceil(length / kStrip));
  for (std::size_t k = 0; k <= steps; ++k) {
    const double s = length * static_cast<double>(k) / static_cast<double>(steps), d = field.value(0.5, s);
    const Section::Point at = section.at(s);
    nodes.emplace_back(at.position + d * at.normal);
    moved = std::max(moved, std::fabs(d));
  }
  // from the middle on, so that a wall, as worn flanks may be, stays one that hardly leans
  constexpr double kApart = 1e-7;
  const std::size_t middle = nodes.size() / 2;
  for (std::size_t k = middle + 1; k < nodes.size(); ++k)
    nodes[k].x() = std::max(nodes[k].x(), nodes[k - 1].x() + kApart);
  for (std::size_t k = middle; k-- > 0;) nodes[k].x() = std::min(nodes[k].x(), nodes[k + 1].x() - kApart);
  return Section(nodes);
}

}  // namespace

Section refine_section(const BandPoints& points, const Band& band, double finest, double* moved) {
  const double length = band.section.length();
  StripFit fit(strips_of(points, to_whole<std::size_t>(std::ceil(length / kStrip))), length);
  auto intervals = to_whole<std::size_t>(std::max(1.0, std::round(length / kCoarsest)));
  for (; length / static_cast<double>(intervals) > 0.7 * std::max(finest, 4.0 * kStrip); intervals *= 2)
    fit.add(intervals);
  double largest = 0.0;
  Section out = fit.field().levels().empty() ? band.section : moved_by(fit.field(), band.section, largest);
  if (moved != nullptr) *moved = largest;
  return out;
}

}  // namespace treadmark::scans
