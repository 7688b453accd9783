// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Arc chains as NURBS, which are exact, against formulas and against the closed forms of the analytic backend.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/backends/spline/test_planes.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using testing::kRadius;
using treadmark::testing::Fields;

constexpr double kNurbsRounding = 1e-13;  // [m] coordinates of up to 1 m, a few operations each

SurfacePoint locate_at(const Surface& surface, const Pose& X, const Vec2& p) {
  SurfacePoint out;
  surface.locate(X, {&p, 1}, {&out, 1});
  return out;
}

/// Head of a rail: 300, 80 and 13 mm, then a side that leans inwards below (undercut).
ArcChain rail_head_chain() {
  ArcChain chain;
  const double turns[] = {10e-3 / 0.3, 16e-3 / 0.08, 1.5};
  chain.segments = {{0.013 * turns[2], 1 / 0.013}, {0.08 * turns[1], 1 / 0.08}, {0.3 * turns[0], 1 / 0.3},
                    {0.3 * turns[0], 1 / 0.3},     {0.08 * turns[1], 1 / 0.08}, {0.013 * turns[2], 1 / 0.013}};
  chain.start_angle = -(turns[0] + turns[1] + turns[2]);
  chain.segments.insert(chain.segments.begin(), {0.01, 0.0});
  chain.segments.push_back({0.01, 0.0});
  // crown at the origin: walk back from it
  const std::shared_ptr<const Surface> there = analytic::make_prismatic_surface(chain);
  const Box3 box = there->bounds();
  chain.start_y = -0.5 * (box.min.y() + box.max.y());
  chain.start_z = -box.min.z();
  return chain;
}

/// A tread with a hollow root and a steep flange.
ArcChain flange_chain() {
  ArcChain chain;
  chain.start_y = -0.05;
  chain.start_z = 0.024;
  chain.start_angle = 0.8;
  chain.segments = {{0.012 * 2.0, -1 / 0.012}, {0.014 * 1.18, 1 / 0.014}, {0.03, 0.0}, {0.3 * 0.06, -1 / 0.3}};
  return chain;
}

/// Largest difference of heights, relative to steepness, and misses of one only, in all planes.
void expect_same_heights(const Surface& found, const Surface& expected, const std::vector<Pose>& planes,
                         double tolerance) {
  // next to a silhouette the two may disagree about what is hit within rounding
  constexpr double kSilhouette = 1e3;
  int compared = 0, steep = 0;
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const Fields a = treadmark::testing::heights(found, planes[plane], treadmark::testing::odd_grid());
    const Fields b = treadmark::testing::heights(expected, planes[plane], treadmark::testing::odd_grid());
    for (std::size_t i = 0; i < a.z.size(); ++i) {
      const double slope = std::hypot(b.dzdx[i], b.dzdy[i]);
      ASSERT_EQ(std::isnan(a.z[i]), std::isnan(b.z[i])) << "plane " << plane << " point " << i;
      if (std::isnan(a.z[i]) || slope > kSilhouette) continue;
      ASSERT_NEAR(a.z[i], b.z[i], tolerance * (1.0 + slope * slope))
          << "plane " << plane << " point " << i << " slope " << slope;
      const double scale = std::pow(1.0 + slope * slope, 2.0);
      ASSERT_NEAR(a.dzdx[i], b.dzdx[i], 1e-9 * scale) << "plane " << plane << " point " << i;
      ASSERT_NEAR(a.dzdy[i], b.dzdy[i], 1e-9 * scale) << "plane " << plane << " point " << i;
      ++compared;
      steep += slope > 1.0;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(steep, 50);
}

TEST(NurbsExact, CylinderRailInClosedForm) {
  constexpr double R = 0.3;
  const auto rail = make_nurbs_surface(analytic::cylinder_chain(R, 1.2), Body::rail, 0.0);
  EXPECT_EQ(rail->backend(), "nurbs");
  EXPECT_EQ(rail->facing(), Facing::up);
  for (const double roll : {0.0, 0.1, -0.7}) {
    // turned about its own axis the cylinder stays what it is
    const Pose X{Vec3(0.2, 0.0, R) - rotation_x(roll) * Vec3(0.0, 0.0, R), rotation_x(roll)};
    for (const double y : {-0.05, 0.0, 0.013, 0.09})
      EXPECT_NEAR(height_at(*rail, X, {0.3, y}), R - std::sqrt(R * R - y * y), kNurbsRounding) << roll;
  }
  EXPECT_TRUE(std::isnan(height_at(*rail, {}, {1.0001, 0.0})));
  EXPECT_TRUE(std::isnan(height_at(*rail, {}, {0.0, R * std::sin(1.2) + 1e-6})));
  EXPECT_FALSE(std::isnan(height_at(*rail, {}, {0.9999, R * std::sin(1.2) - 1e-6})));
  const SurfacePoint p = locate_at(*rail, {{0.5, 0.0, -0.1}, Mat3::Identity()}, {0.1, 0.06});
  EXPECT_EQ(p.status, LocateStatus::converged);
  EXPECT_NEAR(p.u, 0.6, 1e-13);
  EXPECT_NEAR(p.normal_S.y(), 0.06 / R, 1e-12);
  EXPECT_NEAR(p.normal_S.z(), -std::sqrt(1.0 - 0.04), 1e-12);
  EXPECT_NEAR(p.curvature_1, 1.0 / R, 1e-9);
  EXPECT_NEAR(p.curvature_2, 0.0, 1e-9);
}

TEST(NurbsExact, BallAndTorusWheelInClosedForm) {
  constexpr double R = 0.25;
  const auto ball = make_nurbs_surface(analytic::barrel_chain(R, 1.3), Body::wheel, R);
  EXPECT_EQ(ball->facing(), Facing::down);
  const Mat3 turn = rotation({0.4, -0.9, 0.6});
  const Pose X{turn * Vec3(0.0, 0.0, R), turn};
  for (const auto& p : {Vec2(0.0, 0.0), Vec2(0.03, -0.05), Vec2(-0.1, 0.02)}) {
    EXPECT_NEAR(height_at(*ball, X, p), std::sqrt(R * R - p.squaredNorm()) - R, kNurbsRounding);
    const SurfacePoint q = locate_at(*ball, X, p);
    EXPECT_EQ(q.status, LocateStatus::converged);
    EXPECT_LT((q.normal_S - q.position_S / R).norm(), 1e-12);
    EXPECT_NEAR(q.curvature_1, 1.0 / R, 1e-8);
    EXPECT_NEAR(q.curvature_2, 1.0 / R, 1e-8);
    EXPECT_NEAR(q.u, std::atan2(q.position_S.x(), q.position_S.z()), 1e-14);
  }
  // a torus: tube radius a, circle of tube centres of radius kRadius - a; level plane, over the axle's height
  constexpr double a = 0.1;
  const auto torus = make_nurbs_surface(analytic::barrel_chain(a, 1.0), Body::wheel, kRadius);
  for (const double x : {-0.3, 0.0, 0.11})
    for (const double y : {-0.05, 0.0, 0.03, 0.08}) {
      const double r = kRadius - a + std::sqrt(a * a - y * y);
      EXPECT_NEAR(height_at(*torus, {}, {x, y}), std::sqrt(r * r - x * x), kNurbsRounding);
    }
}

TEST(NurbsExact, RailsHaveTheHeightsOfTheAnalyticBackend) {
  const auto planes = treadmark::testing::rail_planes();
  const ArcChain two_arcs{
      -0.06 * std::sin(0.5), 0.06 * (1.0 - std::cos(0.5)), -0.5, {{0.06 * 0.5, 1.0 / 0.06}, {0.3 * 0.1, 1.0 / 0.3}}};
  for (const ArcChain& chain : {two_arcs, rail_head_chain()})
    expect_same_heights(*make_nurbs_surface(chain, Body::rail, 0.0), *analytic::make_prismatic_surface(chain), planes,
                        1e-12);
}

TEST(NurbsExact, WheelsHaveTheHeightsOfTheAnalyticBackend) {
  const auto planes = treadmark::testing::wheel_planes(kRadius);
  for (const ArcChain& chain : {analytic::barrel_chain(0.05, 0.8), flange_chain()})
    expect_same_heights(*make_nurbs_surface(chain, Body::wheel, kRadius),
                        *analytic::make_revolved_surface(chain, kRadius), planes, 1e-12);
}

TEST(NurbsExact, ScatteredHeightsAreThoseOfGrids) {
  using treadmark::testing::expect_heights_at_gives_heights;
  EXPECT_GT(expect_heights_at_gives_heights(*make_nurbs_surface(rail_head_chain(), Body::rail, 0.0),
                                            treadmark::testing::rail_planes()),
            3000);
  EXPECT_GT(expect_heights_at_gives_heights(*make_nurbs_surface(flange_chain(), Body::wheel, kRadius),
                                            treadmark::testing::wheel_planes(kRadius)),
            3000);
}

TEST(NurbsExact, OnlyTheHalfTowardsThePlaneIsHit) {
  // a line through the open side of a wheel would hit its far half from inside
  const auto wheel = make_nurbs_surface(analytic::straight_chain(0.05), Body::wheel, kRadius);
  const Pose X{{0.0, -0.3, 0.46}, rotation_x(0.5)};
  EXPECT_TRUE(std::isnan(height_at(*wheel, X, {0.0, 0.0})));
  EXPECT_TRUE(std::isnan(height_at(*wheel, {}, {0.4601, 0.0})));
  EXPECT_NEAR(height_at(*wheel, {}, {0.4599, 0.0}), std::sqrt(kRadius * kRadius - 0.4599 * 0.4599), 1e-11);
  // from any side
  for (double pitch = -3.0; pitch < 3.1; pitch += 0.37) {
    const Mat3 turn = rotation_y(pitch);
    EXPECT_NEAR(height_at(*wheel, {turn * Vec3(0, 0, kRadius), turn}, {0.02, 0.01}),
                std::sqrt(kRadius * kRadius - 4e-4) - kRadius, kNurbsRounding);
  }
}

TEST(NurbsExact, InverseOfEvaluation) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const NurbsSurface wheel(revolve_chain(flange_chain(), kRadius), Body::wheel);
  const NurbsSurface rail(sweep_chain(rail_head_chain(), -1.0, 1.0), Body::rail);
  int found = 0;
  for (const NurbsSurface* surface : {&wheel, &rail}) {
    const NurbsNet& net = surface->net();
    for (int trial = 0; trial < 300; ++trial) {
      const bool is_wheel = surface == &wheel;
      const double u = is_wheel ? -1.0 + 2.0 * unit(random) : -0.9 + 1.8 * unit(random);
      const double v = net.range(0, 0).v0 + (net.range(0, net.patches_v() - 1).v1 - net.range(0, 0).v0) * unit(random);
      const SurfaceDerivatives at = surface->derivatives(u, v);
      // a plane that faces the point, at an angle
      Vec3 normal = at.pu.cross(at.pv).normalized();
      Pose X;
      X.rotation.col(2) = normal;
      X.rotation.col(1) = normal.cross(at.pu).normalized();
      X.rotation.col(0) = X.rotation.col(1).cross(normal);
      X.rotation = X.rotation * rotation({unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5});
      if (is_wheel && at.p.x() * X.rotation(0, 2) + at.p.z() * X.rotation(2, 2) < 0.0)
        continue;  // on the far half of the wheel
      X.origin = at.p + 0.01 * X.rotation * Vec3(unit(random), unit(random), unit(random));
      const Vec3 in_plane = X.apply_inverse(at.p);
      SurfacePoint p = locate_at(*surface, X, {in_plane.x(), in_plane.y()});
      ASSERT_NE(p.status, LocateStatus::outside) << u << ' ' << v;
      if ((p.position_S - at.p).norm() > 1e-6) continue;  // something lies in front of it
      ++found;
      EXPECT_NEAR(p.u, is_wheel ? std::atan2(at.p.x(), at.p.z()) : u, 1e-11);
      EXPECT_NEAR(p.v, v, 1e-11);
      EXPECT_LT((p.position_S - at.p).norm(), 1e-12);
    }
  }
  EXPECT_GT(found, 400);
}

TEST(NurbsExact, FoldsGiveTheOutermostHitAndAreReported) {
  const auto rail = make_nurbs_surface(rail_head_chain(), Body::rail, 0.0);
  const auto oracle = analytic::make_prismatic_surface(rail_head_chain());
  const double widest = oracle->bounds().max.y();
  int ambiguous = 0;
  for (const double inside : {1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
    const double y = widest - inside;
    const SurfacePoint p = locate_at(*rail, {}, {0.0, y});
    const double z = height_at(*oracle, {}, {0.0, y}), steep = 1.0 / std::sqrt(inside);
    EXPECT_NEAR(p.position_S.z(), z, 1e-14 * steep * steep);
    EXPECT_NEAR(height_at(*rail, {}, {0.0, y}), z, 1e-14 * steep * steep) << inside;
    ambiguous += p.status == LocateStatus::ambiguous;
  }
  EXPECT_EQ(ambiguous, 5);  // the side leans inwards by 1.6 mm
  EXPECT_TRUE(std::isnan(height_at(*rail, {}, {0.0, widest + 1e-9})));
}

TEST(NurbsExact, PlaneSeenEdgeOnMeetsNothing) {
  const auto rail = make_nurbs_surface(rail_head_chain(), Body::rail, 0.0);
  const Pose along{{0.0, 0.0, 0.0}, rotation_y(std::acos(-1.0) / 2)};
  EXPECT_TRUE(std::isnan(height_at(*rail, along, {0.0, 0.0})));
  EXPECT_TRUE(std::isnan(height_at(*rail, along, {0.01, 0.02})));
  const auto wheel = make_nurbs_surface(flange_chain(), Body::wheel, kRadius);
  const Pose axle{{0.0, 0.0, kRadius}, rotation_x(std::acos(-1.0) / 2)};
  EXPECT_TRUE(std::isnan(height_at(*wheel, axle, {0.0, -0.01})));
  EXPECT_TRUE(wheel->height_bounds(axle, {0.0, 0.001, -0.01, 0.0}).empty);
}

TEST(NurbsExact, AlmostEdgeOnIsStillExact) {
  // lines that run along the rail, and meet it after up to a metre: the closed form tells where
  const auto rail = make_nurbs_surface(rail_head_chain(), Body::rail, 0.0);
  const auto oracle = analytic::make_prismatic_surface(rail_head_chain());
  int hits = 0;
  for (const double angle : {1e-2, 1e-4, 1e-6}) {
    const Pose X{{-0.5, 0.0, -1e-7}, rotation_y(std::acos(-1.0) / 2 - angle)};
    for (const double y : {-0.02, -1e-3, 0.0, 0.013})
      for (const double x : {0.0, -1e-7, -1e-3}) {
        const double expected = height_at(*oracle, X, {x, y}), found = height_at(*rail, X, {x, y});
        const Vec3 p = X.apply({x, y, expected});
        if (std::abs(p.x()) > 0.999) continue;  // beyond the end, or close to it
        ++hits;
        EXPECT_NEAR(found, expected, 1e-14 / angle) << angle << ' ' << x << ' ' << y;
      }
  }
  EXPECT_GT(hits, 4);
}

TEST(NurbsExact, PointsThatAreNoNumbersAreMisses) {
  const auto wheel = make_nurbs_surface(flange_chain(), Body::wheel, kRadius);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<Vec2> points{{kNaN, 0.0}, {0.0, 0.0}, {0.0, kInfinity}, {kNaN, kNaN}};
  Fields f(points.size());
  wheel->heights_at({}, points, f.out());
  EXPECT_FALSE(std::isnan(f.z[1]));
  for (const std::size_t i : {0u, 2u, 3u}) EXPECT_TRUE(std::isnan(f.z[i]));
  wheel->heights_at({}, std::span(points).last(1), {std::span(f.z).first(1), {}, {}});
  EXPECT_TRUE(std::isnan(f.z[0]));
}

TEST(NurbsExact, BadChainsAreRefused) {
  const ArcChain good = analytic::cylinder_chain(0.3, 0.5);
  EXPECT_THROW(make_nurbs_surface(ArcChain{}, Body::rail, 0.0), Error);
  EXPECT_THROW(make_nurbs_surface(good, Body::rail, 0.0, 1.0, 1.0), Error);
  EXPECT_THROW(make_nurbs_surface(good, Body::rail, 0.0, 0.0, std::numeric_limits<double>::infinity()), Error);
  EXPECT_THROW(make_nurbs_surface(good, Body::wheel, 0.0), Error);
  EXPECT_THROW(make_nurbs_surface(analytic::barrel_chain(0.3, 1.2), Body::wheel, 0.1), Error);
  ArcChain bad = good;
  bad.segments[0].length = -1.0;
  EXPECT_THROW(make_nurbs_surface(bad, Body::rail, 0.0), Error);
  bad.segments[0] = {1.0, 7.0};
  EXPECT_THROW(make_nurbs_surface(bad, Body::rail, 0.0), Error);
}

}  // namespace
}  // namespace treadmark::spline
