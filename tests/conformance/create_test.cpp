// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

SurfaceSpec standard(Body body, const char* name) { return {body, body == Body::wheel ? 0.46 : 0.0, StandardProfile{name}, {}}; }

void expect_refused(const SurfaceSpec& spec, std::string_view backend, const char* words) {
  try {
    create_surface(spec, backend);
    ADD_FAILURE() << "accepted, expected: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

TEST(CreateSurface, ListsWhatThereIs) {
  EXPECT_THAT(backend_names(), ElementsAre("analytic", "spline"));
  EXPECT_THAT(standard_profile_names(), ElementsAre("60E1", "S1002"));
  for (const auto name : backend_names()) EXPECT_EQ(create_surface(standard(Body::rail, "60E1"), name)->backend(), name);
}

TEST(CreateSurface, ChoosesTheNaturalBackend) {
  EXPECT_EQ(create_surface(standard(Body::wheel, "S1002"))->backend(), "analytic");
  const SurfaceSpec points{Body::rail, 0.0, analytic::sample_profile(StandardProfile{"60E1"}, 1e-3), {}};
  EXPECT_EQ(create_surface(points)->backend(), "spline");
  const ArcChain chain{-0.02, 0.0, 0.0, {{0.04, 0.0}}};
  EXPECT_EQ(create_surface({Body::rail, 0.0, chain, {}})->backend(), "analytic");
  EXPECT_EQ(create_surface({Body::wheel, 0.3, chain, {}})->facing(), Facing::down);
}

TEST(CreateSurface, SaysWhatItRefusesAndWhy) {
  const SurfaceSpec wheel = standard(Body::wheel, "S1002");
  expect_refused(wheel, "mesh", "the backend 'mesh' is not part of this build (available: analytic, spline)");
  expect_refused(wheel, "offset", "the backend 'offset' is not part of this build (available: analytic, spline)");
  expect_refused(wheel, "splines", "unknown backend 'splines' (available: analytic, spline)");
  expect_refused(standard(Body::rail, "S1002"), "", "the standard profile S1002 belongs to a wheel, not to a rail");
  expect_refused(standard(Body::rail, "UIC61"), "", "unknown standard profile 'UIC61'");

  SurfaceSpec no_radius = wheel;
  no_radius.nominal_radius = 0.0;
  expect_refused(no_radius, "", "positive nominal radius");

  const Profile points = analytic::sample_profile(StandardProfile{"S1002"}, 1e-3);
  expect_refused({Body::wheel, 0.46, points, {}}, "analytic", "needs a formula");
  expect_refused({Body::rail, 0.0, points, {}}, "", "belongs to a wheel, not to a rail");
  WheelFlat flat;
  flat.length = 0.05;
  flat.depth = 1e-3;
  expect_refused({Body::wheel, 0.46, points, {.flats = {flat}}}, "", "flats can be added to standard profiles and arc chains only");
  expect_refused({Body::rail, 0.0, StandardProfile{"60E1"}, {.flats = {flat}}}, "", "flats belong to wheels");
}

}  // namespace
}  // namespace treadmark
