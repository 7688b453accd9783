// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Shapes that splines represent exactly, in closed form.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>

#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/prismatic_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using testing::kRadius;

constexpr double kExact = 1e-12;

SliceSet same_slices(const Profile& profile, int count, double first, double step) {
  SliceSet set;
  set.body = profile.body;
  set.name = "constant";
  for (int i = 0; i < count; ++i) set.u.push_back(first + i * step), set.profiles.push_back(profile);
  return set;
}

TEST(ExactShapes, PlaneInAnyPlane) {
  const Profile roof = testing::graph_profile(Body::rail, -0.3, 0.3, 5, [](double y) { return 0.2 * y + 0.01; });
  const auto prismatic = make_profile_surface(roof, 0.0);
  const auto slices = make_slice_surface(same_slices(roof, 5, -0.1, 0.05), 0.0);
  const Vec3 normal = Vec3(0.0, 0.2, -1.0).normalized(), on_plane(0.0, 0.0, 0.01);
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose pose = testing::random_pose(random, 0.9, 0.5, 0.4, 0.02);
    for (const Vec2& p : {Vec2(0, 0), Vec2(0.02, -0.03), Vec2(-0.05, 0.04)}) {
      const Vec3 foot = pose.apply({p.x(), p.y(), 0.0});
      const double expected = normal.dot(on_plane - foot) / normal.dot(pose.rotation.col(2));
      EXPECT_NEAR(height_at(*prismatic, pose, p), expected, kExact);
      EXPECT_NEAR(height_at(*slices, pose, p), expected, kExact);
    }
  }
}

TEST(ExactShapes, CylinderWheelInAnyPlane) {
  const Profile tread = testing::graph_profile(Body::wheel, 0.065, -0.065, 2, [](double) { return 0.0; });
  const auto round = make_profile_surface(tread, kRadius);
  const auto slices = make_slice_surface(same_slices(tread, 64, -3.1, 6.2 / 63), kRadius);
  for (const double x : {-0.2, -0.05, 0.0, 0.013, 0.11}) {
    EXPECT_NEAR(height_at(*round, {}, {x, 0.01}), std::sqrt(kRadius * kRadius - x * x), kExact);
    EXPECT_NEAR(height_at(*slices, {}, {x, 0.01}), std::sqrt(kRadius * kRadius - x * x), kExact);
  }
  std::mt19937 random(8);
  int hits = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Pose pose = testing::random_pose(random, 1.2, 0.3, 0.5, 0.02);
    pose.origin.z() += kRadius;
    // |(p + n d)_xz| = R, the greater root.
    const Vec3 d = pose.rotation.col(2);
    for (const Vec2& p : {Vec2(0, 0), Vec2(0.02, -0.03), Vec2(-0.05, 0.02)}) {
      const Vec3 foot = pose.apply({p.x(), p.y(), 0.0});
      const double a = d.x() * d.x() + d.z() * d.z(), b = foot.x() * d.x() + foot.z() * d.z();
      const double c = foot.x() * foot.x() + foot.z() * foot.z() - kRadius * kRadius;
      const double n = (-b + std::sqrt(b * b - a * c)) / a;
      const bool hit = std::abs(foot.y() + n * d.y()) <= 0.065;
      hits += hit;
      for (const auto& wheel : {round, slices}) {
        const double found = height_at(*wheel, pose, p);
        ASSERT_EQ(hit, !std::isnan(found));
        if (hit) {
          EXPECT_NEAR(found, n, kExact);
        }
      }
    }
  }
  EXPECT_GT(hits, 60);
}

TEST(ExactShapes, CubicProfileRolled) {
  // Straight segments with one cubic break-free piece given directly: y = s, z = cubic.
  CubicSegment c{{-0.02, 1.0, 0.0, 0.0}, {1e-3, -0.1, 2.0, 30.0}};
  const PrismaticSurface rail(ProfileSpline({-0.02, 0.02}, {c}));
  const auto z = [](double y) {
    const double t = y + 0.02 - 0.0;
    return 1e-3 - 0.1 * t + 2.0 * t * t + 30.0 * t * t * t;
  };
  for (double y = -0.02; y <= 0.02; y += 1.7e-3) EXPECT_NEAR(height_at(rail, {}, {0.3, y}), z(y), 1e-15);
  // Rolled: the point found must lie on the graph.
  const Pose pose{Vec3(0.1, 0.002, 0.003), rotation_x(0.3)};
  for (double y = -0.015; y <= 0.015; y += 1.1e-3) {
    const double n = height_at(rail, pose, {0.0, y});
    const Vec3 p = pose.apply({0.0, y, n});
    EXPECT_NEAR(p.z(), z(p.y()), 1e-14);
  }
}

TEST(ExactShapes, CurvaturesOfACylinderAndATorus) {
  const Profile tread = testing::graph_profile(Body::wheel, 0.065, -0.065, 14, [](double) { return 0.0; });
  for (const auto& wheel :
       {make_profile_surface(tread, kRadius), make_slice_surface(same_slices(tread, 64, -3.1, 6.2 / 63), kRadius)}) {
    SurfacePoint at;
    const Vec2 target(0.1, 0.02);
    wheel->locate({}, {&target, 1}, {&at, 1});
    ASSERT_EQ(at.status, LocateStatus::converged);
    EXPECT_NEAR(at.u, std::asin(0.1 / kRadius), 1e-12);
    EXPECT_NEAR(at.curvature_1, 1.0 / kRadius, 1e-9);
    EXPECT_NEAR(at.curvature_2, 0.0, 1e-9);
    EXPECT_LT((at.normal_S - Vec3(std::sin(at.u), 0.0, std::cos(at.u))).norm(), 1e-12);
  }
  // A crowned wheel (hollow by -1/R_y): curvatures 1/R and 1/R_y at the lowest point.
  constexpr double kCrown = 0.3;
  const Profile crown = testing::graph_profile(Body::wheel, 0.05, -0.05, 201,
                                               [](double y) { return std::sqrt(kCrown * kCrown - y * y) - kCrown; });
  const auto torus = make_profile_surface(crown, kRadius);
  SurfacePoint at;
  const Vec2 origin(0.0, 0.0);
  torus->locate({}, {&origin, 1}, {&at, 1});
  EXPECT_NEAR(at.curvature_1, 1.0 / kCrown, 1e-5);  // second derivative of an interpolating spline, order 2
  EXPECT_NEAR(at.curvature_2, 1.0 / kRadius, 1e-9);
  // A rail of the same crown is convex too.
  const auto rail =
      make_profile_surface(testing::graph_profile(Body::rail, -0.05, 0.05, 201,
                                                  [](double y) { return kCrown - std::sqrt(kCrown * kCrown - y * y); }),
                           0.0);
  rail->locate({}, {&origin, 1}, {&at, 1});
  EXPECT_NEAR(at.curvature_1, 1.0 / kCrown, 1e-5);
  EXPECT_NEAR(at.curvature_2, 0.0, 1e-12);
  EXPECT_LT((at.normal_S - Vec3(0, 0, -1)).norm(), 1e-12);
}

TEST(ExactShapes, SliceSurfaceOfOneProfileEqualsTheProfileSurface) {
  constexpr double kResampled = 2e-8;  // the slices are sampled at 0.5 mm and splined again
  const auto rail = make_profile_surface(
      testing::graph_profile(Body::rail, -0.03, 0.03, 61, [](double y) { return 2 * y * y; }), 0.0);
  const auto slices = make_slice_surface(
      same_slices(testing::graph_profile(Body::rail, -0.03, 0.03, 61, [](double y) { return 2 * y * y; }), 6, 0.0, 0.1),
      0.0);
  PlaneGrid plane{{Vec3(0.2, 0, 0), rotation({0.1, 0.02, 0.01})}, {-0.01, -0.02, 2e-3, 1e-3, 11, 41}};
  std::vector<double> a(plane.grid.size()), b(a);
  rail->heights(plane, {a, {}, {}});
  slices->heights(plane, {b, {}, {}});
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], kResampled);
}

TEST(ExactShapes, RigidMotionOfPlaneAlongTheRailChangesNothing) {
  const auto rail = make_profile_surface(testing::rail_head(), 0.0);
  const Pose pose{Vec3(0.0, 0.001, 0.002), rotation({0.2, 0.05, 0.02})};
  Pose moved = pose;
  moved.origin.x() += 123.0;
  for (double y = -0.03; y < 0.03; y += 4e-3)
    EXPECT_NEAR(height_at(*rail, moved, {0.01, y}), height_at(*rail, pose, {0.01, y}), 1e-13);
}

TEST(ExactShapes, LookingAlongTheRailMissesEverything) {
  Pose along;
  along.rotation = rotation_y(std::acos(-1.0) / 2);
  const auto prismatic = make_profile_surface(testing::rail_head(), 0.0);
  const auto bending = make_slice_surface(testing::bending_rail(), 0.0);
  EXPECT_TRUE(std::isnan(height_at(*prismatic, along, {0, 0})));
  EXPECT_TRUE(prismatic->height_bounds(along, {0, 1, 0, 1}).empty);
  SurfacePoint at;
  const Vec2 target(0.0, 0.0);
  prismatic->locate(along, {&target, 1}, {&at, 1});
  EXPECT_EQ(at.status, LocateStatus::outside);
  // A surface from slices does end steps in x, but a line along it may be told a miss; it must not be a wrong hit.
  const double n = height_at(*bending, along, {0, 0});
  EXPECT_TRUE(std::isnan(n) || std::isfinite(n));
}

TEST(ExactShapes, FoldsGiveTheOutermostHitAndAreReported) {
  const auto rail = make_profile_surface(testing::rail_head(), 0.0);
  const double y = 35.5e-3;  // over the undercut side, 0.4 mm inside its widest place
  SurfacePoint at;
  const Vec2 target(0.0, y);
  rail->locate({}, {&target, 1}, {&at, 1});
  EXPECT_EQ(at.status, LocateStatus::ambiguous);
  EXPECT_LT(at.position_S.z(), 20e-3);
  EXPECT_NEAR(height_at(*rail, {}, target), at.position_S.z(), 1e-13);
}

TEST(ExactShapes, ThreadsChangeNothing) {
  const auto wheel = make_slice_surface(testing::dented_wheel(), kRadius);
  PlaneGrid plane{{Vec3(0, 0, kRadius), rotation({0.02, 0.01, 0.6})}, {-0.05, -0.05, 1e-3, 1e-3, 100, 90}};
  plane.X_SP.origin = rotation_y(0.6) * plane.X_SP.origin;
  std::vector<double> one(plane.grid.size()), many(one);
  {
    const ThreadLimit limit(1);
    wheel->heights(plane, {one, {}, {}});
  }
  const ThreadLimit limit(4);
  wheel->heights(plane, {many, {}, {}});
  EXPECT_EQ(0, std::memcmp(one.data(), many.data(), one.size() * sizeof(double)));
}

TEST(ExactShapes, AWheelNeedsAPositiveRadius) {
  EXPECT_THROW(make_profile_surface(testing::flanged_wheel(), 0.0), Error);
  EXPECT_THROW(make_slice_surface(testing::dented_wheel(), 0.001), Error);
}

}  // namespace
}  // namespace treadmark::spline
