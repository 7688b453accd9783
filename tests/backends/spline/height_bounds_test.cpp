// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Bounds of heights hold over rectangles of all sizes in planes of all kinds.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "treadmark/backends/spline/make.hpp"
#include "treadmark/tests/backends/spline/test_planes.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using testing::kRadius;

int expect_conservative_bounds(const Surface& surface, const std::vector<Pose>& planes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int hits = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Pose X = planes[static_cast<std::size_t>(trial) % planes.size()];
    X.rotation =
        X.rotation * rotation({0.3 * (unit(random) - 0.5), 0.3 * (unit(random) - 0.5), 0.3 * (unit(random) - 0.5)});
    const double width = std::pow(10.0, -4.0 + 2.4 * unit(random)), height = std::pow(10.0, -4.0 + 2.4 * unit(random));
    const double x = 0.2 * (unit(random) - 0.5), y = 0.12 * (unit(random) - 0.5);
    constexpr int kPoints = 7;
    const Grid2 grid{x, y, width / (kPoints - 1), height / (kPoints - 1), kPoints, kPoints};
    std::vector<double> z(grid.size());
    surface.heights({X, grid}, {z, {}, {}});
    const HeightBounds bounds = surface.height_bounds(X, {x, x + width, y, y + height});
    for (const double value : z) {
      if (std::isnan(value)) continue;
      ++hits;
      EXPECT_FALSE(bounds.empty) << trial;
      EXPECT_GE(value, bounds.z_min) << trial;
      EXPECT_LE(value, bounds.z_max) << trial;
      if (::testing::Test::HasFailure()) return hits;
    }
  }
  return hits;
}

TEST(HeightBounds, HoldForRails) {
  const auto planes = treadmark::testing::rail_planes();
  EXPECT_GT(expect_conservative_bounds(*make_slice_surface(testing::bending_rail(), 0.0), planes), 20000);
  EXPECT_GT(expect_conservative_bounds(*make_profile_surface(testing::rail_head(), 0.0), planes), 20000);
}

TEST(HeightBounds, HoldForWheels) {
  const auto planes = treadmark::testing::wheel_planes(kRadius);
  EXPECT_GT(expect_conservative_bounds(*make_slice_surface(testing::dented_wheel(1e-3, 0.02), kRadius), planes), 20000);
  EXPECT_GT(expect_conservative_bounds(*make_profile_surface(testing::flanged_wheel(), kRadius), planes), 20000);
}

}  // namespace
}  // namespace treadmark::spline
