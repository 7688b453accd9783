// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parametric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/assembly/renamed_surface.hpp"
#include "treadmark/backends/create.hpp"

namespace treadmark::assembly {
namespace {

SurfaceJet jet_at(const Surface& surface, double u, double v) {
  const Vec2 uv(u, v);
  SurfaceJet jet;
  treadmark::evaluate(surface, {&uv, 1}, {&jet, 1});
  return jet;
}

/// Derivatives against central differences of the positions.
void expect_consistent(const Surface& surface, double u, double v, double hu, double hv, double tolerance) {
  const SurfaceJet at = jet_at(surface, u, v);
  ASSERT_TRUE(at.found());
  const auto p = [&](double du, double dv) { return jet_at(surface, u + du, v + dv).p; };
  const auto near = [&](const Vec3& a, const Vec3& b, double scale) {
    EXPECT_LE((a - b).norm(), tolerance * (scale + b.norm())) << a.transpose() << " and " << b.transpose();
  };
  near((p(hu, 0) - p(-hu, 0)) / (2 * hu), at.pu, 1e-3);
  near((p(0, hv) - p(0, -hv)) / (2 * hv), at.pv, 1e-3);
  near((p(hu, 0) - 2 * at.p + p(-hu, 0)) / (hu * hu), at.puu, 1.0);
  near((p(0, hv) - 2 * at.p + p(0, -hv)) / (hv * hv), at.pvv, 1.0);
  near((p(hu, hv) - p(hu, -hv) - p(-hu, hv) + p(-hu, -hv)) / (4 * hu * hv), at.puv, 1.0);
}

TEST(ParametricSurfaces, ACylinderHasItsRadius) {
  const auto rail = analytic::make_prismatic_surface(analytic::cylinder_chain(0.04, 0.7));
  ASSERT_TRUE(has_exact_derivatives(*rail));
  const SurfaceShape s = shape_of(jet_at(*rail, 0.3, 0.01));
  EXPECT_NEAR(s.curvature_1, 25.0, 1e-12);
  EXPECT_NEAR(s.curvature_2, 0.0, 1e-12);
  EXPECT_NEAR(std::fabs(s.direction_2.x()), 1.0, 1e-13);
  EXPECT_FALSE(jet_at(*rail, 0.0, 1.0).found()) << "behind the end of the chain";
}

TEST(ParametricSurfaces, AFlatPlateHasNone) {
  const SurfaceShape s = shape_of(jet_at(*analytic::make_plane_surface(Facing::up), 0.3, -0.2));
  EXPECT_EQ(s.curvature_1, 0.0);
  EXPECT_EQ(s.normal.z(), -1.0);
}

TEST(ParametricSurfaces, S1002HasItsPublishedRadii) {
  const auto wheel = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, {}});
  // EN 13715: R = 20.5 mm and 12 mm round the tip of the flange, 13 mm, hollow, at its root
  const auto lateral = [&](double y_mm) {
    const SurfaceShape s = shape_of(jet_at(*wheel, 0.2, 1e-3 * y_mm));
    return normal_curvature(s, Vec3::UnitY() - s.normal.y() * s.normal);
  };
  EXPECT_NEAR(lateral(-63.5), 1.0 / 20.5e-3, 1e-6);
  EXPECT_NEAR(lateral(-55.0), 1.0 / 12e-3, 1e-6);
  EXPECT_NEAR(lateral(-45.0), 1.0 / 20e-3, 1e-6);
  EXPECT_NEAR(lateral(-37.0), -1.0 / 13e-3, 1e-6);
  EXPECT_NEAR(lateral(40.0), 0.0, 1e-9) << "the cone of the field side";
  // round the axle: the cosine of the inclination over the radius (Meusnier)
  const SurfaceShape cone = shape_of(jet_at(*wheel, 0.2, 40e-3));
  const double r = 0.46 + 1e-3 * (1.364323640 - 0.066666667 * 40.0);
  EXPECT_NEAR(cone.curvature_1, 1.0 / (r * std::hypot(1.0, 0.066666667)), 1e-6);
}

TEST(ParametricSurfaces, DerivativesAreThoseOfThePositions) {
  WheelFlat flat;
  flat.shape = WheelFlat::Shape::rounded;
  flat.length = 60e-3;
  flat.depth = 0.8e-3;
  flat.width = 50e-3;
  const auto flatted = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, {.flats = {flat}}});
  ASSERT_TRUE(has_exact_derivatives(*flatted));
  expect_consistent(*flatted, 0.021, 6e-3, 2e-4, 1e-4, 2e-4);
  Defects waves;
  Polygonization polygon;
  polygon.harmonics = {{20, 20e-6, -0.7}};
  polygon.width = 60e-3;
  waves.polygonizations = {polygon};
  const auto polygonal = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, waves});
  ASSERT_TRUE(has_exact_derivatives(*polygonal));
  expect_consistent(*polygonal, 0.5, 8e-3, 2e-4, 1e-4, 2e-4);
  const auto slices = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, {.flats = {flat}}}, "spline");
  ASSERT_TRUE(has_exact_derivatives(*slices));
  expect_consistent(*slices, 0.0213, 90.4, 1e-4, 0.1, 3e-3);
  Squat squat;
  squat.length = 40e-3, squat.width = 30e-3, squat.depth = 0.3e-3;
  const auto dipped = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {.squats = {squat}}});
  ASSERT_TRUE(has_exact_derivatives(*dipped));
  SurfacePoint on;
  const Vec2 place(5e-3, 4e-3);
  dipped->locate({}, {&place, 1}, {&on, 1});
  expect_consistent(*dipped, on.u, on.v, 1e-4, 1e-4, 2e-4);
  const auto roller = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}, 0.5});
  roller->locate({}, {&place, 1}, {&on, 1});
  expect_consistent(*roller, on.u, on.v, 2e-4, 1e-4, 2e-4);
  EXPECT_NEAR((jet_at(*roller, on.u, on.v).p - on.position_S).norm(), 0.0, 1e-12);
}

TEST(ParametricSurfaces, AnotherNameIsTheSameSurface) {
  const auto wheel = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, {}});
  const auto named = rename_surface(wheel, "other");
  EXPECT_EQ(named->backend(), "other");
  EXPECT_EQ(jet_at(*named, 0.1, 0.01).p, jet_at(*wheel, 0.1, 0.01).p);
  EXPECT_EQ(height_at(*named, {}, {0.0, 0.01}), height_at(*wheel, {}, {0.0, 0.01}));
  EXPECT_TRUE(has_exact_derivatives(*named));
  EXPECT_THROW(rename_surface(nullptr, "none"), std::exception);
}

}  // namespace
}  // namespace treadmark::assembly
