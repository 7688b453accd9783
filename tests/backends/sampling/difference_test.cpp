// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/difference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::sampling {
namespace {

constexpr Region kSector{-0.1, 0.1};

TEST(Difference, OfASurfaceToItselfIsNothing) {
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46);
  const SurfaceDifference d = difference(*wheel, *wheel, Body::wheel, 0.46, {kSector});
  EXPECT_GT(d.points, 1000u);
  EXPECT_EQ(d.missing, 0u);
  EXPECT_EQ(d.height_max, 0.0);
  EXPECT_EQ(d.slope_max, 0.0);
  EXPECT_EQ(d.curvature_max, 0.0);
}

TEST(Difference, OfConcentricCylindersIsTheirDistance) {
  // rails of radius 100 mm and 100.01 mm about one axis: normal distance 10 um everywhere, no turn of the normals
  const auto chain = [](double radius, double drop) {
    ArcChain c = analytic::cylinder_chain(radius, 1.2);
    c.start_z += drop;
    return c;
  };
  const auto inner = analytic::make_prismatic_surface(chain(0.1, 0.0));
  const auto outer = analytic::make_prismatic_surface(chain(0.10001, -1e-5));
  DifferenceSettings settings;
  settings.region.u_min = 0.0;
  settings.region.u_max = 0.05;
  const SurfaceDifference d = difference(*inner, *outer, Body::rail, 0.0, settings);
  // along z instead of the normal: second order in 10 um / 100 mm and the slope
  EXPECT_NEAR(d.height_max, 1e-5, 1e-8);
  EXPECT_NEAR(d.height_rms, 1e-5, 1e-8);
  EXPECT_LT(d.slope_max, 5e-4);  // tan(1.2) 1e-4: the points lie above each other, not along the normal
  EXPECT_NEAR(d.curvature_max, 0.5 * (10.0 - 1.0 / 0.10001), 1e-6);
}

TEST(Difference, FindsTheDepthAndPlaceOfAFlat) {
  WheelFlat flat;
  flat.length = 0.06;
  flat.depth = 0.5e-3;
  flat.theta_center = 0.03;
  const auto round = analytic::make_revolved_surface(analytic::straight_chain(0.03), 0.46);
  const auto flatted = analytic::make_revolved_surface(analytic::straight_chain(0.03), 0.46, {flat});
  const SurfaceDifference d = difference(*round, *flatted, Body::wheel, 0.46, {kSector});
  EXPECT_NEAR(d.height_max, 0.5e-3, 1e-6);  // sampled within half a step of the bottom
  EXPECT_NEAR(d.worst_u, 0.03, 2e-3);
  // slope of the cosine: pi depth/length, met on a cylinder without its own slope
  EXPECT_NEAR(d.slope_max, std::acos(-1.0) * 0.5e-3 / 0.06, 1e-4);
}

TEST(Difference, CountsWhatIsMissing) {
  const auto wide = analytic::make_revolved_surface(analytic::straight_chain(0.03), 0.46);
  const auto narrow = analytic::make_revolved_surface(analytic::straight_chain(0.015), 0.46);
  const SurfaceDifference d = difference(*wide, *narrow, Body::wheel, 0.46, {kSector});
  EXPECT_NEAR(static_cast<double>(d.missing) / static_cast<double>(d.missing + d.points), 14.0 / 29.0, 0.02);
  EXPECT_LT(d.height_max, 1e-15);
}

TEST(Difference, IsTheSameForAnyNumberOfThreads) {
  const auto a = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46);
  const auto b = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.4601);
  SurfaceDifference one, many;
  {
    ThreadLimit limit(1);
    one = difference(*a, *b, Body::wheel, 0.46, {kSector});
  }
  {
    ThreadLimit limit(4);
    many = difference(*a, *b, Body::wheel, 0.46, {kSector});
  }
  EXPECT_EQ(one.height_rms, many.height_rms);
  EXPECT_EQ(one.curvature_rms, many.curvature_rms);
}

}  // namespace
}  // namespace treadmark::sampling
