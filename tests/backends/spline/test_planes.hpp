// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "treadmark/backends/conformance/shapes.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::testing {

using conformance::rail_planes;
using conformance::wheel_planes;

struct Fields {
  std::vector<double> z, dzdx, dzdy;
  explicit Fields(std::size_t n) : z(n, 1.0), dzdx(n, 1.0), dzdy(n, 1.0) {}
  HeightsOut out() { return {z, dzdx, dzdy}; }
};

inline Fields heights(const Surface& surface, const Pose& X, const Grid2& grid) {
  Fields f(grid.size());
  surface.heights({X, grid}, f.out());
  return f;
}

/// Odd steps, so that no point falls on a joint by chance.
inline Grid2 odd_grid() { return {-0.0197, -0.0293, 0.00131, 0.00193, 31, 31}; }

/// heights_at over the points of a grid, in rows, in columns and shuffled, must give heights(); returns the number of
/// hits.
inline int expect_heights_at_gives_heights(const Surface& surface, const std::vector<Pose>& planes) {
  constexpr double kRounding = 1e-12;  // [m], per steepness: points are reached from other neighbours
  constexpr double kSlope = 1e-7;      // curvatures up to 100/m, positions to 1e-11 m, with room for steep places
  const Grid2 g = odd_grid();
  std::mt19937 random(11);
  int hits = 0;
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const Fields grid = heights(surface, planes[plane], g);
    for (const char* order : {"rows", "columns", "shuffled"}) {
      std::vector<std::size_t> index(g.size());
      for (std::size_t k = 0; k < index.size(); ++k) {
        const auto nx = static_cast<std::size_t>(g.nx), ny = static_cast<std::size_t>(g.ny);
        index[k] = order[0] == 'c' ? k / ny + nx * (k % ny) : k;
      }
      if (order[0] == 's') std::shuffle(index.begin(), index.end(), random);
      std::vector<Vec2> points;
      for (const std::size_t k : index) {
        const int nx = g.nx, i = static_cast<int>(k);
        points.push_back({g.x(i % nx), g.y(i / nx)});
      }
      Fields at(points.size());
      surface.heights_at(planes[plane], points, at.out());
      std::vector<double> only_z(points.size());
      surface.heights_at(planes[plane], points, {only_z, {}, {}});
      for (std::size_t k = 0; k < index.size(); ++k) {
        const double z = grid.z[index[k]];
        const std::string where =
            "plane " + std::to_string(plane) + ", " + order + ", point " + std::to_string(index[k]);
        EXPECT_EQ(std::isnan(z), std::isnan(at.z[k])) << where;
        EXPECT_EQ(std::isnan(z), std::isnan(only_z[k])) << where;
        EXPECT_EQ(std::isnan(z), std::isnan(at.dzdx[k]) && std::isnan(at.dzdy[k])) << where;
        if (std::isnan(z) || ::testing::Test::HasFailure()) continue;
        ++hits;
        const double slope = std::hypot(grid.dzdx[index[k]], grid.dzdy[index[k]]),
                     steep = std::pow(1.0 + slope * slope, 1.5);
        EXPECT_NEAR(at.z[k], z, kRounding * (1.0 + slope)) << where;
        EXPECT_NEAR(only_z[k], z, kRounding * (1.0 + slope)) << where;
        EXPECT_NEAR(at.dzdx[k], grid.dzdx[index[k]], kSlope * steep) << where;
        EXPECT_NEAR(at.dzdy[k], grid.dzdy[index[k]], kSlope * steep) << where;
      }
    }
  }
  return hits;
}

}  // namespace treadmark::testing
