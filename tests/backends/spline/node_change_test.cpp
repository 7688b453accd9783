// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/node_change.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/backends/spline/test_planes.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

/// A curve of four breaks by hand: 1 at the second, second derivatives 0 at the ends.
TEST(NodeChange, IsANaturalCubicThroughOneAndZeros) {
  const std::vector<double> breaks{0.0, 1.0, 3.0, 4.0};
  const ProfileSpline profile(breaks, std::vector<CubicSegment>(3));
  const ProfileSpline change = node_change(profile, 1);
  constexpr double kRounding = 1e-14;
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    EXPECT_NEAR(change.position(breaks[k]).y(), k == 1 ? 1.0 : 0.0, kRounding);
    EXPECT_EQ(change.position(breaks[k]).x(), 0.0);
  }
  // 6 M1 + 2 M2 = -9, 2 M1 + 6 M2 = 3
  const double m1 = -15.0 / 8.0, m2 = 9.0 / 8.0;
  EXPECT_NEAR(change.second_derivative(1.0).y(), m1, kRounding);
  EXPECT_NEAR(change.second_derivative(3.0).y(), m2, kRounding);
  EXPECT_NEAR(change.second_derivative(0.0).y(), 0.0, kRounding);
  EXPECT_NEAR(change.second_derivative(4.0).y(), 0.0, kRounding);
}

void expect_slopes_of_heights(const Surface& surface, const std::vector<Pose>& planes) {
  constexpr double kAmount = 5e-8, kSame = 1e-6;  // of surfaces that are exact to rounding
  const Grid2 grid{-4e-3, -12e-3, 2e-3, 2e-3, 5, 13};
  const std::vector<ShapeParameter> all = surface.parameters();
  ASSERT_GT(all.size(), 20u);
  std::vector<double> by(grid.size());
  int moved = 0;
  for (const Pose& plane : planes)
    for (std::size_t k = 0; k < all.size(); k += 2) {
      ASSERT_EQ(surface.heights_by(k, {plane, grid}, by), HeightsBy::exact);
      const auto heights = [&](double amount) {
        return treadmark::testing::heights(*surface.changed(k, amount), plane, grid).z;
      };
      const std::vector<double> more = heights(kAmount), less = heights(-kAmount);
      for (std::size_t i = 0; i < by.size(); ++i) {
        if (std::isnan(more[i]) || std::isnan(less[i]) || std::isnan(by[i])) continue;
        const double difference = (more[i] - less[i]) / (2.0 * kAmount);
        EXPECT_NEAR(by[i], difference, kSame * (1.0 + std::abs(difference))) << all[k].name << ' ' << i;
        moved += std::abs(difference) > 0.1;
      }
    }
  EXPECT_GT(moved, 50);
}

TEST(NodeChange, OfARailAndAWheelSeenAskew) {
  const auto rail = make_profile_surface(testing::rail_head(), 0.0);
  expect_slopes_of_heights(*rail, {Pose{}, {{0.0, 1e-3, 0.0}, rotation_x(0.3)}, {Vec3::Zero(), rotation_z(0.2)}});
  const auto wheel = make_profile_surface(testing::flanged_wheel(), testing::kRadius);
  expect_slopes_of_heights(*wheel, {Pose{}, {{0.0, 1e-3, 0.0}, rotation_x(0.2) * rotation_z(0.02)}});
}

/// Backwards it is the sum of what each point gives.
TEST(NodeChange, PulledBackIsTheSumOfAllPoints) {
  const auto rail = make_profile_surface(testing::rail_head(), 0.0);
  const auto wheel = make_profile_surface(testing::flanged_wheel(), testing::kRadius);
  const Grid2 grid{-4e-3, -12e-3, 2e-3, 2e-3, 5, 13};
  for (const auto& [surface, plane] :
       {std::pair{rail, Pose{{0.0, 1e-3, 0.0}, rotation_x(0.3)}}, {wheel, {{0.0, 1e-3, 0.0}, rotation_z(0.02)}}}) {
    std::vector<Vec2> points;
    std::vector<double> weights;
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix)
        points.emplace_back(grid.x(ix), grid.y(iy)), weights.push_back(1.0 + 0.1 * ix - 0.2 * iy);
    std::vector<double> by(surface->parameter_count(), 0.0), each(grid.size());
    ASSERT_EQ(by.size(), surface->parameters().size());
    EXPECT_EQ(surface->pull_back(plane, points, weights, by), HeightsBy::exact);
    for (std::size_t k = 0; k < by.size(); ++k) {
      surface->heights_by(k, {plane, grid}, each);
      double sum = 0.0;
      for (std::size_t i = 0; i < each.size(); ++i)
        if (!std::isnan(each[i])) sum += weights[i] * each[i];
      EXPECT_NEAR(by[k], sum, 1e-9) << k;
    }
  }
}

TEST(NodeChange, RefusesPointsThatAreNotThere) {
  const auto rail = make_profile_surface(testing::rail_head(), 0.0);
  EXPECT_THROW(rail->changed(rail->parameters().size(), 1e-6), Error);
}

}  // namespace
}  // namespace treadmark::spline
