// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/defect_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/backends/create.hpp"

namespace treadmark::app {
namespace {

constexpr double kRadius = 0.46, kLength = 0.16, kDepth = 1.4e-3, kLateral = 0.75;

/// A cylinder of 100 mm width round the y axis.
std::shared_ptr<const Surface> wheel(bool flat, double width = 0.0, double y_center = 0.0) {
  SurfaceSpec spec;
  spec.body = Body::wheel;
  spec.nominal_radius = kRadius;
  spec.shape = ArcChain{-0.05, 0.0, 0.0, {{0.1, 0.0}}};
  if (flat) spec.defects.flats = {{WheelFlat::Shape::rounded, kLength, kDepth, 0.0, y_center, width}};
  return create_natural(spec).surface;
}

wheelrail::Placement pitched(double pitch, double y) {
  wheelrail::Placement placed;
  placed.X_TA = {{0.0, y, -kRadius}, rotation_y(pitch)};
  return placed;
}

/// Where the ray along z at x meets r(theta) = R - dr, by bisection.
double height(double x, double pitch) {
  const auto radius = [&](double theta) {
    const double along = kRadius * std::remainder(theta, 2.0 * std::numbers::pi);
    if (std::abs(along) > 0.5 * kLength) return kRadius;
    return kRadius - 0.5 * kDepth * (1.0 + std::cos(2.0 * std::numbers::pi * along / kLength));
  };
  double low = 0.4, high = 0.5;  // below the axle
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    (std::hypot(x, z) < radius(std::atan2(x, z) - pitch) ? low : high) = z;
  }
  return low;
}

TEST(DefectDepth, IsTheMissingHeightOfAPitchedFlat) {
  const Grid2 grid{-60e-3, kLateral - 10e-3, 5e-3, 5e-3, 25, 5};
  for (const double pitch : {0.0, 0.05, -0.1}) {
    const auto depth =
        DefectDepth(wheel(true), wheel(false)).over(grid, pitched(pitch, kLateral), wheelrail::Side::right);
    ASSERT_EQ(depth.size(), grid.size());
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix) {
        const double x = grid.x(ix), round = std::sqrt(kRadius * kRadius - x * x);
        EXPECT_NEAR(depth[grid.index(ix, iy)], round - height(x, pitch), 1e-9) << x << ' ' << pitch;
      }
  }
}

TEST(DefectDepth, WithoutASoundWheelTheOppositeSideServes) {
  const Grid2 grid{-60e-3, kLateral - 20e-3, 4e-3, 4e-3, 31, 11};
  const auto damaged = wheel(true, 60e-3, 5e-3);
  const auto known = DefectDepth(damaged, wheel(false)).over(grid, pitched(0.03, kLateral), wheelrail::Side::right);
  const auto itself = DefectDepth(damaged, nullptr).over(grid, pitched(0.03, kLateral), wheelrail::Side::right);
  for (std::size_t i = 0; i < grid.size(); ++i) EXPECT_NEAR(known[i], itself[i], 1e-12);
}

TEST(DefectDepth, ALeftWheelIsTheMirrorImage) {
  const DefectDepth of(wheel(true, 60e-3, 5e-3), wheel(false));
  const Grid2 right{-30e-3, kLateral - 30e-3, 3e-3, 3e-3, 21, 17};
  Grid2 left = right;
  left.y0 = -right.y(right.ny - 1);
  const auto on_right = of.over(right, pitched(0.02, kLateral), wheelrail::Side::right);
  const auto on_left = of.over(left, pitched(0.02, -kLateral), wheelrail::Side::left);
  double deepest = 0.0;
  for (int iy = 0; iy < right.ny; ++iy)
    for (int ix = 0; ix < right.nx; ++ix) {
      EXPECT_NEAR(on_left[left.index(ix, right.ny - 1 - iy)], on_right[right.index(ix, iy)], 1e-12);
      deepest = std::max(deepest, on_right[right.index(ix, iy)]);
    }
  EXPECT_NEAR(deepest, kDepth, 0.05 * kDepth);
}

TEST(DefectDepth, BesideTheWheelItIsNotKnown) {
  const Grid2 grid{0.0, kLateral + 60e-3, 1e-3, 1e-3, 2, 2};
  for (const double depth :
       DefectDepth(wheel(true), wheel(false)).over(grid, pitched(0.0, kLateral), wheelrail::Side::right))
    EXPECT_TRUE(std::isnan(depth));
}

}  // namespace
}  // namespace treadmark::app
