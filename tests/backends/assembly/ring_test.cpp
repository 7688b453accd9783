// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"

// Rings that a wheel runs in against closed formulas; the conformance suite looks at them from all sides.

namespace treadmark {
namespace {

constexpr double kRadius = 0.6, kCrown = 0.3;

SurfaceSpec ring() { return {Body::rail, 0.0, analytic::cylinder_chain(kCrown, 0.1), {}, -kRadius}; }

double height(double x, double y) {
  const double r = kRadius + kCrown - std::sqrt(kCrown * kCrown - y * y);
  return -kRadius + std::sqrt(r * r - x * x);
}

TEST(Ring, IsACircleInEveryBackend) {
  const NaturalSurface natural = create_natural(ring());
  EXPECT_FALSE(natural.constant_profile());
  Region region;
  region.u_min = -0.15, region.u_max = 0.15;
  for (const std::string_view backend : backend_names()) {
    if (backend_of(backend).one_place) continue;  // straight along x
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(natural, {std::string(backend), 1e-3, region});
    EXPECT_EQ(r.surface->backend(), backend);
    const bool facets = backend == "mesh-flat" || backend == "offset-bilinear" || backend == "chords";
    const double tolerance = backend == "analytic" ? 1e-14
                             : facets              ? 1.5e-6
                                                   : 2e-8;  // facets: h^2 (1/(8 R) + 1/(8 R_crown))
    for (const double x : {-0.12, -0.0103, 0.0, 0.0307, 0.14})
      for (const double y : {-0.0202, 0.0, 0.0131})
        EXPECT_NEAR(height_at(*r.surface, {}, {x, y}), height(x, y), tolerance) << x << ' ' << y;
    EXPECT_TRUE(std::isnan(height_at(*r.surface, {}, {0.0, 0.031})));
    EXPECT_TRUE(std::isnan(height_at(*r.surface, {}, {0.4, 0.0})));
  }
}

TEST(Ring, OfPointsIsThatOfTheFormula) {
  SurfaceSpec spec = ring();
  spec.shape = analytic::sample_profile(std::get<ArcChain>(spec.shape), Body::rail, 0.5e-3);
  const NaturalSurface natural = create_natural(spec);
  EXPECT_EQ(natural.surface->backend(), "spline");
  for (double x = -0.3; x < 0.31; x += 0.043)
    EXPECT_NEAR(height_at(*natural.surface, {}, {x, 0.0117}), height(x, 0.0117), 1e-8) << x;
}

TEST(Ring, TrianglesAboveTheAxleHideNothing) {
  const NaturalSurface natural = create_natural(ring());
  Region region;
  region.u_min = -0.1, region.u_max = 0.1;
  TriangleMesh mesh = to_triangles(natural, {"", 2e-3, region});
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::size_t below = mesh.triangles.size();
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 v = mesh.vertices[i];
    mesh.vertices.push_back({-v.x(), v.y(), -2.0 * kRadius - v.z()});
  }
  for (std::size_t i = 0; i < below; ++i) {
    const auto t = mesh.triangles[i];
    mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
  SurfaceSpec spec = ring();
  spec.shape = mesh;
  EXPECT_NEAR(height_at(*create_natural(spec).surface, {}, {0.03, 0.01}), height(0.03, 0.01), 1e-7);
}

TEST(Ring, PrincipalCurvaturesAreThoseOfItsCircles) {
  const NaturalSurface natural = create_natural(ring());
  for (const std::string backend : {"analytic", "spline"}) {
    SurfacePoint p;
    represent(natural, {backend, 0.0, {}}).surface->locate({}, std::vector<Vec2>{{0.0, 0.0}}, std::span(&p, 1));
    EXPECT_NEAR(p.curvature_1, 1.0 / kCrown, 1e-4);
    EXPECT_NEAR(p.curvature_2, -1.0 / kRadius, 1e-4);
  }
}

TEST(Ring, RefusesWhatMakesNoSense) {
  SurfaceSpec spec = ring();
  EXPECT_THROW(write_offsets("/nowhere/ring.vdb", create_natural(spec), {}), Error);
  spec.defects.corrugations = {{}};
  EXPECT_THROW(create_natural(spec), Error);
  spec.defects = {};
  spec.shape = SliceSet{};
  EXPECT_THROW(create_natural(spec), Error);
  spec.shape = ArcChain{-0.01, -0.02, 0.0, {{0.02, 0.0}}};
  spec.roller_radius = -0.01;
  EXPECT_THROW(create_natural(spec), Error);
}

}  // namespace
}  // namespace treadmark
