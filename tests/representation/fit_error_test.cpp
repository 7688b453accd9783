// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/tests/representation/kinds.hpp"

// What fit_error() reports is what other points, taken elsewhere, find.

namespace treadmark::testing {
namespace {

Region of(double u_min, double u_max) {
  Region r;
  r.u_min = u_min;
  r.u_max = u_max;
  return r;
}

void expect_reported_right(const NaturalSurface& natural, const Representation& wanted) {
  SCOPED_TRACE(wanted.backend);
  const RepresentedSurface r = represent(natural, wanted);
  const SurfaceDifference reported = fit_error(natural, r);
  const Distance found = distance(*natural.surface, *r.surface, natural.spec.body, r.region, 20000);
  EXPECT_GT(reported.points, 5000u);
  EXPECT_EQ(reported.missing, 0u);
  EXPECT_EQ(found.missing, 0);
  // Two samples of the same error: means agree closely, single peaks less so.
  EXPECT_NEAR(reported.height_rms / found.rms, 1.0, 0.25);
  EXPECT_GT(reported.height_max, 0.8 * found.max);
  EXPECT_LT(reported.height_max, 1.5 * found.max);
  EXPECT_GT(reported.slope_max, 0.7 * found.slope);
  EXPECT_LT(reported.slope_max, 1.7 * found.slope);
  EXPECT_GE(reported.height_max, reported.height_rms);
  EXPECT_GE(reported.slope_max, reported.slope_rms);
  EXPECT_GE(reported.curvature_max, reported.curvature_rms);
  // the place it names is as bad as it says
  const Pose plane = natural.spec.body == Body::rail ? Pose{{reported.worst_u, 0.0, 0.0}, Mat3::Identity()}
                                                     : Pose{Vec3::Zero(), rotation({0.0, 0.0, reported.worst_u})};
  double z[2], dx = 0.0, dy = 0.0;
  const Grid2 there{0.0, reported.worst_y, 1.0, 1.0, 1, 1};
  natural.surface->heights({plane, there}, {{&z[0], 1}, {&dx, 1}, {&dy, 1}});
  r.surface->heights({plane, there}, {{&z[1], 1}, {}, {}});
  EXPECT_NEAR(std::fabs(z[0] - z[1]) / std::sqrt(1.0 + dx * dx + dy * dy), reported.height_max, 1e-9);
}

TEST(FitError, OfAWheelWithAFlat) {
  const NaturalSurface wheel = create_natural(s1002(one_flat()));
  for (const char* backend : {"nurbs", "mesh", "mesh-flat"})
    expect_reported_right(wheel, {backend, 2e-3, of(-0.06, 0.07)});
}

TEST(FitError, OfARailWithASquat) {
  const NaturalSurface rail = create_natural(rail_60e1(one_squat()));
  for (const char* backend : {"spline", "nurbs", "mesh", "mesh-flat", "offset", "offset-bilinear"})
    expect_reported_right(rail, {backend, 2e-3, of(-0.03, 0.04)});
}

TEST(FitError, OfASurfaceItselfIsNothing) {
  const NaturalSurface rail = create_natural(rail_60e1(one_squat()));
  const SurfaceDifference d = fit_error(rail, represent(rail, {"", 0.0, of(-0.1, 0.1)}));
  EXPECT_GT(d.points, 5000u);
  EXPECT_EQ(d.missing, 0u);
  EXPECT_EQ(d.height_max, 0.0);
  EXPECT_EQ(d.slope_max, 0.0);
  EXPECT_EQ(d.curvature_max, 0.0);
}

TEST(FitError, KnownShiftIsFound) {
  // the same shape 7 um lower: normal distances of 7 um where it is level, less where it is steep
  constexpr double kShift = 7e-6;
  const ArcChain chain{-0.02, 0.0, 0.0, {{0.04, 0.0}}};
  ArcChain shifted = chain;
  shifted.start_z += kShift;
  const NaturalSurface plane = create_natural({Body::rail, 0.0, chain, {}});
  RepresentedSurface r = represent(create_natural({Body::rail, 0.0, shifted, {}}), {"", 0.0, of(-0.05, 0.05)});
  const SurfaceDifference d = fit_error(plane, r);
  EXPECT_NEAR(d.height_max, kShift, 1e-14);
  EXPECT_NEAR(d.height_rms, kShift, 1e-14);
  EXPECT_NEAR(d.slope_max, 0.0, 1e-12);
}

TEST(FitError, CountsWhatIsMissing) {
  const NaturalSurface rail = create_natural(rail_60e1(one_squat()));
  RepresentedSurface r = represent(rail, {"mesh-flat", 2e-3, of(-0.03, 0.03)});
  r.region = of(-0.06, 0.06);  // twice as long as what was sampled
  const SurfaceDifference d = fit_error(rail, r);
  EXPECT_NEAR(static_cast<double>(d.missing) / static_cast<double>(d.missing + d.points), 0.5, 0.06);
}

}  // namespace
}  // namespace treadmark::testing
