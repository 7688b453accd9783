// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/tests/representation/kinds.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

void expect_refused(ErrorKind kind, const char* words, const std::function<void()>& build) {
  try {
    build();
    ADD_FAILURE() << "accepted, expected: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

void expect_refused(const SurfaceSpec& spec, const char* words) {
  expect_refused(ErrorKind::configuration, words, [&] { create_natural(spec); });
}

constexpr const char* kAll =
    "choose analytic, spline, nurbs, thb, thb-quadratic, mesh, mesh-flat, offset, offset-quadratic, "
    "offset-bilinear, level-set, chords, prismatic";

TEST(CreateSurface, ListsWhatThereIs) {
  EXPECT_THAT(backend_names(),
              ElementsAre("analytic", "spline", "nurbs", "thb", "thb-quadratic", "mesh", "mesh-flat", "offset",
                          "offset-quadratic", "offset-bilinear", "level-set", "chords", "prismatic"));
  EXPECT_THAT(standard_profile_names(), ::testing::IsSupersetOf({"60E1", "54E1", "UIC60", "S1002", "1:40", "EPS"}));
}

TEST(CreateSurface, TheKeysOfCaseFilesNameThem) {
  std::string names;
  for (const auto name : backend_names())
    names += (names.empty() ? "" : name == backend_names().back() ? " or " : ", ") + std::string(name);
  EXPECT_THAT(io::case_file_schema(), HasSubstr("surface representation: " + names));
}

/// What a row says of its shapes is what create_natural() makes of them.
TEST(CreateSurface, RowsKnowTheirNaturalShapes) {
  const TriangleMesh mesh = to_triangles(create_natural(rail_60e1()), {"", 2e-3, {0.0, 0.02, -1.0, 1.0}});
  const SurfaceSpec points{Body::rail, 0.0, analytic::sample_profile(StandardProfile{"60E1"}, 1e-3), {}};
  for (const SurfaceSpec& spec : {rail_60e1(one_squat()), s1002(one_flat()), points, SurfaceSpec{{}, 0.0, mesh, {}}}) {
    EXPECT_EQ(natural_backend(spec).name, create_natural(spec).surface->backend());
    int claims = 0;
    for (const Backend* backend : backends()) {
      EXPECT_FALSE(backend->summary.empty());
      EXPECT_GT(backend->order, 1.0) << backend->name;
      claims += backend->natural_for && backend->natural_for(spec) ? 1 : 0;
    }
    EXPECT_EQ(claims, 1);
  }
}

TEST(CreateSurface, MakesEveryBackendOfAStandardRail) {
  for (const auto name : backend_names()) EXPECT_EQ(create_surface(rail_60e1(), name)->backend(), name);
}

TEST(CreateSurface, ChoosesTheNaturalBackend) {
  EXPECT_EQ(create_surface(s1002())->backend(), "analytic");
  const SurfaceSpec points{Body::rail, 0.0, analytic::sample_profile(StandardProfile{"60E1"}, 1e-3), {}};
  EXPECT_EQ(create_surface(points)->backend(), "spline");
  const ArcChain chain{-0.02, 0.0, 0.0, {{0.04, 0.0}}};
  EXPECT_EQ(create_surface({Body::rail, 0.0, chain, {}})->backend(), "analytic");
  EXPECT_EQ(create_surface({Body::wheel, 0.3, chain, {}})->facing(), Facing::down);
}

TEST(CreateSurface, RefusesUnknownBackends) {
  const NaturalSurface rail = create_natural(rail_60e1());
  const std::pair<const char*, const char*> advised[] = {{"splines", "did you mean 'spline'?"},
                                                         {"Mesh", "did you mean 'mesh'?"},
                                                         {"mesh ", "did you mean 'mesh'?"},
                                                         {"voxels of mine", kAll}};
  for (const auto& [backend, advice] : advised) {
    const auto build = [&, name = backend] { represent(rail, {name, 0.0, {}}); };
    expect_refused(ErrorKind::configuration, "unknown backend", build);
    expect_refused(ErrorKind::configuration, advice, build);
  }
}

TEST(CreateSurface, RefusesShapesOfTheOtherBody) {
  expect_refused({Body::rail, 0.0, StandardProfile{"S1002"}, {}},
                 "the standard profile S1002 belongs to a wheel, not to a rail");
  expect_refused({Body::wheel, 0.46, StandardProfile{"60E1"}, {}},
                 "the standard profile 60E1 belongs to a rail, not to a wheel");
  expect_refused({Body::rail, 0.0, StandardProfile{"UIC61"}, {}}, "unknown standard profile 'UIC61'");
  const Profile points = analytic::sample_profile(StandardProfile{"S1002"}, 1e-3);
  expect_refused({Body::rail, 0.0, points, {}}, "belongs to a wheel, not to a rail");
  const SliceSet slices = analytic::sample_wheel(points, 0.46, {}, 1e-3);
  expect_refused({Body::rail, 0.0, slices, {}}, "belongs to a wheel, not to a rail");
}

TEST(CreateSurface, RefusesWheelsWithoutARadius) {
  SurfaceSpec wheel = s1002();
  for (const double radius : {0.0, -0.46, std::numeric_limits<double>::quiet_NaN()}) {
    wheel.nominal_radius = radius;
    expect_refused(wheel, "positive nominal radius");
  }
}

TEST(CreateSurface, RefusesDefectsOfTheOtherBody) {
  expect_refused(rail_60e1(one_flat()), "flats belong to wheels, not to rails");
  expect_refused(rail_60e1(one_polygonization()), "polygonizations belong to wheels, not to rails");
  expect_refused(s1002(one_squat()), "belong to rails, not to wheels");
}

TEST(CreateSurface, RefusesDefectsThatMakeNoSense) {
  for (const double depth : {0.46, 0.5, -1e-3, std::numeric_limits<double>::quiet_NaN()}) {
    Defects d = one_flat();
    d.flats[0].depth = depth;
    SCOPED_TRACE(depth);
    expect_refused(s1002(d), "wheel.flats[0]");
  }
  Defects d = one_squat();
  d.squats[0].length = 0.0;
  expect_refused(rail_60e1(d), "rail.squats[0]");
}

TEST(CreateSurface, MeasuredShapesTakeDefectsToo) {
  const Profile points = analytic::sample_profile(StandardProfile{"S1002"}, 0.5e-3);
  const NaturalSurface wheel = create_natural({Body::wheel, kWheelRadius, points, one_flat()});
  EXPECT_EQ(wheel.surface->backend(), "spline");
  EXPECT_FALSE(wheel.constant_profile());
  const NaturalSurface round = create_natural({Body::wheel, kWheelRadius, points, {}});
  EXPECT_TRUE(round.constant_profile());
  // in the middle of the flat its depth is missing, seen from its own angle
  const Pose plane{Vec3::Zero(), rotation({0.0, 0.0, 0.005})};
  EXPECT_NEAR(height_at(*round.surface, plane, {0.0, 0.004}) - height_at(*wheel.surface, plane, {0.0, 0.004}), 0.3e-3,
              1e-9);
}

TEST(Represent, FormulasOnlyFromFormulas) {
  const Profile points = analytic::sample_profile(StandardProfile{"S1002"}, 1e-3);
  const NaturalSurface given = create_natural({Body::wheel, 0.46, points, {}});
  expect_refused(ErrorKind::configuration, "the backend 'analytic' needs a formula", [&] {
    represent(given, {"analytic", 0.0, {}});
  });
  EXPECT_EQ(represent(create_natural(s1002(one_polygonization())), {"analytic", 0.0, {}}).surface->backend(),
            "analytic");
}

TEST(Represent, ResolutionsMustBePositiveOrNothing) {
  const NaturalSurface rail = create_natural(rail_60e1());
  for (const double resolution :
       {-1e-3, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const auto backend : backend_names()) {
      if (backend == "analytic") continue;  // needs none
      expect_refused(ErrorKind::configuration, "the resolution of a surface must be positive", [&] {
        represent(rail, {std::string(backend), resolution, {}});
      });
    }
}

TEST(Represent, SamplesTooManyForMemoryAreRefused) {
  const NaturalSurface wheel = create_natural(s1002(one_polygonization()));
  for (const char* backend : {"spline", "nurbs", "mesh", "mesh-flat"})
    expect_refused(ErrorKind::configuration, "points", [&] { represent(wheel, {backend, 4e-5, {}}); });
  expect_refused(ErrorKind::configuration, "nodes", [&] { represent(wheel, {"offset", 1e-5, {}}); });
}

TEST(Represent, OffsetsRefuseSurfacesWithGaps) {
  // a hole of a tenth of the samples
  NaturalSurface rail = create_natural(rail_60e1(one_squat()));
  Region region;
  region.u_min = -0.03;
  region.u_max = 0.03;
  TriangleMesh mesh = to_triangles(rail, {"", 1e-3, region});
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::fabs(mesh.vertices[t[0]].x()) < 0.02 && std::fabs(mesh.vertices[t[0]].y()) < 0.01;
  });
  rail = create_natural({Body::rail, 0.0, mesh, {}});
  expect_refused(ErrorKind::input_data, "offsets cannot represent this rail", [&] {
    represent(rail, {"offset", 1e-3, {}});
  });
}

}  // namespace
}  // namespace treadmark::testing
