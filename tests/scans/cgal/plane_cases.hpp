// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "treadmark/core/random.hpp"
#include "treadmark/scans/cgal/plane_triangulation.hpp"

namespace treadmark::scans {

inline constexpr double kNoLimit = 1e30;

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners of a triangle; on a cylinder next to its first one.
inline std::array<Vec2, 3> corners(const Triangle& t, const std::vector<Vec2>& points, double period) {
  std::array<Vec2, 3> p{points[t[0]], points[t[1]], points[t[2]]};
  if (period > 0.0)
    for (std::size_t i = 1; i < 3; ++i) p[i].x() -= period * std::round((p[i].x() - p[0].x()) / period);
  return p;
}

inline double area(const std::array<Vec2, 3>& p) { return 0.5 * cross(p[1] - p[0], p[2] - p[0]); }

/// A strip of width 1: both rims dense, random points between; on [0, length), or closed to a rectangle.
inline std::vector<Vec2> strip(double length, int inside, bool closed, std::uint64_t seed) {
  std::vector<Vec2> points;
  const int rim = 20;
  for (int i = 0; i < rim + (closed ? 1 : 0); ++i)
    for (const double y : {0.0, 1.0}) points.emplace_back(length * i / rim, y);
  Random random(seed);
  for (int i = 0; i < inside; ++i) {
    const double x = length * random.uniform();
    points.emplace_back(x, 0.02 + 0.96 * random.uniform());
  }
  return points;
}

}  // namespace treadmark::scans
