// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"

// Rollers against closed formulas, and against the straight rail that they become.

namespace treadmark {
namespace {

constexpr double kPi = std::numbers::pi;

ArcChain barrel(double radius, double half_angle) {
  return {-radius * std::sin(half_angle),
          radius * (1.0 - std::cos(half_angle)),
          -half_angle,
          {{2.0 * radius * half_angle, 1.0 / radius}}};
}

SurfaceSpec roller(ArcChain chain, double radius) { return {Body::rail, 0.0, std::move(chain), {}, radius}; }

/// The plane that touches the nominal circle of a roller at an angle from its top.
Pose at_angle(double radius, double theta) {
  return {{radius * std::sin(theta), 0.0, radius * (1.0 - std::cos(theta))}, rotation_y(-theta)};
}

TEST(Roller, ACylinderIsACircleInEveryBackend) {
  constexpr double kRadius = 0.3, kTolerance = 2e-6;  // facets: h^2/(8 R)
  const NaturalSurface natural = create_natural(roller({-0.015, 0.0, 0.0, {{0.03, 0.0}}}, kRadius));
  for (const std::string_view backend : backend_names()) {
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(natural, {std::string(backend), 2e-3, {}});
    EXPECT_EQ(r.surface->backend(), backend);
    EXPECT_EQ(r.surface->facing(), Facing::up);
    for (const double x : {-0.2, -0.01, 0.0, 0.0003, 0.15})
      EXPECT_NEAR(height_at(*r.surface, {}, {x, 0.007}), kRadius - std::sqrt(kRadius * kRadius - x * x),
                  3.0 * kTolerance)
          << x;
    // all round, as samples of a closed wheel
    for (double theta = -3.1; theta < 3.2; theta += 0.31)
      EXPECT_NEAR(height_at(*r.surface, at_angle(kRadius, theta), {0.0, -0.011}), 0.0, kTolerance) << theta;
    EXPECT_TRUE(std::isnan(height_at(*r.surface, {}, {kRadius + 0.001, 0.0})));
    EXPECT_TRUE(std::isnan(height_at(*r.surface, {}, {0.0, 0.016})));
  }
}

TEST(Roller, CurvaturesOfABarrelAreThoseOfItsCircles) {
  constexpr double kRadius = 0.25, kCrown = 0.1;
  const NaturalSurface natural = create_natural(roller(barrel(kCrown, 0.3), kRadius));
  for (const std::string backend : {"analytic", "spline", "nurbs"}) {
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(natural, {backend, 0.0, {}});
    const double alpha = 0.12, y = kCrown * std::sin(alpha);
    std::vector<SurfacePoint> p(2);
    r.surface->locate({}, std::vector<Vec2>{{0.0, 0.0}, {0.0, y}}, p);
    EXPECT_NEAR(p[0].curvature_1, 1.0 / kCrown, 1e-3);
    EXPECT_NEAR(p[0].curvature_2, 1.0 / kRadius, 1e-4);
    EXPECT_LE((p[0].normal_S - Vec3(0.0, 0.0, -1.0)).norm(), 1e-6);
    // Meusnier: the parallel circle of radius rho is inclined by alpha
    const double rho = kRadius - kCrown * (1.0 - std::cos(alpha));
    EXPECT_NEAR(p[1].curvature_2, std::cos(alpha) / rho, 1e-3);
    EXPECT_LE((p[1].normal_S - Vec3(0.0, std::sin(alpha), -std::cos(alpha))).norm(), 1e-5);
    EXPECT_LE((p[1].position_S - Vec3(0.0, y, kRadius - rho)).norm(), 1e-8);
  }
}

TEST(Roller, AVeryLargeOneIsAStraightRail) {
  constexpr double kRadius = 1e5;
  const NaturalSurface rail = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  const NaturalSurface large = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}, kRadius});
  for (const double roll : {0.0, 0.025, -0.6, -1.2}) {
    const Pose X{{0.0, -0.02, 0.004}, rotation({roll, 0.0, 0.0})};
    int compared = 0;
    for (double x = -0.05; x < 0.06; x += 0.025)
      for (double y = -0.03; y < 0.04; y += 0.0031) {
        const double straight = height_at(*rail.surface, X, {x, y}), round = height_at(*large.surface, X, {x, y});
        ASSERT_EQ(std::isnan(straight), std::isnan(round));
        if (std::isnan(straight)) continue;
        // the circle sinks by x^2/(2 R), 12.5 nm here, along z; on a slanted line by more
        std::vector<SurfacePoint> p(1);
        rail.surface->locate(X, std::vector<Vec2>{{x, y}}, p);
        const double sink = x * x / (2.0 * kRadius) * p[0].normal_S.z() / p[0].normal_S.dot(X.rotation.col(2));
        EXPECT_NEAR(round, straight + sink, 2e-10) << x << ' ' << y;
        ++compared;
      }
    EXPECT_GT(compared, 50);
  }
}

TEST(Roller, IsNotPrismaticForAnybodyWhoAsks) {
  const NaturalSurface natural = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}, 0.5});
  EXPECT_FALSE(natural.constant_profile());
  EXPECT_FALSE(natural.surface->constant_profile());
  EXPECT_NEAR(natural.surface->bounds().min.z(), 0.0, 1e-9);
  EXPECT_NEAR(natural.surface->bounds().max.z(), 1.0, 1e-9);
  EXPECT_GE(natural.surface->bounds().max.x(), 0.5 - 1e-9);
}

TEST(Roller, SamplesOfARegionLieOnItAndSaySo) {
  constexpr double kRadius = 0.5;
  const NaturalSurface natural = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}, kRadius});
  Region region;
  region.u_min = -0.05;
  region.u_max = 0.04;
  for (const std::string_view backend : backend_names()) {
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(natural, {std::string(backend), 0.7e-3, region});
    EXPECT_LE(r.region.u_min, region.u_min);
    EXPECT_GE(r.region.u_max, region.u_max);
    for (const double x : {-0.0499, 0.0, 0.0399}) EXPECT_FALSE(std::isnan(height_at(*r.surface, {}, {x, 0.001}))) << x;
    if (!r.resampled) continue;
    const SurfaceDifference d = fit_error(natural, r);
    EXPECT_GT(d.points, 1000u);
    EXPECT_EQ(d.missing, 0u);
    EXPECT_LE(d.height_max, 6e-6);
    EXPECT_LE(std::fabs(d.worst_u), kRadius * kPi);
  }
}

TEST(Roller, TrianglesAndSlicesComeBackAsTheSameRoller) {
  constexpr double kRadius = 0.4;
  const NaturalSurface natural = create_natural(roller(barrel(0.2, 0.15), kRadius));
  Region region;
  region.u_min = -0.03;
  region.u_max = 0.03;
  Sampled sampled;
  const Representation wanted{"", 1e-3, region};
  SurfaceSpec again{Body::rail, 0.0, to_triangles(natural, wanted, &sampled), {}, kRadius};
  for (const Vec3& v : std::get<TriangleMesh>(again.shape).vertices) {
    const double profile = 0.2 - std::sqrt(0.2 * 0.2 - v.y() * v.y());
    ASSERT_NEAR(std::hypot(v.x(), v.z() - kRadius), kRadius - profile, 1e-12);
  }
  EXPECT_NEAR(sampled.region.u_max, 0.03, 2e-3);
  const auto compare = [&](const NaturalSurface& other) {
    for (double x = -0.025; x < 0.03; x += 0.01)
      for (double y = -0.025; y < 0.03; y += 0.01)
        EXPECT_NEAR(height_at(*other.surface, {}, {x, y}), height_at(*natural.surface, {}, {x, y}), 5e-8)
            << x << ' ' << y;
  };
  compare(create_natural(again));
  again.shape = to_slices(natural, wanted, &sampled);
  const auto& slices = std::get<SliceSet>(again.shape);
  EXPECT_EQ(slices.body, Body::rail);
  EXPECT_NEAR(slices.u.front(), -0.03, 2e-3);
  compare(create_natural(again));
}

TEST(Roller, DefectsLieAtArcLengthsFromTheTop) {
  constexpr double kRadius = 0.3;
  SurfaceSpec spec = roller({-0.03, 0.0, 0.0, {{0.06, 0.0}}}, kRadius);
  Corrugation waves;
  waves.waves = {{0.04, 20e-6, 0.0}};
  waves.x_start = 0.2;
  waves.x_end = 0.6;
  waves.ramp = 0.1;
  spec.defects.corrugations = {waves};
  const NaturalSurface natural = create_natural(spec);
  Region region;
  region.u_min = 0.28;
  region.u_max = 0.4;
  for (const std::string_view backend : backend_names()) {
    if (backend_of(backend).one_place) continue;  // one section has no waves
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(natural, {std::string(backend), 0.5e-3, region});
    for (double x = 0.3; x < 0.38; x += 0.0037)  // in the full stretch: deeper by a cos(2 pi (x - x_start)/wavelength)
      EXPECT_NEAR(height_at(*r.surface, at_angle(kRadius, x / kRadius), {0.0, 0.004}),
                  20e-6 * std::cos(2.0 * kPi * (x - 0.2) / 0.04), 0.5e-6)
          << x;
  }
  for (const double x : {0.0, 0.19, -0.4, 0.7})
    EXPECT_NEAR(height_at(*natural.surface, at_angle(kRadius, x / kRadius), {0.0, 0.004}), 0.0, 1e-12) << x;
}

TEST(Roller, RefusesWhatMakesNoSense) {
  SurfaceSpec spec{Body::rail, 0.0, StandardProfile{"60E1"}, {}, std::numeric_limits<double>::infinity()};
  EXPECT_THROW(create_natural(spec), Error);
  spec.roller_radius = -0.01;  // the axle would lie in the profile
  spec.shape = ArcChain{-0.01, -0.02, 0.0, {{0.02, 0.0}}};
  EXPECT_THROW(create_natural(spec), Error);
  spec.shape = StandardProfile{"60E1"};
  spec.roller_radius = 0.02;  // less than the profile is deep
  EXPECT_THROW(create_natural(spec), Error);
  spec.roller_radius = 0.5;
  spec.defects.flattened_heads = {{0.0, 0.1, 0.02, 0.5e-3, 0.0}};
  EXPECT_THROW(create_natural(spec), Error);
  EXPECT_THROW(create_natural({Body::wheel, 0.46, StandardProfile{"S1002"}, {}, 0.5}), Error);
  spec.defects = {};
  EXPECT_THROW(write_offsets("/nowhere/roller.vdb", create_natural(spec), {}), Error);
  SliceSet long_rail =
      to_slices(create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}}), {"", 10e-3, {-2.0, 2.0, -1.0, 1.0}});
  EXPECT_THROW(create_natural({Body::rail, 0.0, long_rail, {}, 0.5}), Error);
}

}  // namespace
}  // namespace treadmark
