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
  const auto enough = std::max(kFewestInStrip, static_cast<std::size_t>(kLeastShare * static_cast<double>(fullest)));
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

  std::size_t size() const { return sorted_.size(); }
  std::size_t first(std::size_t interval) const { return begin_[interval]; }
  std::span<const Near> operator[](std::size_t interval) const {
    return {sorted_.data() + begin_[interval], begin_[interval + 1] - begin_[interval]};
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Near> sorted_;
};

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
    const double length = out.section.length();
    const auto intervals = to_whole<std::size_t>(std::max(2.0, std::round(length / knot_spacing)));
    const double knot = length / static_cast<double>(intervals);
    const NearPoints near(out.section, points, farthest, intervals);
    if (near.size() < 4 * intervals)
      throw Error(ErrorKind::input_data, "too few points follow the cross-section of the scan", {},
                  "is it a wheel or rail?");
    // medians of the strips to begin with, so that damage and outliers do not draw the spline
    std::vector<double> level(intervals, 0.0), scale(intervals, 0.0);
    parallel_for(intervals, [&](std::size_t k) {
      std::vector<double> d;
      d.reserve(near[k].size());
      for (const Near& n : near[k]) d.push_back(n.d);
      if (d.empty()) return;
      const double middle = level[k] = median_of(d);
      for (double& value : d) value = std::fabs(value - middle);
      scale[k] = kMad * median_of(d);
    });
    std::vector<double> scales;
    scales.reserve(intervals);
    for (std::size_t k = 0; k < intervals; ++k)
      if (near[k].size() > 8) scales.push_back(scale[k]);
    const double typical = scales.empty() ? 0.0 : median_of(scales);
    const auto size = static_cast<Eigen::Index>(intervals + 3);
    Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(size);
    const auto value_at = [&](std::size_t cell, const std::array<double, 4>& b) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k) sum += b[k] * coefficients[static_cast<Eigen::Index>(cell + k)];
      return sum;
    };
    struct Sums {
      std::array<double, 16> matrix{};
      std::array<double, 4> rhs{};
    };
    std::vector<Sums> sums(intervals);
    constexpr int kReweights = 6;
    for (int again = 0; again < kReweights; ++again) {
      parallel_for(intervals, [&](std::size_t cell) {
        Sums own;
        const double width = kTukey * std::max({scale[cell], 0.5 * typical, 1e-7});
        for (const Near& n : near[cell]) {
          const std::array<double, 4> b = cubic_basis(n.s);
          const double r = (n.d - (again == 0 ? level[cell] : value_at(cell, b))) / width;
          if (!(std::fabs(r) < 1.0)) continue;
          const double w = (1.0 - r * r) * (1.0 - r * r);
          for (std::size_t i = 0; i < 4; ++i) {
            own.rhs[i] += w * b[i] * n.d;
            for (std::size_t k = 0; k < 4; ++k) own.matrix[4 * i + k] += w * b[i] * b[k];
          }
        }
        sums[cell] = own;
      });
      Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
      Eigen::VectorXd rhs = Eigen::VectorXd::Zero(size);
      for (std::size_t cell = 0; cell < intervals; ++cell) {
        // not segment<4>: GCC 12 loses sums of segments that overlap (-O3)
        for (std::size_t i = 0; i < 4; ++i) {
          const auto row = static_cast<Eigen::Index>(cell + i);
          rhs[row] += sums[cell].rhs[i];
          for (std::size_t k = 0; k < 4; ++k)
            matrix(row, static_cast<Eigen::Index>(cell + k)) += sums[cell].matrix[4 * i + k];
        }
      }
      // second differences bridge strips without points
      const double stiffness = 1e-4 * matrix.trace() / static_cast<double>(size);
      for (Eigen::Index k = 1; k + 1 < size; ++k)
        for (const auto& [a, x] : {std::pair{k - 1, 1.0}, std::pair{k, -2.0}, std::pair{k + 1, 1.0}})
          for (const auto& [c, y] : {std::pair{k - 1, 1.0}, std::pair{k, -2.0}, std::pair{k + 1, 1.0}})
            matrix(a, c) += stiffness * x * y;
      coefficients = matrix.ldlt().solve(rhs);
    }
    std::vector<double> sizes(near.size()), squares(intervals, 0.0);
    parallel_for(intervals, [&](std::size_t cell) {
      double* at = sizes.data() + near.first(cell);
      for (const Near& n : near[cell]) {
        *at = std::fabs(n.d - value_at(cell, cubic_basis(n.s)));
        squares[cell] += *at * *at;
        ++at;
      }
    });
    out.used = near.size();
    out.spread = std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(near.size()));
    out.scale = kMad * median_of(sizes);
    // the curve moves along its normals; what would fold at badly known ends is left out, from the middle on
    const auto nodes = to_whole<std::size_t>(std::ceil(2.0 * static_cast<double>(intervals)));
    std::vector<Vec2> all(nodes + 1);
    for (std::size_t k = 0; k <= nodes; ++k) {
      const double place = static_cast<double>(k) * static_cast<double>(intervals) / static_cast<double>(nodes);
      const auto cell = std::min(intervals - 1, static_cast<std::size_t>(place));
      const std::array<double, 4> b = cubic_basis(place - static_cast<double>(cell));
      double d = 0.0;
      for (std::size_t a = 0; a < 4; ++a) d += b[a] * coefficients[static_cast<Eigen::Index>(cell + a)];
      const Section::Point at = out.section.at(place * knot);
      all[k] = at.position + std::clamp(d, -farthest, farthest) * at.normal;
    }
    constexpr double kApart = 1e-7;
    std::vector<Vec2> moved;
    for (std::size_t k = nodes / 2 + 1; k-- > 0;)
      if (moved.empty() || all[k].x() < moved.back().x() - kApart) moved.push_back(all[k]);
    std::reverse(moved.begin(), moved.end());
    for (std::size_t k = nodes / 2 + 1; k <= nodes; ++k)
      if (all[k].x() > moved.back().x() + kApart) moved.push_back(all[k]);
    out.section = Section(moved);
  }
  return out;
}

}  // namespace treadmark::scans
