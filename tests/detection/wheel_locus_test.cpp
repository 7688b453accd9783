// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/contact_program/wheel_locus.hpp"

namespace treadmark::detection {
namespace {

constexpr double kRadius = 0.46, kStep = 0.5e-3;

/// A wheel through points every half millimetre over +-30 mm.
template <class Height>
std::shared_ptr<const Surface> wheel_through(Height&& z) {
  Profile profile;
  profile.body = Body::wheel;
  for (int i = 60; i >= -60; --i) {
    profile.y.push_back(kStep * i);
    profile.z.push_back(z(kStep * i));
  }
  return spline::make_profile_surface(profile, kRadius);
}

BodyPair over_nothing(const Surface& wheel, double yaw) {
  BodyPair bodies;
  bodies.wheel = &wheel;
  bodies.X_TW = {{0.0, 0.0, -kRadius}, rotation_z(yaw) * rotation_y(0.3)};
  return bodies;
}

TEST(WheelLocus, PassesThroughTheDataOfARoughProfile) {
  const auto rough = [](double y) { return 0.05 * y + 4e-6 * std::sin(9e3 * y) + 3e-6 * std::cos(1.7e4 * y); };
  const auto wheel = wheel_through(rough);
  std::vector<double> y;
  for (int i = -50; i <= 50; ++i) y.push_back(kStep * i);
  const std::vector<Vec2> at = WheelLocus(over_nothing(*wheel, 0.0), kRadius).over(y);
  for (std::size_t i = 0; i < y.size(); ++i) {
    EXPECT_NEAR(at[i].x(), 0.0, 1e-15);
    EXPECT_NEAR(at[i].y(), rough(y[i]), 1e-12);
  }
}

TEST(WheelLocus, BreaksAtAKink) {
  // Two cones that meet at 40 degrees: a spline through the corner would swing by tens of micrometres beside it.
  const double slope = std::tan(0.35);
  const auto roof = [&](double y) { return -slope * std::abs(y); };
  const auto wheel = wheel_through(roof);
  std::vector<double> y;
  for (int i = -250; i <= 250; ++i) y.push_back(0.1e-3 * i);
  const std::vector<Vec2> at = WheelLocus(over_nothing(*wheel, 0.0), kRadius).over(y);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(at[i].y(), roof(y[i]), 1e-9) << y[i];
}

TEST(WheelLocus, IsWhereAYawedWheelReachesLowest) {
  const auto tread = [](double y) { return 0.1 * y + 2.0 * y * y; };
  const auto wheel = wheel_through(tread);
  const double yaw = 0.01;
  const BodyPair bodies = over_nothing(*wheel, yaw);
  std::vector<double> y;
  for (int i = -20; i <= 20; ++i) y.push_back(1e-3 * i);
  const std::vector<Vec2> at = WheelLocus(bodies, kRadius).over(y);
  for (std::size_t k = 0; k < y.size(); ++k) {
    // By brute force, and the vertex of the parabola through the lowest sample.
    const Grid2 line{-12e-3, y[k], 0.05e-3, 1.0, 481, 1};
    std::vector<double> z(line.size());
    wheel->heights({bodies.X_TW.inverse(), line}, {z, {}, {}});
    const auto i = static_cast<std::size_t>(std::max_element(z.begin() + 1, z.end() - 1) - z.begin());
    const double bend = z[i + 1] - 2.0 * z[i] + z[i - 1], slope = 0.5 * (z[i + 1] - z[i - 1]);
    const double x = line.x(static_cast<int>(i)) - line.dx * slope / bend, lowest = z[i] - 0.5 * slope * slope / bend;
    EXPECT_NEAR(at[k].y(), lowest, 1e-9) << y[k];
    EXPECT_NEAR(at[k].x(), x, 2e-5) << y[k];
  }
  EXPECT_GT(std::abs(at.front().x() - at.back().x()), 2e-4);
}

/// A cliff of slope -5 beside a cylindrical tread, rolled by so much that the cliff hangs over: over the overhang the
/// tread counts, on whose side the middle of the profile is, wherever the track's origin lies.
TEST(WheelLocus, AFoldKeepsTheSideOfTheMiddle) {
  constexpr double kSwing = 0.5e-3;  // of a spline where it goes on beyond the fold; cliffs are 20 times as high
  for (const double side : {1.0, -1.0})
    for (const double cliff : {20e-3, 10e-3}) {  // more steps back than are passed over, and fewer
      const auto z = [=](double y) { return std::clamp(5.0 * (side * y - 20e-3), 0.0, cliff); };
      const auto wheel = wheel_through(z);
      for (const double origin : {25e-3, 0.0, -25e-3}) {
        const double roll = 0.3 * side, c = std::cos(roll), s = std::sin(roll);
        BodyPair bodies;
        bodies.wheel = wheel.get();
        bodies.X_TW = {{0.0, origin + kRadius * s, -kRadius * c}, rotation_x(roll) * rotation_y(0.3)};
        const auto across = [&](double y) { return origin + c * y - s * z(y); };
        const double corner = across(side * 20e-3), top = across(side * (20e-3 + cliff / 5.0));
        ASSERT_GT(side * (corner - top), 0.7e-3);  // it hangs over
        std::vector<double> y;
        for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) y.push_back(corner + share * (top - corner));
        if (side > 0.0) ranges::reverse(y);
        const std::vector<Vec2> at = WheelLocus(bodies, kRadius).over(y);
        for (std::size_t k = 0; k < y.size(); ++k)
          EXPECT_NEAR(at[k].y(), (y[k] - origin) / c * s, kSwing) << side << ' ' << origin << ' ' << y[k];
      }
    }
}

TEST(WheelLocus, EndsWhereTheWheelDoes) {
  const auto wheel = wheel_through([](double) { return 0.0; });
  const std::vector<Vec2> at = WheelLocus(over_nothing(*wheel, 0.0), kRadius).over({-31e-3, 0.0, 31e-3});
  EXPECT_TRUE(std::isnan(at[0].x()) && std::isnan(at[0].y()));
  EXPECT_NEAR(at[1].y(), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(at[2].y()));
}

TEST(WheelLocus, OfAWheelWithoutDataFollowsItsShape) {
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius);
  const BodyPair bodies = over_nothing(*wheel, 0.0);
  std::vector<double> y, exact(41);
  for (int i = -20; i <= 20; ++i) y.push_back(0.77e-3 * i);
  wheel->heights({bodies.X_TW.inverse(), {0.0, y.front(), 1.0, 0.77e-3, 1, 41}}, {exact, {}, {}});
  const std::vector<Vec2> at = WheelLocus(bodies, kRadius).over(y);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(at[i].y(), exact[i], 2e-8);
}

}  // namespace
}  // namespace treadmark::detection
