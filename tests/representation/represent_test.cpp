// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/representation/kinds.hpp"

// Every backend from every kind of shape, whole and damaged.

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

class EveryKind : public ::testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Represent, EveryKind, ::testing::ValuesIn(kinds()),
                         [](const auto& which) { return which.param.name; });

constexpr double kResolution = 1e-3;  ///< [m]

// Samples h = 1 mm apart. Splines and fitted patches round off jumps of curvature of up to k = 77/m by about k h^2/12 =
// 6 um where these lie in the middle of a cell; triangles cut k h^2/8 = 10 um off arcs. Elsewhere far less: see the
// rms.
constexpr double kSmoothMax = 5e-6, kFacetsMax = 10e-6, kSmoothRms = 0.5e-6, kFacetsRms = 3e-6, kChordsMax = 11e-6,
                 kChordsRms = 4.5e-6;  // h^2/(8 r) and h^2/(sqrt(120) r) on the arc of r = 12 mm
/// What points, slices and triangles 0.5 mm apart differ from the formula.
constexpr double kGivenMax = 4e-6, kGivenRms = 0.4e-6;

TEST_P(EveryKind, NaturallyIsWhatItIsGivenAs) {
  const Kind& kind = GetParam();
  const NaturalSurface natural = create_natural(kind.spec);
  EXPECT_EQ(natural.surface->backend(), kind.natural);
  EXPECT_EQ(natural.surface->facing(), kind.spec.body == Body::wheel ? Facing::down : Facing::up);
  const bool one_section = kind.natural == "analytic" || std::holds_alternative<Profile>(kind.spec.shape);
  EXPECT_EQ(natural.constant_profile(), one_section && kind.spec.defects.empty());
  const Distance d =
      distance(*create_natural(kind.formula).surface, *natural.surface, kind.spec.body, kind.region, 4000);
  EXPECT_GT(d.points, 3500);
  EXPECT_EQ(d.missing, 0);
  EXPECT_LE(d.max, kGivenMax);
  EXPECT_LE(d.rms, kGivenRms);
}

TEST_P(EveryKind, BecomesEveryBackend) {
  const Kind& kind = GetParam();
  const NaturalSurface natural = create_natural(kind.spec);
  for (const std::string_view backend : backend_names()) {
    if (backend == "analytic" && kind.natural != "analytic") continue;
    if (backend_of(backend).one_place && !natural.constant_profile()) continue;  // another shape by intent
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(natural, {std::string(backend), kResolution, kind.region});
    ASSERT_NE(r.surface, nullptr);
    EXPECT_EQ(r.surface->backend(), backend);
    EXPECT_EQ(r.surface->facing(), natural.surface->facing());
    EXPECT_EQ(r.resampled, backend != "analytic");
    if (r.resampled) {
      EXPECT_EQ(r.resolution, kResolution);
    }
    EXPECT_EQ(r.region.u_min, kind.region.u_min);
    EXPECT_EQ(r.region.u_max, kind.region.u_max);
    const Distance d = distance(*natural.surface, *r.surface, kind.spec.body, kind.region, 1500, 2e-3);
    const bool facets = backend == "mesh-flat" || backend == "offset-bilinear";
    EXPECT_GT(d.points, 1200);
    EXPECT_EQ(d.missing, 0);
    const bool chords = backend == "chords";
    EXPECT_LE(d.max, chords ? kChordsMax : facets ? kFacetsMax : kSmoothMax);
    EXPECT_LE(d.rms, chords ? kChordsRms : facets ? kFacetsRms : kSmoothRms);
  }
}

TEST_P(EveryKind, ItsOwnKindWithoutAResolutionIsTheSurfaceItself) {
  const Kind& kind = GetParam();
  const NaturalSurface natural = create_natural(kind.spec);
  for (const std::string& backend : {std::string(), kind.natural}) {
    const RepresentedSurface r = represent(natural, {backend, 0.0, {}});
    EXPECT_EQ(r.surface, natural.surface);
    EXPECT_FALSE(r.resampled);
    EXPECT_EQ(r.resolution, 0.0);
    EXPECT_EQ(r.note, "");
    const RepresentedSurface with_resolution = represent(natural, {backend, kResolution, kind.region});
    EXPECT_EQ(with_resolution.resampled, !backend.empty() && kind.natural != "analytic");
  }
}

TEST(Represent, GivenTrianglesServeBothRefinementsDirectly) {
  const Kind* given = nullptr;
  const std::vector<Kind> all = kinds();
  for (const Kind& kind : all)
    if (kind.name == "rail_triangles") given = &kind;
  ASSERT_NE(given, nullptr);
  const NaturalSurface natural = create_natural(given->spec);
  const RepresentedSurface flat = represent(natural, {"mesh-flat", 0.0, {}});
  EXPECT_EQ(flat.resolution, 0.0) << "not sampled again";
  // the corners of the triangles lie on both
  const auto& mesh = std::get<TriangleMesh>(given->spec.shape);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 97) {
    const Vec3& v = mesh.vertices[i];
    for (const Surface* s : {natural.surface.get(), flat.surface.get()})
      if (const double z = height_at(*s, {}, {v.x(), v.y()}); !std::isnan(z)) {
        EXPECT_NEAR(z, v.z(), 1e-12);
      }
  }
}

TEST(Represent, ResolutionAndRegionAreWhatWasAsked) {
  const NaturalSurface wheel = create_natural(s1002(one_flat()));
  for (const std::string backend : {"nurbs", "mesh", "mesh-flat"}) {
    SCOPED_TRACE(backend);
    Region region;
    region.u_min = 0.1;
    region.u_max = 0.15;
    region.y_min = -0.02;
    region.y_max = 0.03;
    const RepresentedSurface r = represent(wheel, {backend, 2e-3, region});
    EXPECT_EQ(r.resolution, 2e-3);
    const Box3 box = r.surface->bounds();
    // whole cells: at most a spacing beyond
    EXPECT_NEAR(box.min.y(), region.y_min, 2.1e-3);
    EXPECT_NEAR(box.max.y(), region.y_max, 2.1e-3);
    EXPECT_NEAR(box.min.x(), kWheelRadius * std::sin(0.1), 4.2e-3);
    EXPECT_NEAR(box.max.x(), kWheelRadius * std::sin(0.15), 4.2e-3);
    const auto at = [&](double theta, double y) {
      return height_at(*r.surface, {Vec3::Zero(), rotation({0.0, 0.0, theta})}, {0.0, y});
    };
    EXPECT_FALSE(std::isnan(at(0.101, 0.0)));
    EXPECT_FALSE(std::isnan(at(0.149, 0.0)));
    EXPECT_TRUE(std::isnan(at(0.09, 0.0)));
    EXPECT_TRUE(std::isnan(at(0.16, 0.0)));
    EXPECT_TRUE(std::isnan(at(0.12, 0.035)));
    // four times as many data at half the spacing
    const RepresentedSurface finer = represent(wheel, {backend, 1e-3, region});
    EXPECT_GT(static_cast<double>(finer.surface->memory_bytes()), 2.5 * static_cast<double>(r.surface->memory_bytes()));
  }
}

TEST(Represent, WithoutARegionAWheelIsClosed) {
  const NaturalSurface wheel = create_natural(s1002(one_polygonization()));
  for (const std::string backend : {"spline", "nurbs", "mesh", "offset"}) {
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(wheel, {backend, 8e-3, {}});
    for (double theta = -3.1; theta < 3.2; theta += 0.1)
      EXPECT_NEAR(height_at(*r.surface, {Vec3::Zero(), rotation({0.0, 0.0, theta})}, {0.0, 0.001}),
                  height_at(*wheel.surface, {Vec3::Zero(), rotation({0.0, 0.0, theta})}, {0.0, 0.001}), 20e-6);
  }
}

TEST(Represent, DefaultResolutionIsHalfAMillimetre) {
  const NaturalSurface rail = create_natural(rail_60e1(one_squat()));
  Region region;
  region.u_min = -0.01;
  region.u_max = 0.01;
  for (const std::string backend : {"spline", "nurbs", "mesh", "mesh-flat", "offset"})
    EXPECT_EQ(represent(rail, {backend, 0.0, region}).resolution, kDefaultResolution) << backend;
  EXPECT_EQ(represent(create_natural(rail_60e1()), {"spline", 0.0, region}).resolution, kResampleStep);
  EXPECT_EQ(represent(create_natural(rail_60e1()), {"nurbs", 0.0, region}).resolution, 0.0) << "arcs are exact";
}

TEST(Represent, RailsWithoutEndsAreSampledHalfAMetreToBothSidesWithANote) {
  const NaturalSurface rail = create_natural(rail_60e1(one_squat()));
  for (const std::string backend :
       {"spline", "nurbs", "mesh", "mesh-flat", "offset", "offset-quadratic", "offset-bilinear"}) {
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(rail, {backend, 4e-3, {}});
    EXPECT_EQ(r.region.u_min, -kDefaultHalfLength);
    EXPECT_EQ(r.region.u_max, kDefaultHalfLength);
    EXPECT_THAT(r.note, HasSubstr("the rail was sampled from x = -0.5 m to 0.5 m."));
    EXPECT_FALSE(std::isnan(height_at(*r.surface, {}, {0.499, 0.0})));
    Region asked;
    asked.u_min = -0.1;
    asked.u_max = 0.1;
    EXPECT_THAT(represent(rail, {backend, 4e-3, asked}).note, ::testing::Not(HasSubstr("was sampled from")));
  }
}

TEST(Represent, OffsetsNoteTheirVoxels) {
  const RepresentedSurface r = represent(create_natural(rail_60e1(one_squat())), {"offset", 1e-3, {}});
  EXPECT_THAT(r.note, HasSubstr(" active voxels"));
  const RepresentedSurface plain = represent(create_natural(rail_60e1()), {"offset", 1e-3, {}});
  EXPECT_THAT(plain.note, HasSubstr(" 0 active voxels"));
}

TEST(Represent, RepairedTrianglesAreNoted) {
  const std::vector<Kind> all = kinds();
  SurfaceSpec spec =
      std::find_if(all.begin(), all.end(), [](const Kind& k) { return k.name == "rail_triangles"; })->spec;
  auto& mesh = std::get<TriangleMesh>(spec.shape);
  std::swap(mesh.triangles[10][0], mesh.triangles[10][1]);
  mesh.triangles.push_back(mesh.triangles[50]);
  mesh.triangles.push_back({3, 3, 7});
  const NaturalSurface natural = create_natural(spec);
  EXPECT_THAT(represent(natural, {}).note, HasSubstr("1 flipped triangles turned"));
  EXPECT_THAT(represent(natural, {"mesh-flat", 0.0, {}}).note,
              HasSubstr("repaired the mesh: 1 triangles without area removed, 1 duplicate triangles removed, 1 flipped "
                        "triangles turned."));
}

}  // namespace
}  // namespace treadmark::testing
