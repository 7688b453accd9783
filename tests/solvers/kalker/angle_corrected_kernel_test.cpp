// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/angle_corrected_kernel.hpp"

#include <gtest/gtest.h>

#include "point_solutions.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"
#include "treadmark/tests/solvers/kalker/angle_settings.hpp"

namespace treadmark::kalker {
namespace {

using testing::kCorrections;
using testing::settings_of;

constexpr double kAngleDx = 0.5e-3, kAngleDy = 0.4e-3;

InfluenceBlock half_space(double X, double Y) { return ConstantElements(kAngleDx, kAngleDy, 0.28, 0.12).at(X, Y); }

void expect_equal(const InfluenceBlock& found, const InfluenceBlock& expected, double tolerance = 1e-17) {
  for (const auto& [name, c] : kAllCoefficients) EXPECT_NEAR(found.*c, expected.*c, tolerance) << name;
}

TEST(AngleCorrection, WithoutAngleThereIsNone) {
  const InfluenceBlock a = half_space(kAngleDx, 2 * kAngleDy);
  for (const auto correction : kCorrections) expect_equal(corrected_for_angle(a, 0.0, correction), a, 0.0);
}

TEST(AngleCorrection, TurnsVectorsAsByHand) {
  const InfluenceBlock a = half_space(kAngleDx, 2 * kAngleDy);
  const double right_angle = 0.5 * std::numbers::pi;
  // A load along the surface that has turned by a right angle presses; one across it then pulls along -y.
  const InfluenceBlock loads = corrected_for_angle(a, right_angle, AngleCorrection::rotated_loads);
  expect_equal(
      loads,
      {.xx = a.xx, .xy = a.xn, .xn = -a.xy, .yx = a.yx, .yy = a.yn, .yn = -a.yy, .nx = a.nx, .ny = a.nn, .nn = -a.ny});
  // Seen in directions that have turned by a right angle, normal displacement is tangential and the other way round.
  const InfluenceBlock seen = corrected_for_angle(a, right_angle, AngleCorrection::rotated_displacements);
  expect_equal(
      seen,
      {.xx = a.xx, .xy = a.xy, .xn = a.xn, .yx = -a.nx, .yy = -a.ny, .yn = -a.nn, .nx = a.yx, .ny = a.yy, .nn = a.yn});
  // Opposite surfaces: tractions act the other way in y and n.
  const InfluenceBlock opposite = corrected_for_angle(a, 2.0 * right_angle, AngleCorrection::rotated_loads);
  expect_equal(opposite, {.xx = a.xx,
                          .xy = -a.xy,
                          .xn = -a.xn,
                          .yx = a.yx,
                          .yy = -a.yy,
                          .yn = -a.yn,
                          .nx = a.nx,
                          .ny = -a.ny,
                          .nn = -a.nn});
}

TEST(AngleCorrection, SecondVariantKeepsRollingDisplacementByPressure) {
  const InfluenceBlock a = half_space(-kAngleDx, 3 * kAngleDy);
  InfluenceBlock expected = corrected_for_angle(a, 0.3, AngleCorrection::rotated_loads);
  EXPECT_NE(expected.xn, a.xn);
  expected.xn = a.xn;
  expect_equal(corrected_for_angle(a, 0.3, AngleCorrection::rotated_loads_but_xn), expected, 0.0);
}

TEST(AngleCorrection, HalfAndHalfHasThePublishedForm) {
  const InfluenceBlock a = half_space(2 * kAngleDx, -kAngleDy);
  const double alpha = 0.4, c = std::cos(alpha), s = std::sin(alpha), ch = std::cos(alpha / 2),
               sh = std::sin(alpha / 2);
  const double mean = (a.yy + a.nn) / 2, difference = (a.yy - a.nn) / 2;
  expect_equal(corrected_for_angle(a, alpha, AngleCorrection::half_and_half),
               {.xx = a.xx,
                .xy = a.xy * ch + a.xn * sh,
                .xn = a.xn * ch - a.xy * sh,
                .yx = a.xy * ch + a.xn * sh,
                .yy = difference + mean * c + a.yn * s,
                .yn = a.yn * c - mean * s,
                .nx = a.xy * sh - a.xn * ch,
                .ny = mean * s - a.yn * c,
                .nn = -difference + mean * c + a.yn * s});
}

Material dissimilar() {
  Material m;
  m.shear_modulus_1 = 60e9;
  m.poisson_1 = 0.2;
  return m;
}

std::shared_ptr<const InfluenceKernel> make_corrected(const InfluenceSettings& settings) {
  return make_influence_kernel(dissimilar(), settings, kAngleDx, kAngleDy, 30.0, 0.0);
}

TEST(AngleCorrectedKernel, AngleFollowsTheStraightLineThroughTheInclinations) {
  // Points on both sides of alpha = 0.1 + 20 y that leave its least-squares fit where it is.
  const std::vector<double> position{-0.01, 0.0, 0.01, 0.02},
      inclination{-0.1 + 0.01, 0.1 - 0.01, 0.3 - 0.01, 0.5 + 0.01};
  const CombinedMaterial combined = combine(dissimilar());
  const ConstantElements plain(kAngleDx, kAngleDy, combined.poisson, combined.difference);
  for (int variant = 1; variant <= 4; ++variant) {
    const auto kernel = make_corrected(settings_of(position, inclination, variant));
    for (const int iy : {0, 3, -4}) {
      const double Y = iy * kAngleDy, y_load = 0.003, y_observed = y_load + Y;
      const double alpha = (0.1 + 20.0 * y_load) - (0.1 + 20.0 * y_observed);
      expect_equal(kernel->at(kAngleDx, Y),
                   corrected_for_angle(plain.at(kAngleDx, Y), alpha, static_cast<AngleCorrection>(variant)), 1e-16);
    }
  }
}

TEST(AngleCorrectedKernel, APlaneNeedsNoCorrection) {
  const CombinedMaterial combined = combine(dissimilar());
  const ConstantElements plain(kAngleDx, kAngleDy, combined.poisson, combined.difference);
  for (int variant = 1; variant <= 4; ++variant)
    expect_equal(make_corrected(settings_of({0.0, 0.01}, {0.3, 0.3}, variant))->at(kAngleDx, 5 * kAngleDy),
                 plain.at(kAngleDx, 5 * kAngleDy), 0.0);
}

TEST(AngleCorrectedKernel, FourthVariantIsReciprocalAndSymmetric) {
  const auto kernel = make_corrected(settings_of({0.0, 0.01}, {0.0, 0.5}, 4));
  EXPECT_TRUE(kernel->symmetric() && kernel->coupled());
  for (const auto& [X, Y] : {std::pair{kAngleDx, 4 * kAngleDy}, {-3 * kAngleDx, 7 * kAngleDy}, {0.0, -2 * kAngleDy}}) {
    const InfluenceBlock there = kernel->at(X, Y), back = kernel->at(-X, -Y);
    expect_equal(there, {.xx = back.xx,
                         .xy = back.yx,
                         .xn = back.nx,
                         .yx = back.xy,
                         .yy = back.yy,
                         .yn = back.ny,
                         .nx = back.xn,
                         .ny = back.yn,
                         .nn = back.nn});
    expect_equal(kernel->at(-X, Y), mirrored(there, true, false));
    expect_equal(kernel->at(X, -Y), mirrored(there, false, true));
  }
  for (int variant = 1; variant <= 3; ++variant)
    EXPECT_FALSE(make_corrected(settings_of({0.0, 0.01}, {0.0, 0.5}, variant))->symmetric());
}

TEST(AngleCorrectedKernel, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(make_corrected(settings_of({0.0, 0.01}, {0.0, 0.5}, 0)), Error);
  EXPECT_THROW(make_corrected(settings_of({0.0, 0.01}, {0.0, 0.5}, 5)), Error);
  EXPECT_THROW(make_corrected(settings_of({0.0, 0.01}, {0.0}, 4)), Error);
  EXPECT_THROW(make_corrected(settings_of({}, {}, 4)), Error);
  EXPECT_THROW(make_corrected(settings_of({0.01, 0.01}, {0.0, 0.5}, 4)), Error);
  InfluenceSettings row_by_row = settings_of({0.0, 0.01}, {0.0, 0.5}, 4);
  row_by_row.linear = false;
  try {
    make_corrected(row_by_row);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_FALSE(error.advice().empty());
  }
}

}  // namespace
}  // namespace treadmark::kalker
