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

}  // namespace

Section refine_section(const BandPoints& points, const Band& band, double finest, double* moved) {
  const double length = band.section.length();
  const auto count = to_whole<std::size_t>(std::ceil(length / kStrip));
  std::vector<std::vector<Strip>> inside(count);
  // parts of the band that were scanned more densely, as a damage often is, must not count more
  const auto block_rows = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(kBlock / points.cell_a)));
  const std::size_t blocks = (points.rows + block_rows - 1) / block_rows;
  std::vector<std::uint32_t> in_block(blocks * count, 0);
  const auto each_point = [&](const auto& visit) {
    for (std::size_t row = 0; row < points.rows; ++row)
      for (std::size_t i = points.first(row, 0); i < points.begin[(row + 1) * points.columns]; ++i)
        if (points.state[i] != PointState::off_band)
          visit(row / block_rows, std::min(count - 1, to_whole<std::size_t>(points.s[i] / kStrip)), i);
  };
  each_point([&](std::size_t block, std::size_t strip, std::size_t) { ++in_block[block * count + strip]; });
  std::vector<std::uint32_t> usual(count, 0), counts;
  for (std::size_t k = 0; k < count; ++k) {
    counts.clear();
    for (std::size_t b = 0; b < blocks; ++b)
      if (in_block[b * count + k] > 0) counts.push_back(in_block[b * count + k]);
    if (counts.empty()) continue;
    usual[k] = median_of(counts);
  }
  std::vector<std::uint32_t> number(in_block.size(), 0);
  each_point([&](std::size_t block, std::size_t strip, std::size_t i) {
    const std::size_t cell = block * count + strip;
    if (number[cell]++ % (in_block[cell] / (2 * usual[strip]) + 1) == 0)
      inside[strip].push_back({points.s[i], points.d[i], 0.0});
  });
  std::vector<Strip> strips(count);
  parallel_for(count, [&](std::size_t k) { strips[k] = strip_of(inside[k]); });
  inside.clear();

  std::vector<SplineLevel> levels;
  SplineField field(1.0, length, false);
  std::vector<double> residual(count);
  for (std::size_t k = 0; k < count; ++k) residual[k] = strips[k].d;
  auto intervals = to_whole<std::size_t>(std::max(1.0, std::round(length / kCoarsest)));
  // beside the noise of the points there is what they are off in company along the whole band, which no number of them
  // averages out
  constexpr double kSystematic = 0.05e-6;
  for (; length / static_cast<double>(intervals) > 0.7 * std::max(finest, 4.0 * kStrip); intervals *= 2) {
    const double knot = length / static_cast<double>(intervals);
    const auto size = static_cast<Eigen::Index>(intervals + 3);
    Eigen::VectorXd wbr = Eigen::VectorXd::Zero(size), wbb = Eigen::VectorXd::Zero(size);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    const auto each = [&](const auto& body) {
      for (std::size_t k = 0; k < count; ++k) {
        if (!(strips[k].weight > 0.0)) continue;
        const double at = std::clamp(strips[k].s / knot, 0.0, static_cast<double>(intervals));
        const auto interval = std::min(intervals - 1, static_cast<std::size_t>(at));
        body(k, static_cast<Eigen::Index>(interval), cubic_basis(at - static_cast<double>(interval)),
             1.0 / (1.0 / strips[k].weight + kSystematic * kSystematic));
      }
    };
    each([&](std::size_t k, Eigen::Index first, const std::array<double, 4>& b, double w) {
      for (Eigen::Index i = 0; i < 4; ++i) {
        wbr[first + i] += w * b[static_cast<std::size_t>(i)] * residual[k];
        wbb[first + i] += w * b[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(i)];
        for (Eigen::Index j = 0; j < 4; ++j)
          matrix(first + i, first + j) += w * b[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(j)];
      }
    });
    // chosen: beyond what the largest of so many normal numbers reaches, with its neighbours
    const double most = 2.0 * std::log(static_cast<double>(size)) + 6.0;
    std::vector<bool> active(static_cast<std::size_t>(size), false);
    double chosen = 0.0, signal = 0.0, seen = 0.0;
    for (Eigen::Index f = 0; f < size; ++f) {
      if (!(wbb[f] > 0.0) || wbr[f] * wbr[f] / wbb[f] < most) continue;
      chosen += 1.0;
      signal += wbr[f] * wbr[f] / wbb[f] - 1.0;
      seen += wbb[f];
      for (Eigen::Index g = std::max<Eigen::Index>(0, f - 2); g <= std::min(size - 1, f + 2); ++g)
        active[static_cast<std::size_t>(g)] = true;
    }
    if (chosen == 0.0) continue;
    const double ridge = 0.01 * seen / signal;
    Eigen::VectorXd rhs = wbr;
    for (Eigen::Index f = 0; f < size; ++f) {
      matrix(f, f) += ridge;
      if (active[static_cast<std::size_t>(f)]) continue;
      matrix.row(f).setZero();
      matrix.col(f).setZero();
      matrix(f, f) = 1.0;
      rhs[f] = 0.0;
    }
    const Eigen::VectorXd c = matrix.ldlt().solve(rhs);
    SplineLevel level;
    level.intervals_a = 1;
    level.intervals_s = intervals;
    level.knot_a = 1.0;
    level.knot_s = knot;
    // the same along the band
    for (std::size_t i = 0; i < 4; ++i)
      for (Eigen::Index f = 0; f < size; ++f) level.coefficient.push_back(static_cast<float>(c[f]));
    level.active.assign(level.coefficient.size(), 1);
    each([&](std::size_t k, Eigen::Index first, const std::array<double, 4>& b, double) {
      for (Eigen::Index i = 0; i < 4; ++i) residual[k] -= b[static_cast<std::size_t>(i)] * c[first + i];
    });
    field.add(std::move(level));
  }
  double largest = 0.0;
  std::vector<Vec2> nodes;
  if (!field.levels().empty()) {
    const auto steps = to_whole<std::size_t>(std::ceil(length / kStrip));
    for (std::size_t k = 0; k <= steps; ++k) {
      const double s = length * static_cast<double>(k) / static_cast<double>(steps), d = field.value(0.5, s);
      const Section::Point at = band.section.at(s);
      nodes.emplace_back(at.position + d * at.normal);
      largest = std::max(largest, std::fabs(d));
    }
    // from the middle on, so that a wall, as worn flanks may be, stays one that hardly leans
    constexpr double kApart = 1e-7;
    const std::size_t middle = nodes.size() / 2;
    for (std::size_t k = middle + 1; k < nodes.size(); ++k)
      nodes[k].x() = std::max(nodes[k].x(), nodes[k - 1].x() + kApart);
    for (std::size_t k = middle; k-- > 0;) nodes[k].x() = std::min(nodes[k].x(), nodes[k + 1].x() - kApart);
  }
  if (moved != nullptr) *moved = largest;
  return nodes.empty() ? band.section : Section(nodes);
}

}  // namespace treadmark::scans
