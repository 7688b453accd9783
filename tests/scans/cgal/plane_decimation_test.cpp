// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "plane_cases.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::scans {
namespace {

using Field = std::function<double(const Vec2&)>;

std::vector<double> sample(const std::vector<Vec2>& points, const Field& field) {
  std::vector<double> heights;
  for (const Vec2& p : points) heights.push_back(field(p));
  return heights;
}

/// Largest error of the points, looked up in all triangles of the kept ones; infinite where no triangle covers a point.
/// Where rounding puts a point into two triangles the better one counts.
double worst_error(const std::vector<Vec2>& points, const std::vector<double>& heights,
                   const std::vector<std::uint32_t>& kept, double period) {
  std::vector<Vec2> subset;
  for (const std::uint32_t i : kept) subset.push_back(points[i]);
  std::vector<double> error(points.size(), std::numeric_limits<double>::infinity());
  for (const Triangle& t : triangulate_plane(subset, kNoLimit, period)) {
    const auto p = corners(t, subset, period);
    const Vec2 b = p[1] - p[0], c = p[2] - p[0];
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int shift = period > 0.0 ? -1 : 0; shift <= (period > 0.0 ? 1 : 0); ++shift) {
        const Vec2 d = points[i] + Vec2(shift * period, 0.0) - p[0];
        const double u = cross(d, c) / cross(b, c), v = cross(b, d) / cross(b, c);
        constexpr double kRounding = 1e-9;
        if (u < -kRounding || v < -kRounding || u + v > 1.0 + kRounding) continue;
        const double h0 = heights[kept[t[0]]];
        const double plane = h0 + u * (heights[kept[t[1]]] - h0) + v * (heights[kept[t[2]]] - h0);
        error[i] = std::min(error[i], std::abs(plane - heights[i]));
      }
  }
  return *std::max_element(error.begin(), error.end());
}

TEST(PlaneDecimation, KeepsTheToleranceAtEveryPoint) {
  for (const double period : {0.0, 2.0}) {
    const Field wave = [](const Vec2& p) { return std::sin(std::numbers::pi * p.x()) * std::cos(3.0 * p.y()); };
    const std::vector<Vec2> points = strip(2.0, 3000, period == 0.0, 5);
    const std::vector<double> heights = sample(points, wave);
    std::size_t before = points.size();
    for (const double tolerance : {6e-3, 3e-2, 1.5e-1}) {
      const std::vector<std::uint32_t> kept = decimate_plane(points, heights, tolerance, period);
      EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
      EXPECT_LE(worst_error(points, heights, kept, period), tolerance * (1.0 + 1e-9));
      EXPECT_LT(kept.size(), before / 2) << tolerance;
      before = kept.size();
    }
  }
}

TEST(PlaneDecimation, OfARegularGridHoldsForItsOwnTriangulation) {
  // Grids are full of circles through more than three points: both triangulations must take the same diagonals.
  for (const double period : {0.0, 3.2}) {
    std::vector<Vec2> points;
    for (int i = 0; i < 64; ++i)
      for (int j = 0; j < 33; ++j) points.emplace_back(0.05 * i, 0.05 * j);
    const std::vector<double> heights = sample(points, [](const Vec2& p) {
      return std::abs(std::sin(std::numbers::pi * p.x() / 1.6)) + std::abs(p.y() - 0.8);
    });
    const double tolerance = 0.01;
    const std::vector<std::uint32_t> kept = decimate_plane(points, heights, tolerance, period);
    EXPECT_LT(kept.size(), points.size() / 3);
    EXPECT_LE(worst_error(points, heights, kept, period), tolerance * (1.0 + 1e-9));
  }
}

TEST(PlaneDecimation, OfAPlaneLeavesTheCorners) {
  std::vector<Vec2> points = strip(2.0, 1000, true, 6);
  const std::vector<double> heights = sample(points, [](const Vec2& p) { return 3.0 * p.x() - p.y() + 7.0; });
  const std::vector<std::uint32_t> kept = decimate_plane(points, heights, 1e-6);
  EXPECT_EQ(kept, (std::vector<std::uint32_t>{0, 1, 40, 41}));
}

TEST(PlaneDecimation, FindsALonePeak) {
  std::vector<Vec2> points = strip(2.0, 1000, true, 6);
  std::vector<double> heights(points.size(), 0.0);
  heights[500] = 1e-3;
  const std::vector<std::uint32_t> kept = decimate_plane(points, heights, 1e-4);
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 500U));
  EXPECT_LE(worst_error(points, heights, kept, 0.0), 1e-4);
}

TEST(PlaneDecimation, TheSeamIsLikeAnywhereElse) {
  constexpr double kPeriod = 2.0;
  const std::vector<Vec2> points = strip(kPeriod, 6000, false, 9);
  const auto field = [](double x) {
    return [x](const Vec2& p) { return std::cos(4.0 * std::numbers::pi * (p.x() - x)) * p.y(); };
  };
  // A pattern of two equal waves, turned by half a wave: as many points near the seam as near the middle.
  for (const double turn : {0.0, 0.25}) {
    const std::vector<double> heights = sample(points, field(turn));
    const std::vector<std::uint32_t> kept = decimate_plane(points, heights, 2e-3, kPeriod);
    std::size_t seam = 0, middle = 0;
    for (const std::uint32_t i : kept) {
      const double x = points[i].x();
      seam += x < 0.25 || x >= 1.75 ? 1 : 0;
      middle += x >= 0.75 && x < 1.25 ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(seam), static_cast<double>(middle), 0.12 * static_cast<double>(middle)) << turn;
    EXPECT_LE(worst_error(points, heights, kept, kPeriod), 2e-3 * (1.0 + 1e-9));
  }
}

TEST(PlaneDecimation, DoesNotDependOnTheOrderOfThePoints) {
  for (const double period : {0.0, 2.0}) {
    const Field wave = [](const Vec2& p) { return std::sin(std::numbers::pi * p.x()) * p.y(); };
    const std::vector<Vec2> points = strip(2.0, 1000, false, 5);
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    Random random(2);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
    std::vector<Vec2> shuffled;
    for (const std::uint32_t i : order) shuffled.push_back(points[i]);
    std::vector<std::uint32_t> kept = decimate_plane(shuffled, sample(shuffled, wave), 1e-2, period);
    for (std::uint32_t& i : kept) i = order[i];
    std::sort(kept.begin(), kept.end());
    EXPECT_EQ(kept, decimate_plane(points, sample(points, wave), 1e-2, period));
  }
}

TEST(PlaneDecimation, BadInputIsAnError) {
  const auto kind = [](const std::vector<Vec2>& points, const std::vector<double>& heights, double tolerance,
                       double period) {
    try {
      decimate_plane(points, heights, tolerance, period);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::numerical;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec2> good{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  EXPECT_EQ(decimate_plane(good, std::vector<double>{0.0, 1.0, 2.0}, 1.0).size(), 3U);
  EXPECT_EQ(kind(good, {0.0, 1.0}, 1.0, 0.0), ErrorKind::input_data);
  EXPECT_EQ(kind(good, {0.0, 1.0, nan}, 1.0, 0.0), ErrorKind::input_data);
  EXPECT_EQ(kind({{0.0, 0.0}, {1.0, 0.0}, {nan, 1.0}}, {0.0, 1.0, 2.0}, 1.0, 0.0), ErrorKind::input_data);
  EXPECT_EQ(kind({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}, {0.0, 1.0, 2.0}, 1.0, 0.0), ErrorKind::input_data);
  EXPECT_EQ(kind(good, {0.0, 1.0, 2.0}, 0.0, 0.0), ErrorKind::configuration);
  EXPECT_EQ(kind(good, {0.0, 1.0, 2.0}, nan, 0.0), ErrorKind::configuration);
  EXPECT_EQ(kind(good, {0.0, 1.0, 2.0}, 1.0, -3.0), ErrorKind::configuration);
}

}  // namespace
}  // namespace treadmark::scans
