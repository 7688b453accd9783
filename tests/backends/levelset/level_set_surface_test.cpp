// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/level_set_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "treadmark/backends/levelset/make.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/tests/backends/levelset/shapes.hpp"
#include "treadmark/tests/support/refusal.hpp"

namespace treadmark::testing {
namespace {

using levelset::make_level_set_surface;
using ::testing::HasSubstr;

std::shared_ptr<const Surface> of_formula(const Distance& distance, const Vec3& low, const Vec3& high, double voxel,
                                          Facing facing, double half_width = 3.5) {
  return std::make_shared<const levelset::LevelSetSurface>(
      levelset::DistanceField(sampled(distance, low, high, voxel, half_width)), facing, "level-set");
}

/// A cylinder along x, 30 mm thick, with round ends: a rail with undercuts on both sides.
double cylinder(const Vec3& p) {
  return Vec3(p.x() - std::clamp(p.x(), -0.006, 0.006), p.y(), p.z() - 0.015).norm() - 0.015;
}
const Vec3 kCylinderLow(-0.03, -0.024, -0.009), kCylinderHigh(0.03, 0.024, 0.039);

/// Exact distances: heights are of order 3 in the voxel, seen from above and from the side, into the undercut.
TEST(LevelSetSurface, ACylinderIsOfOrderThree) {
  double before = 0.0;
  for (const double voxel : {2e-3, 1e-3, 0.5e-3}) {
    const auto rail = of_formula(cylinder, kCylinderLow, kCylinderHigh, voxel, Facing::up);
    double worst = 0.0;
    for (const double roll : {0.0, 0.4, 1.5, 2.4}) {
      const Pose X{{0.0, 0.0, 0.015}, rotation({roll, 0.1, 0.0})};
      const HeightError e = error_of(*rail, X, {-0.0037, -0.0133, 0.00031, 0.00037, 25, 73}, cylinder);
      EXPECT_EQ(e.count, 25 * 73) << roll;
      worst = std::max(worst, e.largest);
    }
    EXPECT_LT(worst, kTenthOfVoxel * voxel);
    // half the voxel: an eighth of the error, as far as points tell
    if (before > 0.0) {
      EXPECT_LT(worst, before / 5.0);
    }
    before = worst;
  }
}

TEST(LevelSetSurface, ATorusOfTrianglesIsOfOrderThree) {
  constexpr double kLarge = 0.05, kSmall = 0.02;
  const Distance distance = [](const Vec3& p) { return torus(p, kLarge, kSmall); };
  double before = 0.0;
  for (const double voxel : {2e-3, 1e-3, 0.5e-3}) {
    const int round = 2 * static_cast<int>(std::round(kPi * kLarge / voxel)),
              across = 2 * static_cast<int>(std::round(kPi * kSmall / voxel));
    const auto wheel =
        make_level_set_surface(torus_mesh(kLarge, kSmall, round, across), Body::wheel, voxel, "level-set");
    double rms = 0.0;
    for (const double pitch : {0.0, 0.7, 3.0}) {
      const Pose X{Vec3::Zero(), rotation({0.2, 0.0, pitch})};
      const HeightError e = error_of(*wheel, X, {-0.0157, -0.0143, 0.00043, 0.00041, 71, 67}, distance);
      EXPECT_GT(e.count, 4000);
      EXPECT_LT(e.largest, kTenthOfVoxel * voxel) << pitch;
      rms = std::max(rms, e.rms);
    }
    // triangles as large as voxels: their order counts, too; at single nodes the nearest of two is a matter of rounding
    if (before > 0.0) {
      EXPECT_LT(rms, before / 5.0);
    }
    before = rms;
  }
}

/// Two cylinders above each other with a neck: lines see the outermost one, from below the head, too.
TEST(LevelSetSurface, AnUndercutGivesTheOutermostHit) {
  constexpr double kHead = 0.02, kFoot = 0.03, kApart = 0.04, kVoxel = 0.5e-3;
  const Distance distance = [](const Vec3& p) {
    const double x = p.x() - std::clamp(p.x(), -0.004, 0.004);
    return std::min(Vec3(x, p.y(), p.z() - kHead).norm() - kHead,
                    Vec3(x, p.y(), p.z() - kHead - kApart).norm() - kFoot);
  };
  const auto rail = of_formula(distance, {-0.037, -0.033, -0.003}, {0.037, 0.033, 0.093}, kVoxel, Facing::up);
  for (const double roll : {0.0, 0.6, -1.2, 1.9}) {
    const Pose X{{0.0, 0.0, 0.04}, rotation({roll, 0.0, 0.0})};
    int seen = 0, head = 0;
    for (double y = -0.05; y < 0.05; y += 0.00037) {
      // where the line enters the circles first
      const Vec3 along = X.rotation.col(2), from = X.apply({0.0, y, 0.0});
      double expected = INFINITY, grazing = 0.0;
      for (const auto& [z, radius] : {std::pair{kHead, kHead}, {kHead + kApart, kFoot}}) {
        const double b = along.y() * from.y() + along.z() * (from.z() - z);
        const double inside = b * b - (from.y() * from.y() + (from.z() - z) * (from.z() - z) - radius * radius);
        if (inside < 0.0) continue;
        const double t = -b - std::sqrt(inside);
        if (t < expected) expected = t, grazing = std::sqrt(inside) / radius, head += z == kHead;
      }
      if (!(grazing > 0.15)) continue;
      const double z = height_at(*rail, X, {0.0, y});
      // round the neck splines are off by what the kink is rounded
      const Vec3 p = X.apply({0.0, y, expected});
      const double neck = std::hypot(std::fabs(p.y()) - 0.01452, p.z() - 0.03375);
      EXPECT_NEAR(z, expected, (neck < 4.0 * kVoxel ? 1.0 : kTenthOfVoxel) * kVoxel / grazing) << roll << ' ' << y;
      ++seen;
    }
    EXPECT_GT(seen, 80);
    EXPECT_GT(head, 20);
  }
}

TEST(LevelSetSurface, NormalsCurvaturesAndParametersAreThoseOfTheShape) {
  constexpr double kLarge = 0.05, kSmall = 0.02;
  const Distance distance = [](const Vec3& p) { return torus(p, kLarge, kSmall); };
  const auto wheel = of_formula(distance, {-0.075, -0.025, -0.075}, {0.075, 0.025, 0.075}, 0.5e-3, Facing::down);
  const Pose X{Vec3::Zero(), rotation({0.1, 0.0, 0.3})};
  std::vector<Vec2> points;
  for (double x = -0.02; x < 0.02; x += 0.0031)
    for (double y = -0.012; y < 0.012; y += 0.0017) points.emplace_back(x, y);
  std::vector<SurfacePoint> found(points.size());
  wheel->locate(X, points, found);
  std::vector<Vec2> uv;
  for (const SurfacePoint& p : found) {
    ASSERT_EQ(p.status, LocateStatus::ambiguous) << "the far side of the ring lies behind";
    const double r = std::hypot(p.position_S.x(), p.position_S.z()), cosine = (r - kLarge) / kSmall;
    const Vec3 normal = (p.position_S - kLarge / r * Vec3(p.position_S.x(), 0.0, p.position_S.z())).normalized();
    EXPECT_LT((p.normal_S - normal).norm(), 2e-4);
    EXPECT_NEAR(p.curvature_1, 1.0 / kSmall, 1.5);
    EXPECT_NEAR(p.curvature_2, cosine / r, 1.5);
    EXPECT_NEAR(p.u, std::atan2(p.position_S.x(), p.position_S.z()), 1e-15);
    uv.emplace_back(p.u, p.v);
  }
  std::vector<SurfaceJet> jets(uv.size());
  ASSERT_TRUE(has_exact_derivatives(*wheel));
  evaluate(*wheel, uv, jets);
  for (std::size_t i = 0; i < uv.size(); ++i) {
    EXPECT_LT((jets[i].p - found[i].position_S).norm(), 1e-12);
    const SurfaceShape shape = shape_of(jets[i]);
    EXPECT_LT((shape.normal - found[i].normal_S).norm(), 1e-9);
    EXPECT_NEAR(shape.curvature_1, found[i].curvature_1, 1e-6);
    EXPECT_NEAR(shape.curvature_2, found[i].curvature_2, 1e-6);
    // differences of the point itself
    const double step = 1e-6;
    std::vector<Vec2> beside{uv[i] + Vec2(step, 0.0), uv[i] - Vec2(step, 0.0), uv[i] + Vec2(0.0, step),
                             uv[i] - Vec2(0.0, step)};
    std::vector<SurfaceJet> at(4);
    evaluate(*wheel, beside, at);
    EXPECT_LT(((at[0].p - at[1].p) / (2.0 * step) - jets[i].pu).norm(), 1e-6);
    EXPECT_LT(((at[2].p - at[3].p) / (2.0 * step) - jets[i].pv).norm(), 1e-6);
  }
}

/// Random rectangles in random planes: no height lies outside of the bounds, and where nothing can be there is nothing.
TEST(LevelSetSurface, BoundsHoldEveryHeight) {
  const auto rail = of_formula(cylinder, kCylinderLow, kCylinderHigh, 0.7e-3, Facing::up);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int covered = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Pose X{{0.0, 0.0, 0.015}, rotation({6.28 * unit(random), unit(random) - 0.5, unit(random) - 0.5})};
    const double width = std::pow(10.0, -4.0 + 2.5 * unit(random)), x = 0.02 * (unit(random) - 0.5),
                 y = 0.04 * (unit(random) - 0.5);
    const HeightBounds b = rail->height_bounds(X, {x, x + width, y, y + width});
    std::vector<double> z(49);
    rail->heights({X, {x, y, width / 6.0, width / 6.0, 7, 7}}, {z, {}, {}});
    for (const double height : z) {
      if (std::isnan(height)) continue;
      ASSERT_FALSE(b.empty);
      EXPECT_GE(height, b.z_min);
      EXPECT_LE(height, b.z_max);
      ++covered;
    }
  }
  EXPECT_GT(covered, 5000);
}

/// A flat sheet of triangles: nothing beyond its rim, which lies where the triangles end.
TEST(LevelSetSurface, OpenTrianglesEndAtTheirRim) {
  constexpr double kVoxel = 0.5e-3;
  TriangleMesh sheet;
  sheet.name = "sheet";
  sheet.vertices = {{-0.01, -0.02, 0.0}, {0.01, -0.02, 0.0}, {0.01, 0.02, 0.002}, {-0.01, 0.02, 0.002}};
  sheet.triangles = {{0, 2, 1}, {0, 3, 2}};  // facing up, -z
  const auto rail = make_level_set_surface(sheet, Body::rail, kVoxel, "level-set");
  for (const double y : {-0.0199, -0.013, 0.0, 0.011, 0.0199})
    EXPECT_NEAR(height_at(*rail, {}, {0.0013, y}), 0.001 + 0.05 * y, 1e-9);
  for (const Vec2& beside : {Vec2(0.0, 0.02005), Vec2(0.0, -0.02005), Vec2(0.01005, 0.003), Vec2(-0.01005, 0.003)})
    EXPECT_TRUE(std::isnan(height_at(*rail, {}, beside))) << beside;
  EXPECT_TRUE(rail->height_bounds({}, {0.0, 0.005, 0.021, 0.025}).empty);
  // from below it shows its inside
  EXPECT_TRUE(std::isnan(height_at(*rail, {Vec3::Zero(), rotation({kPi, 0.0, 0.0})}, {0.0, 0.0})));
}

TEST(LevelSetSurface, WhatIsNoSurfaceIsRefused) {
  const auto refusal = [](const DistanceGrid& grid) {
    return refusal_of([&] { levelset::DistanceField field{grid}; }, ErrorKind::input_data);
  };
  EXPECT_THAT(refusal(sampled(cylinder, kCylinderLow, kCylinderHigh, 1e-3, 1.5)), HasSubstr("too narrow"));
  EXPECT_THAT(refusal(sampled([](const Vec3&) { return 2e-3; }, Vec3::Zero(), Vec3::Constant(0.01), 1e-3)),
              HasSubstr("no surface"));
  EXPECT_THAT(refusal({}), HasSubstr("no surface"));
  const auto of_mesh = [](const TriangleMesh& mesh) {
    return refusal_of([&] { make_level_set_surface(mesh, Body::rail, 1e-3, "level-set"); }, ErrorKind::input_data);
  };
  EXPECT_THAT(of_mesh({}), HasSubstr("is empty"));
  TriangleMesh box = box_mesh(Vec3::Zero(), Vec3::Constant(0.02));
  std::swap(box.triangles[3][0], box.triangles[3][1]);
  EXPECT_THAT(of_mesh(box), HasSubstr("do not agree"));
  box = box_mesh(Vec3::Zero(), Vec3::Constant(0.02));
  box.triangles.push_back({0, 3, 6});
  box.triangles.push_back({0, 1, 6});
  EXPECT_THAT(of_mesh(box), HasSubstr("an edge of 3"));
  EXPECT_THAT(of_mesh(box_mesh(Vec3::Zero(), Vec3::Constant(2e5))), HasSubstr("metres"));
  box.triangles.back()[0] = 99;
  EXPECT_THAT(of_mesh(box), HasSubstr("does not have"));
}

}  // namespace
}  // namespace treadmark::testing
