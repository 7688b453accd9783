// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/refine_axis.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using tests::kPi;

/// A flanged wheel of radius 0.45 or rail 0.8 m long with noise along the normals; damaged: part of the points, all in
/// one quarter, up to 1 mm deep.
std::vector<Vec3> flanged_cloud(Body body, int count, double noise, double damaged, const Pose& X, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double part = random.uniform(), y = -65e-3 + 0.125 * random.uniform(),
                 u = body == Body::wheel ? 2.0 * kPi * part : 0.8 * (part - 0.5);
    double off = noise * tests::gaussian(random);
    if (random.uniform() < 4.0 * damaged && part < 0.25) off -= 1e-3 * random.uniform();
    const Vec2 p = Vec2(y, tests::flanged(y)) + off * Vec2(-tests::flanged_slope(y), 1.0).normalized();
    const double r = 0.45 + p.y();
    points.push_back(
        X.apply(body == Body::wheel ? Vec3(r * std::sin(u), p.x(), r * std::cos(u)) : Vec3(u, p.x(), -p.y())));
  }
  return points;
}

TEST(RefineAxis, BringsAWheelBackFromThreeMillimetresAndMilliradians) {
  for (const double damaged : {0.0, 0.1}) {
    const Pose X = tests::some_frame(5);
    const auto points = flanged_cloud(Body::wheel, 30'000, 30e-6, damaged, X, 1);
    const Pose start = X * Pose{Vec3(3e-3, 0.0, -3e-3), rotation_x(3e-3) * rotation_z(-3e-3)};
    const RefinedAxis found = refine_axis(points, Body::wheel, start);
    const Vec3 axle = found.X_CS.rotation.col(1), apart = X.origin - found.X_CS.origin;
    const double angle = axle.cross(X.rotation.col(1)).norm(), distance = (apart - axle * axle.dot(apart)).norm();
    // four deviations of what it says itself; the shallowest damage, of one side only, looks like noise: about 3 % of
    // the points of one quarter of the wheel pull by 60 um
    const double bias = damaged > 0.0 ? 2e-6 : 0.0;
    EXPECT_LT(angle, 4.0 * found.direction_error + bias / 0.06);
    EXPECT_LT(distance, 4.0 * found.position_error + bias);
    EXPECT_LT(found.direction_error, 10e-6);
    EXPECT_LT(found.position_error, 1e-6);
    EXPECT_GT(found.position_error, 30e-6 / std::sqrt(30'000.0));
    EXPECT_GT(axle.dot(X.rotation.col(1)), 0.0);
    EXPECT_NEAR(found.undamaged, 1.0 - 0.8 * damaged, 0.05);
    EXPECT_NEAR(found.fit.scale, 30e-6, damaged > 0.0 ? 6e-6 : 2e-6);
    // the origin did not move along the axle, but for the turn
    EXPECT_LT(std::fabs(X.rotation.col(1).dot(apart)), 50e-6);
    for (double y = -60e-3; y < 55e-3; y += 5e-3)
      EXPECT_NEAR(found.fit.section.v_at(y), 0.45 + tests::flanged(y), 25e-6) << y;
  }
}

TEST(RefineAxis, BringsARailBackFromThreeMilliradians) {
  const Pose X = tests::some_frame(6);
  const auto points = flanged_cloud(Body::rail, 30'000, 30e-6, 0.1, X, 2);
  const RefinedAxis found =
      refine_axis(points, Body::rail, X * Pose{Vec3::Zero(), rotation_y(3e-3) * rotation_z(-3e-3)});
  const double angle = found.X_CS.rotation.col(0).cross(X.rotation.col(0)).norm();
  EXPECT_LT(angle, 4.0 * found.direction_error + 1e-7);
  EXPECT_LT(found.direction_error, 5e-6);
  EXPECT_GT(found.direction_error, 0.0);
  // neither shifted nor rolled: the points say nothing of that
  EXPECT_EQ(found.X_CS.origin, X.origin);
  EXPECT_NEAR((X.rotation.transpose() * found.X_CS.rotation)(1, 2), 0.0, 1e-4);
}

TEST(RefineAxis, IsTheSameForAnyNumberOfThreads) {
  const auto points = flanged_cloud(Body::wheel, 20'000, 30e-6, 0.05, {}, 3);
  const Pose start{Vec3(1e-3, 0.0, 1e-3), rotation_x(1e-3)};
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return refine_axis(points, Body::wheel, start);
  };
  const RefinedAxis one = with(1), many = with(4);
  EXPECT_EQ(one.X_CS.origin, many.X_CS.origin);
  EXPECT_EQ(one.X_CS.rotation, many.X_CS.rotation);
  EXPECT_EQ(one.position_error, many.position_error);
  EXPECT_EQ(one.fit.section.v_at(10e-3), many.fit.section.v_at(10e-3));
}

TEST(RefineAxis, RefusesPointsWithoutSection) {
  // no strip across is filled
  std::vector<Vec3> points;
  for (int k = 0; k < 300; ++k) points.emplace_back(0.0, 2e-3 * k, 0.4);
  const auto error = tests::error_of([&] { refine_axis(points, Body::wheel, {}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind(), ErrorKind::input_data);
}

}  // namespace
}  // namespace treadmark::scans
