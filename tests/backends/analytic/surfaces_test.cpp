// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-15;  // [m]

SurfacePoint locate_at(const Surface& surface, const Pose& X, const Vec2& p) {
  SurfacePoint out;
  surface.locate(X, {&p, 1}, {&out, 1});
  return out;
}

TEST(PlaneSurface, TiltedPlaneHasTheSlopesOfTheTilt) {
  const auto plane = make_plane_surface(Facing::up);
  const Pose X{{0.1, 0.2, 0.3}, rotation_x(0.2)};
  double z = 0.0, dzdx = 1.0, dzdy = 0.0;
  plane->heights({X, {0.5, 0.7, 1.0, 1.0, 1, 1}}, {{&z, 1}, {&dzdx, 1}, {&dzdy, 1}});
  EXPECT_NEAR(z, -0.3 / std::cos(0.2) - 0.7 * std::tan(0.2), kRounding);
  EXPECT_EQ(dzdx, 0.0);
  EXPECT_NEAR(dzdy, -std::tan(0.2), kRounding);
  EXPECT_EQ(locate_at(*plane, X, {0.0, 0.0}).normal_S.z(), -1.0);
  EXPECT_EQ(locate_at(*make_plane_surface(Facing::down), X, {0.0, 0.0}).normal_S.z(), 1.0);
  const HeightBounds bounds = plane->height_bounds(X, {0.5, 0.5, 0.7, 0.7});
  EXPECT_LE(bounds.z_min, z);
  EXPECT_GE(bounds.z_max, z);
  EXPECT_NEAR(bounds.z_min, bounds.z_max, 1e-12);
}

TEST(PrismaticSurface, CylinderInClosedForm) {
  constexpr double R = 0.3;
  const auto rail = make_prismatic_surface(cylinder_chain(R, 1.2));
  for (const double roll : {0.0, 0.1, -0.7}) {
    // turned about its own axis the cylinder stays what it is
    const Pose X{Vec3(0.2, 0.0, R) - rotation_x(roll) * Vec3(0.0, 0.0, R), rotation_x(roll)};
    for (const double y : {-0.05, 0.0, 0.013, 0.09})
      EXPECT_NEAR(height_at(*rail, X, {3.0, y}), R - std::sqrt(R * R - y * y), kRounding) << roll;
  }
  // seen along a direction with a part along x the section is an ellipse
  const Pose Y{{0.0, 0.0, 0.0}, rotation_y(0.3)};
  const double y = 0.04, h = R - std::sqrt(R * R - y * y);
  EXPECT_NEAR(height_at(*rail, Y, {0.0, y}), h / std::cos(0.3), kRounding);
}

TEST(PrismaticSurface, LocatesArcLengthNormalAndCurvature) {
  constexpr double R = 0.3;
  const auto rail = make_prismatic_surface(cylinder_chain(R, 1.2));
  const SurfacePoint p = locate_at(*rail, {{0.5, 0.0, -0.1}, Mat3::Identity()}, {0.1, 0.06});
  EXPECT_EQ(p.status, LocateStatus::converged);
  EXPECT_DOUBLE_EQ(p.u, 0.6);
  EXPECT_NEAR(p.v, R * (1.2 + std::asin(0.06 / R)), kRounding);
  EXPECT_NEAR(p.normal_S.y(), 0.06 / R, kRounding);
  EXPECT_NEAR(p.normal_S.z(), -std::sqrt(1.0 - 0.04), kRounding);
  EXPECT_NEAR(p.curvature_1, 1.0 / R, 1e-12);
  EXPECT_EQ(p.curvature_2, 0.0);
}

TEST(PrismaticSurface, HidesWhatLiesUnderAnOverhang) {
  // up a step that leans over: a lower shelf at z = 0 for y < 0, an upper one at z = -10 mm that overhangs it by 4 mm
  ArcChain chain;
  chain.start_y = -0.05;
  const double back = std::atan2(-0.010, -0.004);  // direction of the leaning face, beyond the vertical
  const double lean = std::hypot(0.010, 0.004), k = 1e4;
  chain.segments = {{0.05, 0.0}, {-back / k, -k}, {lean, 0.0}, {-back / k, k}, {0.03, 0.0}};
  const auto rail = make_prismatic_surface(chain);
  const Pose X;
  EXPECT_NEAR(height_at(*rail, X, {0.0, -0.02}), 0.0, kRounding);
  const double under = height_at(*rail, X, {0.0, -0.002});
  EXPECT_LT(under, -0.009);
  EXPECT_EQ(locate_at(*rail, X, {0.0, -0.002}).status, LocateStatus::ambiguous);
  EXPECT_EQ(locate_at(*rail, X, {0.0, -0.02}).status, LocateStatus::converged);
  EXPECT_TRUE(std::isnan(height_at(*rail, X, {0.0, -0.06})));
  // the bounds know the visible part only
  const HeightBounds bounds = rail->height_bounds(X, {0.0, 0.1, -0.002, -0.001});
  EXPECT_LT(bounds.z_max, -0.009);
}

TEST(PrismaticSurface, BoundsHoldTheCrown) {
  const Box3 box = make_prismatic_surface(cylinder_chain(0.3, 0.5))->bounds();
  EXPECT_NEAR(box.min.z(), 0.0, kRounding);
  EXPECT_NEAR(box.max.z(), 0.3 * (1.0 - std::cos(0.5)), kRounding);
  EXPECT_NEAR(box.max.y(), 0.3 * std::sin(0.5), kRounding);
  EXPECT_TRUE(std::isinf(box.max.x()));
}

TEST(RevolvedSurface, BallInClosedForm) {
  constexpr double R = 0.25;
  const auto ball = make_revolved_surface(barrel_chain(R, 1.3), R);
  const Mat3 turn = rotation({0.4, -0.9, 0.6});
  const Pose X{turn * Vec3(0.0, 0.0, R), turn};
  for (const auto& p : {Vec2(0.0, 0.0), Vec2(0.03, -0.05), Vec2(-0.1, 0.02)}) {
    EXPECT_NEAR(height_at(*ball, X, p), std::sqrt(R * R - p.squaredNorm()) - R, 5 * kRounding);
    const SurfacePoint q = locate_at(*ball, X, p);
    EXPECT_EQ(q.status, LocateStatus::converged);
    EXPECT_LT((q.normal_S - q.position_S / R).norm(), 1e-13);
    EXPECT_NEAR(q.curvature_1, 1.0 / R, 1e-10);
    EXPECT_NEAR(q.curvature_2, 1.0 / R, 1e-10);
    EXPECT_NEAR(q.u, std::atan2(q.position_S.x(), q.position_S.z()), kRounding);
    EXPECT_NEAR(q.v, q.position_S.y(), kRounding);
  }
}

TEST(RevolvedSurface, CylindricalWheelInClosedForm) {
  constexpr double R = 0.46;
  const auto wheel = make_revolved_surface(straight_chain(0.05), R);
  const Pose X{{0.0, 0.0, R}, Mat3::Identity()};
  for (const double x : {0.0, 0.01, -0.2, 0.45999})
    EXPECT_NEAR(height_at(*wheel, X, {x, 0.03}), std::sqrt(R * R - x * x) - R, kRounding);
  EXPECT_TRUE(std::isnan(height_at(*wheel, X, {0.4601, 0.03})));
  EXPECT_TRUE(std::isnan(height_at(*wheel, X, {0.0, 0.0501})));
  const SurfacePoint p = locate_at(*wheel, X, {0.1, 0.02});
  EXPECT_NEAR(p.curvature_1, 1.0 / R, 1e-12);
  EXPECT_NEAR(p.curvature_2, 0.0, 1e-12);
}

TEST(RevolvedSurface, SeesOnlyTheHalfThatFacesThePlane) {
  // a line that enters behind the flange passes through the wheel: its way out on the far side is no hit
  const auto wheel = make_standard_surface({"S1002"}, Body::wheel, 0.46);
  const Pose X{{0.0, -0.3, 0.46}, rotation_x(0.5)};
  EXPECT_TRUE(std::isnan(height_at(*wheel, X, {0.0, 0.0})));
}

TEST(RevolvedSurface, FlangeHidesItsRootAndSaysSo) {
  const auto wheel = make_standard_surface({"S1002"}, Body::wheel, 0.46);
  const Pose X{{0.0, -0.055, 0.488}, rotation_x(1.2)};
  // towards the field side of the tip in this view: the line touches the flange, then passes over its root to the tread
  const SurfacePoint p = locate_at(*wheel, X, {0.0, -0.004});
  EXPECT_EQ(p.status, LocateStatus::ambiguous);
  EXPECT_LT(p.position_S.y(), -0.05);
}

TEST(RevolvedSurface, RoundedFlatHasItsFormula) {
  constexpr double R = 0.46;
  WheelFlat flat;
  flat.length = 0.1;
  flat.depth = 1e-3;
  flat.theta_center = 0.3;
  flat.y_center = 0.01;
  flat.width = 0.04;
  const auto wheel = make_standard_surface({"S1002"}, Body::wheel, R, {flat});
  const auto round = make_standard_surface({"S1002"}, Body::wheel, R);
  const auto depth = [&](double theta, double y) {
    const Pose X{{R * std::sin(theta), y, R * std::cos(theta)}, rotation_y(theta)};
    return height_at(*round, X, {0.0, 0.0}) - height_at(*wheel, X, {0.0, 0.0});
  };
  EXPECT_NEAR(depth(0.3, 0.01), 1e-3, kRounding);
  EXPECT_NEAR(depth(0.3 + 0.025 / R, 0.01), 0.5e-3, kRounding);
  EXPECT_NEAR(depth(0.3 - 0.0499 / R, 0.01), 0.5e-3 * (1.0 + std::cos(2 * kPi * 0.499)), kRounding);
  EXPECT_NEAR(depth(0.3 - 0.0501 / R, 0.01), 0.0, kRounding);
  EXPECT_NEAR(depth(0.3, 0.02), 0.5e-3, kRounding);
  EXPECT_NEAR(depth(0.3, -0.011), 0.0, kRounding);
  EXPECT_NEAR(depth(0.3, 0.031), 0.0, kRounding);
}

TEST(RevolvedSurface, FreshFlatIsAPlaneCut) {
  constexpr double R = 0.46, L = 0.06;
  WheelFlat flat;
  flat.shape = WheelFlat::Shape::fresh;
  flat.length = L;
  flat.theta_center = kPi;  // across the seam of theta
  const auto wheel = make_revolved_surface(straight_chain(0.05), R, {flat});
  const Pose X{{0.0, 0.0, -R}, rotation_y(kPi)};
  const double d0 = R - std::sqrt(R * R - 0.25 * L * L);
  for (const double x : {0.0, 0.01, -0.0299}) EXPECT_NEAR(height_at(*wheel, X, {x, 0.0}), -d0, 1e-14) << x;
  EXPECT_NEAR(height_at(*wheel, X, {0.0301, 0.0}), std::sqrt(R * R - 0.0301 * 0.0301) - R, 1e-14);
  const SurfacePoint p = locate_at(*wheel, X, {0.01, 0.0});
  EXPECT_NEAR(p.curvature_1, 0.0, 1e-9);
  EXPECT_NEAR(p.curvature_2, 0.0, 1e-9);
  EXPECT_LT((p.normal_S - Vec3(0, 0, -1)).norm(), 1e-12);
}

TEST(RevolvedSurface, FlatsAddUp) {
  constexpr double R = 0.46;
  WheelFlat one, two;
  one.length = two.length = 0.08;
  one.depth = 1e-3;
  two.depth = 0.4e-3;
  two.theta_center = 0.02 / R;
  const auto wheel = make_revolved_surface(straight_chain(0.05), R, {one, two});
  const Pose X{{0.0, 0.0, R}, Mat3::Identity()};
  EXPECT_NEAR(height_at(*wheel, X, {0.0, 0.0}), -1e-3 - 0.2e-3, kRounding);
}

}  // namespace
}  // namespace treadmark::analytic
