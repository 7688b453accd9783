// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/contact_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"

namespace treadmark::wheelrail {
namespace {

TEST(ContactShape, OfACylinderIsTurnedWithTheAxes) {
  const auto rail = analytic::make_prismatic_surface(analytic::cylinder_chain(0.08, 0.5));
  for (const double yaw : {0.0, 0.3, -0.6}) {
    const auto shape = contact_shape(*rail, {Vec3::Zero(), rotation_z(yaw)});
    ASSERT_TRUE(shape);
    EXPECT_NEAR(shape->curvature_1, 12.5, 1e-9);
    EXPECT_NEAR(shape->curvature_2, 0.0, 1e-9);
    // across the rail, seen from axes turned by the yaw
    const double expected = 0.5 * kPi - yaw;
    EXPECT_NEAR(std::remainder(shape->angle - expected, kPi), 0.0, 1e-6) << yaw;
    EXPECT_GT(shape->angle, -0.5 * kPi);
    EXPECT_LE(shape->angle, 0.5 * kPi);
  }
}

TEST(ContactShape, OfABarrelIsThatOfATorus) {
  const auto wheel = analytic::make_revolved_surface(analytic::barrel_chain(0.2, 0.2), 0.46, {});
  const auto shape = contact_shape(*wheel, {Vec3(0.0, 0.0, 0.46), Mat3::Identity()});
  ASSERT_TRUE(shape);
  EXPECT_NEAR(shape->curvature_1, 1.0 / 0.2, 1e-6);
  EXPECT_NEAR(shape->curvature_2, 1.0 / 0.46, 1e-6);
  EXPECT_NEAR(shape->angle, 0.5 * kPi, 1e-6);
}

TEST(ContactShape, IsNotToldBesideTheSurface) {
  const auto rail = analytic::make_prismatic_surface(analytic::cylinder_chain(0.08, 0.1));
  EXPECT_FALSE(contact_shape(*rail, {Vec3(0.0, 0.02, 0.0), Mat3::Identity()}));
}

TEST(ContactShape, IsPartOfASolutionAndOfItsMirrorImage) {
  Problem p = standard_problem();
  const PairSolution right = Pair(standard_geometry()).solve(p);
  ASSERT_FALSE(right.patches.empty());
  const PatchSolution& a = right.patches.front();
  ASSERT_TRUE(a.rail_shape && a.wheel_shape);
  // on one of the arcs of 60E1: 300, 80, 13 mm
  const double radius = 1.0 / a.rail_shape->curvature_1;
  EXPECT_TRUE(std::fabs(radius - 0.3) < 1e-6 || std::fabs(radius - 0.08) < 1e-6 || std::fabs(radius - 0.013) < 1e-6)
      << radius;
  EXPECT_NEAR(a.rail_shape->curvature_2, 0.0, 1e-9);
  EXPECT_NEAR(std::fabs(a.rail_shape->angle), 0.5 * kPi, 1e-5);
  // round its axle the wheel has about its rolling radius
  EXPECT_NEAR(std::min(std::fabs(a.wheel_shape->curvature_1 - 1.0 / kStandardRadius),
                       std::fabs(a.wheel_shape->curvature_2 - 1.0 / kStandardRadius)),
              0.0, 0.02);

  Problem mirror = p;
  mirror.side = Side::left;
  WheelsetState& s = mirror.state;
  for (double* v : {&s.position.y, &s.position.roll, &s.position.yaw, &s.velocity.y, &s.velocity.roll, &s.velocity.yaw})
    *v = -*v;
  const PairSolution left = Pair(standard_geometry()).solve(mirror);
  ASSERT_EQ(left.patches.size(), right.patches.size());
  const PatchSolution& b = left.patches.front();
  ASSERT_TRUE(b.rail_shape && b.wheel_shape);
  EXPECT_EQ(b.wheel_shape->curvature_1, a.wheel_shape->curvature_1);
  EXPECT_NEAR(std::remainder(b.wheel_shape->angle + a.wheel_shape->angle, kPi), 0.0, 1e-12);
}

}  // namespace
}  // namespace treadmark::wheelrail
