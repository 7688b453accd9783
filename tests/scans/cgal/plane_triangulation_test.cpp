// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/plane_triangulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "plane_cases.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::scans {
namespace {

/// Positive where d lies in the circle through a counter-clockwise triangle.
double in_circle(const std::array<Vec2, 3>& p, const Vec2& d) {
  const Vec2 a = p[0] - d, b = p[1] - d, c = p[2] - d;
  return a.squaredNorm() * cross(b, c) - b.squaredNorm() * cross(a, c) + c.squaredNorm() * cross(a, b);
}

void expect_delaunay(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles, double period) {
  constexpr double kRounding = 1e-12;  // of a determinant of coordinates about 1
  for (const Triangle& t : triangles) {
    const auto p = corners(t, points, period);
    ASSERT_GT(area(p), 0.0);
    for (const Vec2& q : points)
      for (int shift = period > 0.0 ? -3 : 0; shift <= (period > 0.0 ? 3 : 0); ++shift)
        ASSERT_LT(in_circle(p, q + Vec2(shift * period, 0.0)), kRounding);
  }
}

double total_area(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles, double period) {
  double sum = 0.0;
  for (const Triangle& t : triangles) sum += area(corners(t, points, period));
  return sum;
}

/// Every directed edge once, its opposite in another triangle or on a rim; returns the number of rim edges.
std::size_t rim_edges(const std::vector<Triangle>& triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(edges.emplace(t[i], t[(i + 1) % 3]).second) << t[i];
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const auto& e) {
    return !edges.contains({e.second, e.first});
  }));
}

TEST(PlaneTriangulation, CirclesAreEmptyAndTheHullIsCovered) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const std::vector<Vec2> points = strip(1.5, 300, true, seed);
    const std::vector<Triangle> triangles = triangulate_plane(points, kNoLimit);
    expect_delaunay(points, triangles, 0.0);
    EXPECT_NEAR(total_area(points, triangles, 0.0), 1.5, 1e-12);
    EXPECT_EQ(triangles.size(), 2 * points.size() - 2 - rim_edges(triangles));  // Euler
  }
}

TEST(PlaneTriangulation, OfACylinderHasNoSeam) {
  constexpr double kPeriod = 1.7;
  for (const int inside : {40, 300})
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const std::vector<Vec2> points = strip(kPeriod, inside, false, seed);
      const std::vector<Triangle> triangles = triangulate_plane(points, kNoLimit, kPeriod);
      expect_delaunay(points, triangles, kPeriod);
      EXPECT_NEAR(total_area(points, triangles, kPeriod), kPeriod, 1e-10);
      EXPECT_EQ(rim_edges(triangles), 40U);
      EXPECT_EQ(triangles.size(), 2 * points.size() - 40U);  // Euler, of a ring
      for (const double turn : {0.3, -1.2, 12.0}) {          // any other place of the seam
        std::vector<Vec2> turned;
        for (const Vec2& p : points) turned.emplace_back(p.x() + turn * kPeriod, p.y());
        EXPECT_EQ(triangulate_plane(turned, kNoLimit, kPeriod), triangles) << turn;
      }
    }
}

TEST(PlaneTriangulation, OfARegularGridRoundACylinderIsComplete) {
  // All circles pass through four points. With this period the coordinates are not representable, either.
  constexpr int kAround = 31, kAcross = 17;
  const double period = 0.92 * std::acos(-1.0);
  std::vector<Vec2> points;
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kAcross; ++j) points.emplace_back(period * i / kAround, 0.05 * j);
  const std::vector<Triangle> triangles = triangulate_plane(points, 0.2, period);
  EXPECT_EQ(triangles.size(), 2U * kAround * (kAcross - 1));
  EXPECT_EQ(rim_edges(triangles), 2U * kAround);
  EXPECT_NEAR(total_area(points, triangles, period), period * 0.05 * (kAcross - 1), 1e-10);
}

/// Triangles without those of longer edges.
std::vector<Triangle> short_ones(std::vector<Triangle> triangles, const std::vector<Vec2>& points, double longest,
                                 double period) {
  std::erase_if(triangles, [&](const Triangle& t) {
    const auto p = corners(t, points, period);
    return std::max({(p[0] - p[1]).norm(), (p[1] - p[2]).norm(), (p[2] - p[0]).norm()}) > longest;
  });
  return triangles;
}

// A limit lets many points be triangulated in parts; without one they are triangulated at once.
TEST(PlaneTriangulation, PartsOfManyPointsFitTogether) {
  constexpr double kLength = 40.0, kLongest = 0.08;
  for (const double period : {0.0, kLength})
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      std::vector<Vec2> points = strip(kLength, 100'000, period == 0.0, 7);
      // a gap wider than any margin, and crowds of points at one place each
      std::erase_if(points, [](const Vec2& p) { return p.x() > 11.0 && p.x() < 14.0 && p.y() > 0.0 && p.y() < 1.0; });
      Random random(3);
      for (int k = 0; k < 2000; ++k) points.emplace_back(20.0 + 1e-4 * random.uniform(), 0.3 + 1e-4 * random.uniform());
      const std::vector<Triangle> whole = triangulate_plane(points, kNoLimit, period);
      EXPECT_EQ(triangulate_plane(points, kLongest, period), short_ones(whole, points, kLongest, period));
    }
}

TEST(PlaneTriangulation, HolesWiderThanTheLongestEdgeStayOpen) {
  constexpr double kStep = 0.01;
  std::vector<Vec2> points;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 40; ++j)
      if (std::abs(i - 30) > 6 || std::abs(j - 20) > 6) points.emplace_back(i * kStep, j * kStep);
  // The edge that cuts off a corner of the hole is short enough.
  const double full = 60.0 * 40.0 * kStep * kStep, hole = (14.0 * 14.0 - 4.0 * 0.5) * kStep * kStep;
  EXPECT_NEAR(total_area(points, triangulate_plane(points, 2.0 * kStep), 0.0), full - hole, 1e-12);
  EXPECT_NEAR(total_area(points, triangulate_plane(points, 30.0 * kStep), 0.0), full, 1e-12);
  for (const Triangle& t : triangulate_plane(points, 2.0 * kStep))
    for (std::size_t i = 0; i < 3; ++i) ASSERT_LE((points[t[i]] - points[t[(i + 1) % 3]]).norm(), 2.0 * kStep);
  EXPECT_TRUE(triangulate_plane(points, 0.5 * kStep).empty());
}

TEST(PlaneTriangulation, DoesNotDependOnTheOrderOfThePointsAndUsesEqualOnesOnce) {
  for (const double period : {0.0, 2.0}) {
    std::vector<Vec2> points = strip(2.0, 200, false, 4);
    for (int i = 0; i < 25; ++i)
      for (int j = 0; j < 8; ++j) points.emplace_back(0.5 + 0.04 * i, 0.3 + 0.04 * j);  // with ties
    const std::vector<Triangle> expected = triangulate_plane(points, 0.4, period);
    EXPECT_TRUE(std::is_sorted(expected.begin(), expected.end()));
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    Random random(8);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
    std::vector<Vec2> shuffled;
    for (const std::uint32_t i : order) shuffled.push_back(points[i]);
    for (std::size_t i = 0; i < 50; ++i) shuffled.push_back(shuffled[i]);  // duplicates at the end: never used
    std::vector<Triangle> found = triangulate_plane(shuffled, 0.4, period);
    for (Triangle& t : found) {
      for (std::uint32_t& v : t) v = order.at(v);
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(PlaneTriangulation, BadInputIsAnError) {
  const auto kind = [](const std::vector<Vec2>& points, double longest_edge, double period) {
    try {
      triangulate_plane(points, longest_edge, period);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::numerical;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec2> good{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  EXPECT_EQ(triangulate_plane(good, 2.0).size(), 1U);
  EXPECT_EQ(kind({{0.0, 0.0}, {1.0, 0.0}}, 1.0, 0.0), ErrorKind::input_data);
  EXPECT_EQ(kind({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}}, 1.0, 0.0), ErrorKind::input_data);
  EXPECT_EQ(kind({{0.0, 0.0}, {0.1, 0.1}, {0.2, 0.2}, {0.7, 0.7}}, 1.0, 0.0), ErrorKind::input_data);
  EXPECT_EQ(kind({{0.0, 0.5}, {0.1, 0.5}, {0.2, 0.5}}, 1.0, 3.0), ErrorKind::input_data);
  EXPECT_EQ(kind({{0.1, 0.0}, {0.1, 0.5}, {0.1, 0.6}}, 1.0, 3.0), ErrorKind::input_data);
  EXPECT_EQ(kind({{0.0, 0.0}, {1.0, 0.0}, {0.0, nan}}, 1.0, 0.0), ErrorKind::input_data);
  EXPECT_EQ(kind({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1e6}}, 1.0, 3.0), ErrorKind::input_data);
  EXPECT_EQ(kind(good, 0.0, 0.0), ErrorKind::configuration);
  EXPECT_EQ(kind(good, nan, 0.0), ErrorKind::configuration);
  EXPECT_EQ(kind(good, 1.0, -1.0), ErrorKind::configuration);
}

}  // namespace
}  // namespace treadmark::scans
