// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/scans/placement/section_fit.hpp"

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {

namespace {

constexpr std::size_t kFewestInStrip = 5;
constexpr double kLayer = 6e-3;       // what one strip of one surface spans at most, in v [m]
constexpr double kLeastShare = 0.15;  // of the fullest layer of its strip: a layer is no outlier then

struct Strip {
  double y = 0.0, v = 0.0;
  bool present = false;
};

/// The outermost well-filled layer of the points of a strip, at its middle.
Strip strip_of(std::vector<Vec2>& points, double y_middle) {
  Strip out;
  out.y = y_middle;
  if (points.size() < kFewestInStrip) return out;
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.y() > b.y() || (a.y() == b.y() && a.x() < b.x()); });
  std::vector<std::size_t> inside(points.size());
  std::size_t fullest = 0;
  for (std::size_t i = 0, j = 0; i < points.size(); ++i) {
    while (j < points.size() && points[i].y() - points[j].y() <= kLayer) ++j;
    fullest = std::max(fullest, inside[i] = j - i);
  }
  if (fullest < kFewestInStrip) return out;
  const auto enough = std::max(kFewestInStrip, to_whole<std::size_t>(kLeastShare * static_cast<double>(fullest)));
  std::size_t first = 0;
  while (inside[first] < enough) ++first;
  // on to where the layer is at its fullest, so that a few points above it do not cut it short
  while (first + 1 < points.size() && inside[first + 1] > inside[first]) ++first;
  std::vector<double> all;
  for (std::size_t i = first; i < first + inside[first]; ++i) all.push_back(points[i].y());
  out.v = median_of(all);
  out.present = true;
  return out;
}

/// A point near a section: place within an interval of it (0 to 1), and distance.
struct Near {
  float s = 0.0f, d = 0.0f;
};

/// Points near a section, by the interval in which they have their feet.
class NearPoints {
 public:
  NearPoints(const Section& section, std::span<const Vec2> points, double farthest, std::size_t intervals)
      : begin_(intervals + 1, 0) {
    const double knot = section.length() / static_cast<double>(intervals);
    constexpr std::uint32_t kFar = ~0u;
    constexpr std::size_t kBlock = 4096;
    std::vector<std::pair<std::uint32_t, Near>> all(points.size());
    parallel_blocks(points.size(), kBlock, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        all[i].first = kFar;
        const auto foot = section.foot(points[i], farthest);
        if (!foot) continue;
        const auto cell = std::min(intervals - 1, to_whole<std::size_t>(foot->s / knot));
        all[i] = {static_cast<std::uint32_t>(cell),
                  {static_cast<float>(foot->s / knot - static_cast<double>(cell)), static_cast<float>(foot->distance)}};
      }
    });
    for (const auto& [cell, point] : all)
      if (cell != kFar) ++begin_[cell + 1];
    for (std::size_t k = 0; k < intervals; ++k) begin_[k + 1] += begin_[k];
    sorted_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (const auto& [cell, point] : all)
      if (cell != kFar) sorted_[next[cell]++] = point;
  }

  std::size_t intervals() const { return begin_.size() - 1; }
  std::size_t size() const { return sorted_.size(); }
  std::size_t first(std::size_t interval) const { return begin_[interval]; }
  std::span<const Near> operator[](std::size_t interval) const {
    return {sorted_.data() + begin_[interval], begin_[interval + 1] - begin_[interval]};
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Near> sorted_;
};

/// A uniform cubic spline of distances along a section, fitted robustly (Tukey's weights) to the points near it.
class DistanceSpline {
 public:
  explicit DistanceSpline(const NearPoints& near) : near_(near), intervals_(near.intervals()) {
    begin_with_medians();
    constexpr int kReweights = 6;
    for (int again = 0; again < kReweights; ++again) solve();
  }

  double at(std::size_t interval, double t) const { return sum(interval, cubic_basis(t)); }

  /// Distances of the points from it, without signs; sum of their squares.
  std::vector<double> sizes(double& square) const {
    std::vector<double> out(near_.size()), squares(intervals_, 0.0);
    parallel_for(intervals_, [&](std::size_t interval) {
      double* next = out.data() + near_.first(interval);
      for (const Near& n : near_[interval]) {
        *next = std::fabs(n.d - at(interval, n.s));
        squares[interval] += *next * *next;
        ++next;
      }
    });
    square = std::accumulate(squares.begin(), squares.end(), 0.0);
    return out;
  }

 private:
  struct Sums {
    std::array<double, 16> matrix{};
    std::array<double, 4> rhs{};
  };

  double sum(std::size_t interval, const std::array<double, 4>& b) const {
    double out = 0.0;
    for (std::size_t k = 0; k < 4; ++k) out += b[k] * coefficients_[static_cast<Eigen::Index>(interval + k)];
    return out;
  }

  /// So that damage and outliers do not draw the spline.
  void begin_with_medians() {
    level_.assign(intervals_, 0.0);
    scale_.assign(intervals_, 0.0);
    parallel_for(intervals_, [&](std::size_t k) {
      std::vector<double> d;
      d.reserve(near_[k].size());
      for (const Near& n : near_[k]) d.push_back(n.d);
      if (d.empty()) return;
      const double middle = level_[k] = median_of(d);
      for (double& value : d) value = std::fabs(value - middle);
      scale_[k] = kMad * median_of(d);
    });
    std::vector<double> scales;
    for (std::size_t k = 0; k < intervals_; ++k)
      if (near_[k].size() > 8) scales.push_back(scale_[k]);
    typical_ = scales.empty() ? 0.0 : median_of(scales);
  }

  Sums sums_of(std::size_t interval) const {
    Sums out;
    const bool begun = coefficients_.size() > 0;
    const double width = kTukey * std::max({scale_[interval], 0.5 * typical_, 1e-7});
    for (const Near& n : near_[interval]) {
      const std::array<double, 4> b = cubic_basis(n.s);
      const double r = (n.d - (begun ? sum(interval, b) : level_[interval])) / width;
      if (!(std::fabs(r) < 1.0)) continue;
      const double w = (1.0 - r * r) * (1.0 - r * r);
      for (std::size_t i = 0; i < 4; ++i) {
        out.rhs[i] += w * b[i] * n.d;
        for (std::size_t k = 0; k < 4; ++k) out.matrix[4 * i + k] += w * b[i] * b[k];
      }
    }
    return out;
  }

  void solve() {
    std::vector<Sums> sums(intervals_);
    parallel_for(intervals_, [&](std::size_t interval) { sums[interval] = sums_of(interval); });
    const auto size = static_cast<Eigen::Index>(intervals_ + 3);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(size);
    for (std::size_t interval = 0; interval < intervals_; ++interval) {
      // not segment<4>: GCC 12 loses sums of segments that overlap (-O3)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto row = static_cast<Eigen::Index>(interval + i);
        rhs[row] += sums[interval].rhs[i];
        for (std::size_t k = 0; k < 4; ++k)
          matrix(row, static_cast<Eigen::Index>(interval + k)) += sums[interval].matrix[4 * i + k];
      }
    }
    // second differences bridge strips without points
    const double stiffness = 1e-4 * matrix.trace() / static_cast<double>(size);
    for (Eigen::Index k = 1; k + 1 < size; ++k)
      for (const auto& [a, x] : {std::pair{k - 1, 1.0}, std::pair{k, -2.0}, std::pair{k + 1, 1.0}})
        for (const auto& [c, y] : {std::pair{k - 1, 1.0}, std::pair{k, -2.0}, std::pair{k + 1, 1.0}})
          matrix(a, c) += stiffness * x * y;
    coefficients_ = matrix.ldlt().solve(rhs);
  }

  const NearPoints& near_;
  std::size_t intervals_;
  std::vector<double> level_, scale_;  ///< of the points of an interval
  double typical_ = 0.0;
  Eigen::VectorXd coefficients_;  ///< none before the first solution
};

/// The section moved along its normals; what would fold at badly known ends is left out, from the middle on.
Section moved_along(const Section& section, const DistanceSpline& spline, std::size_t intervals, double farthest) {
  const double knot = section.length() / static_cast<double>(intervals);
  const std::size_t nodes = 2 * intervals;
  std::vector<Vec2> all(nodes + 1);
  for (std::size_t k = 0; k <= nodes; ++k) {
    const double place = static_cast<double>(k) * static_cast<double>(intervals) / static_cast<double>(nodes);
    const auto interval = std::min(intervals - 1, to_whole<std::size_t>(place));
    const double d = spline.at(interval, place - static_cast<double>(interval));
    const Section::Point at = section.at(place * knot);
    all[k] = at.position + std::clamp(d, -farthest, farthest) * at.normal;
  }
  constexpr double kApart = 1e-7;
  std::vector<Vec2> moved;
  for (std::size_t k = nodes / 2 + 1; k-- > 0;)
    if (moved.empty() || all[k].x() < moved.back().x() - kApart) moved.push_back(all[k]);
  std::reverse(moved.begin(), moved.end());
  for (std::size_t k = nodes / 2 + 1; k <= nodes; ++k)
    if (all[k].x() > moved.back().x() + kApart) moved.push_back(all[k]);
  return Section(moved);
}

}  // namespace

Section outline(std::span<const Vec2> points) {
  double y_min = 1e300, y_max = -1e300;
  for (const Vec2& p : points) {
    y_min = std::min(y_min, p.x());
    y_max = std::max(y_max, p.x());
  }
  constexpr double kStrip = 1e-3, kWidest = 2.0;
  const auto refuse = [](const char* why) {
    throw Error(ErrorKind::input_data, fmt::format("the scan has no usable cross-section: {}", why), {},
                "is it a wheel or rail, and is its unit right?");
  };
  if (!(y_max > y_min)) refuse("it is flat");
  if (y_max - y_min > kWidest) {
    // a few far outliers must not make it wide
    y_min = -kWidest;
    y_max = kWidest;
  }
  const auto count = to_whole<std::size_t>(std::ceil((y_max - y_min) / kStrip));
  std::vector<std::vector<Vec2>> in_strip(count + 1);
  for (const Vec2& p : points)
    if (p.x() >= y_min && p.x() <= y_max) in_strip[to_whole<std::size_t>((p.x() - y_min) / kStrip)].push_back(p);
  std::vector<Strip> strips(in_strip.size());
  parallel_for(in_strip.size(), [&](std::size_t k) {
    strips[k] = strip_of(in_strip[k], y_min + kStrip * (static_cast<double>(k) + 0.5));
  });
  // pieces without steps and without gaps
  constexpr std::size_t kLongestGap = 6;  // strips
  const double steep = std::tan(kSteepest);
  std::vector<Vec2> best, piece;
  double best_reach = -1e300;
  std::size_t last = 0;
  constexpr std::size_t kShortest = 12;
  const auto close = [&] {
    if (piece.size() >= kShortest) {
      double reach = -1e300;
      for (const Vec2& p : piece) reach = std::max(reach, p.y());
      if (reach > best_reach) {
        best_reach = reach;
        best = piece;
      }
    }
    piece.clear();
  };
  for (std::size_t k = 0; k < strips.size(); ++k) {
    if (!strips[k].present) continue;
    const bool goes_on = !piece.empty() && k - last <= kLongestGap &&
                         std::fabs(strips[k].v - piece.back().y()) <= steep * (strips[k].y - piece.back().x());
    if (!piece.empty() && !goes_on) close();
    piece.emplace_back(strips[k].y, strips[k].v);
    last = k;
  }
  close();
  if (best.empty()) refuse("nothing in it is wider than 12 mm");
  return Section(best);
}

SectionFit fit_section(const Section& start, std::span<const Vec2> points, double farthest, double knot_spacing,
                       int rounds) {
  SectionFit out;
  out.section = start;
  for (int round = 0; round < rounds; ++round) {
    const auto intervals = to_whole<std::size_t>(std::max(2.0, std::round(out.section.length() / knot_spacing)));
    const NearPoints near(out.section, points, farthest, intervals);
    if (near.size() < 4 * intervals)
      throw Error(ErrorKind::input_data, "too few points follow the cross-section of the scan", {},
                  "is it a wheel or rail?");
    const DistanceSpline spline(near);
    double square = 0.0;
    std::vector<double> sizes = spline.sizes(square);
    out.used = near.size();
    out.spread = std::sqrt(square / static_cast<double>(near.size()));
    out.scale = kMad * median_of(sizes);
    out.section = moved_along(out.section, spline, intervals, farthest);
  }
  return out;
}

}  // namespace treadmark::scans
