// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/circle_axis.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using tests::kPi;

/// Lines across a flanged wheel of radius 0.45, about 30 mm apart round it, points 0.5 mm apart along them.
std::vector<Vec3> sparse_wheel(const Pose& X, double noise, double outliers, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  constexpr int kLines = 94;
  for (int line = 0; line < kLines; ++line) {
    const double u = 2.0 * kPi * line / kLines;
    for (int k = 0; k < 250; ++k) {
      const double y = -65e-3 + 0.5e-3 * k, r = 0.45 + tests::flanged(y) + noise * tests::gaussian(random);
      const bool out = random.uniform() < outliers;
      points.push_back(X.apply(Vec3(r * std::sin(u), y, r * std::cos(u)) +
                               (out ? tests::in_cube(random, 0.2) : Vec3(Vec3::Zero()))));
    }
  }
  return points;
}

SurfaceElements extent_only(const Vec3& centre, double radius) {
  SurfaceElements out;
  out.centre = centre;
  out.radius = radius;
  return out;
}

TEST(CircleAxis, OfAWheelScannedInLinesFarApart) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Pose X = tests::some_frame(seed);
    const auto points = sparse_wheel(X, 50e-6, seed % 2 == 0 ? 0.03 : 0.0, seed);
    const auto found = circle_axis(points, {}, extent_only(X.apply({10e-3, -8e-3, 5e-3}), 0.65));
    ASSERT_TRUE(found) << seed;
    const auto error = tests::axis_error(found->axis, X.origin, X.rotation.col(1));
    EXPECT_LT(error.angle, 5e-3) << seed;
    EXPECT_LT(error.distance, 1e-3) << seed;
    EXPECT_LT(found->residual, 1e-3) << seed;
  }
}

TEST(CircleAxis, LeavesOutWhatIsNotKept) {
  const Pose X = tests::some_frame(2);
  auto points = sparse_wheel(X, 50e-6, 0.0, 1);
  const SurfaceElements extent = extent_only(X.origin, 0.65);
  const auto clean = circle_axis(points, {}, extent);
  std::vector<std::uint8_t> keep(points.size(), 1);
  Random random(4);
  for (int k = 0; k < 20'000; ++k) {
    points.push_back(X.apply(tests::in_cube(random, 0.5)));
    keep.push_back(0);
  }
  const auto kept = circle_axis(points, keep, extent);
  ASSERT_TRUE(clean && kept);
  EXPECT_EQ(kept->axis.direction, clean->axis.direction);
  EXPECT_EQ(kept->axis.point, clean->axis.point);
}

TEST(CircleAxis, RadiiScatterAboutAWrongAxis) {
  const Pose X = tests::some_frame(3);
  const auto points = sparse_wheel(X, 50e-6, 0.0, 1);
  const Axis right{X.origin, X.rotation.col(1)};
  const double least = radius_scatter(points, right, 1.0);
  EXPECT_LT(least, 0.5e-3);  // the section falls within a strip
  // an axis off by e: radii off by e cos(u), whose median size is e / sqrt(2)
  const double shifted = radius_scatter(points, {X.apply({10e-3, 0.0, 0.0}), right.direction}, 1.0);
  EXPECT_NEAR(shifted, 10e-3 / std::sqrt(2.0), 1e-3);
  EXPECT_EQ(radius_scatter(std::vector<Vec3>(points.begin(), points.begin() + 100), right, 7.0), 7.0);
}

TEST(CircleAxis, OfSomethingElseIsNone) {
  Random random(1);
  std::vector<Vec3> cloud, few, strip;
  for (int k = 0; k < 20'000; ++k) cloud.push_back(tests::in_cube(random, 0.5));
  for (int k = 0; k < 50; ++k) few.push_back(tests::in_cube(random, 0.5).cwiseProduct(Vec3(1.0, 1.0, 0.0)));
  EXPECT_FALSE(circle_axis(cloud, {}, extent_only(Vec3::Zero(), 0.87)));
  EXPECT_FALSE(circle_axis(few, {}, extent_only(Vec3::Zero(), 0.87)));
  EXPECT_FALSE(circle_axis(cloud, std::vector<std::uint8_t>(cloud.size(), 0), extent_only(Vec3::Zero(), 0.87)));
}

}  // namespace
}  // namespace treadmark::scans
