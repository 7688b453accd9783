// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/hertz.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using std::numbers::pi;
using testing::kSteel;

constexpr HertzLoad kForce{true, 100e3};
/// Elliptic integrals and bisection are evaluated to rounding.
constexpr double kHertzRounding = 1e-12;

double e_star() { return kSteel.shear_modulus / (1.0 - kSteel.poisson); }

TEST(Hertz, SphereFollowsTheClosedForm) {
  const double radius = 0.3, curvature = 1.0 / (2.0 * radius);
  const HertzShape shape = hertz_from_curvatures(curvature, curvature, kForce, kSteel);
  const double a = std::cbrt(3.0 * kForce.value * radius / (4.0 * e_star()));
  EXPECT_NEAR(shape.semi_axis_x, a, kHertzRounding * a);
  EXPECT_NEAR(shape.semi_axis_y, a, kHertzRounding * a);
  EXPECT_NEAR(shape.approach, a * a / radius, kHertzRounding * a * a / radius);
  EXPECT_NEAR(hertz_max_pressure(shape), 1.5 * kForce.value / (pi * a * a), 1e-3);
}

TEST(Hertz, SemiAxesMatchPublishedTable) {
  // Timoshenko & Goodier 1970: cos(theta) = |B-A|/(B+A), semi-axes m and n times the cube root of 3 P / (4 e* (A+B)).
  struct Row {
    double theta_deg, m, n;
  };
  constexpr double kPrinted = 2.5e-3;  // three decimals, made by interpolation in tables of integrals
  for (const Row& row : {Row{30, 2.731, 0.493}, Row{40, 2.136, 0.567}, Row{50, 1.754, 0.641}, Row{60, 1.486, 0.717},
                         Row{70, 1.284, 0.802}, Row{80, 1.128, 0.893}, Row{90, 1.0, 1.0}}) {
    const double sum = 2.0, difference = sum * std::cos(row.theta_deg * pi / 180.0);
    const double small = 0.5 * (sum - difference), large = 0.5 * (sum + difference);
    const HertzShape shape = hertz_from_curvatures(small, large, kForce, kSteel);
    const double unit = std::cbrt(3.0 * kForce.value / (4.0 * e_star() * sum));
    EXPECT_NEAR(shape.semi_axis_x / unit, row.m, kPrinted) << row.theta_deg;
    EXPECT_NEAR(shape.semi_axis_y / unit, row.n, kPrinted) << row.theta_deg;
  }
}

TEST(Hertz, AllInputsDescribeTheSameContact) {
  const HertzShape one = hertz_from_curvatures(0.8, 0.27, kForce, kSteel);
  const double ratio = one.semi_axis_x / one.semi_axis_y;
  const auto expect_same = [&](const HertzShape& other) {
    constexpr double kBisection = 1e-9;
    EXPECT_NEAR(other.curvature_x, one.curvature_x, kBisection);
    EXPECT_NEAR(other.curvature_y, one.curvature_y, kBisection);
    EXPECT_NEAR(other.semi_axis_x / one.semi_axis_x, 1.0, kBisection);
    EXPECT_NEAR(other.semi_axis_y / one.semi_axis_y, 1.0, kBisection);
    EXPECT_NEAR(other.approach / one.approach, 1.0, kBisection);
    EXPECT_NEAR(other.force / one.force, 1.0, kBisection);
  };
  const HertzLoad by_approach{false, one.approach};
  expect_same(hertz_from_curvatures(0.8, 0.27, by_approach, kSteel));
  expect_same(hertz_from_curvature_and_ratio(0.8, ratio, kForce, kSteel));
  expect_same(hertz_from_curvature_and_ratio(0.8, ratio, by_approach, kSteel));
  expect_same(hertz_from_semi_axes(one.semi_axis_x, one.semi_axis_y, kForce, kSteel));
  expect_same(hertz_from_semi_axes(one.semi_axis_x, one.semi_axis_y, by_approach, kSteel));
}

TEST(Hertz, AxesSwapWithTheCurvatures) {
  const HertzShape one = hertz_from_curvatures(0.8, 0.27, kForce, kSteel);
  const HertzShape other = hertz_from_curvatures(0.27, 0.8, kForce, kSteel);
  EXPECT_DOUBLE_EQ(one.semi_axis_x, other.semi_axis_y);
  EXPECT_DOUBLE_EQ(one.semi_axis_y, other.semi_axis_x);
  EXPECT_DOUBLE_EQ(one.approach, other.approach);
  EXPECT_LT(one.semi_axis_x, one.semi_axis_y) << "the larger curvature goes with the smaller semi-axis";
}

TEST(Hertz, NearlyCircularContactsAreSmooth) {
  // The quotient that defines one of the integrals is 0/0 for a circle.
  const double circle = hertz_from_curvatures(1.0, 1.0, kForce, kSteel).approach;
  for (const double difference : {1e-3, 1e-5, 1e-7, 1e-9})
    EXPECT_NEAR(hertz_from_curvatures(1.0 + difference, 1.0, kForce, kSteel).approach / circle, 1.0,
                2.0 * difference + 1e-14);
}

TEST(Hertz, LineContactOfTheCarterProblem) {
  // R = 500 mm against a plane, a = 1 mm: F = pi a^2 G / (4 R (1 - nu)) per length.
  const double half_length = 0.1, a = 1e-3, radius = 0.5;
  const double force = 2.0 * half_length * pi * a * a * e_star() / (4.0 * radius);
  const HertzShape shape = hertz_line_from_curvature(1.0 / (2.0 * radius), half_length, {true, force}, kSteel);
  EXPECT_NEAR(shape.semi_axis_x, a, kHertzRounding * a);
  EXPECT_TRUE(is_line_contact(shape));
  EXPECT_NEAR(hertz_max_pressure(shape), 2.0 * force / (pi * a * 2.0 * half_length), 1e-3);
  const HertzShape back = hertz_line_from_semi_axis(a, half_length, {true, force}, kSteel);
  EXPECT_NEAR(back.curvature_x, 1.0, kHertzRounding);
}

TEST(Hertz, PressuresIntegrateToTheForce) {
  const HertzShape ellipse = hertz_from_semi_axes(4e-3, 7e-3, kForce, kSteel);
  const HertzShape strip = hertz_line_from_semi_axis(2e-3, 50e-3, kForce, kSteel);
  constexpr double kQuadrature = 2e-4;  // midpoint rule on a jagged edge
  for (const HertzShape& shape : {ellipse, strip}) {
    const Grid2 grid = hertz_grid(shape, 400, 400, 1.1);
    double full = 0.0, parabolic = 0.0;
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix) {
        full += hertz_pressure(shape, grid.x(ix), grid.y(iy));
        parabolic += parabolic_pressure(shape, grid.x(ix), grid.y(iy));
      }
    EXPECT_NEAR(full * grid.cell_area() / kForce.value, 1.0, kQuadrature);
    EXPECT_NEAR(parabolic * grid.cell_area() / kForce.value, 1.0, kQuadrature);
  }
}

TEST(Hertz, GridCoversTheEllipseSymmetrically) {
  const HertzShape shape = hertz_from_semi_axes(4e-3, 7e-3, kForce, kSteel);
  const Grid2 grid = hertz_grid(shape, 40, 31, 1.25);
  EXPECT_NEAR(grid.dx, 2.0 * 1.25 * 4e-3 / 40, 1e-18);
  EXPECT_NEAR(grid.x(0), -grid.x(39), 1e-18);
  EXPECT_NEAR(grid.y(15), 0.0, 1e-18);
  EXPECT_NEAR(grid.y(30) + 0.5 * grid.dy, 1.25 * 7e-3, 1e-17);
}

TEST(Hertz, GridOfAStripHasWholeRowsInside) {
  const HertzShape shape = hertz_line_from_semi_axis(1e-3, 60e-3, kForce, kSteel);
  const Grid2 grid = hertz_grid(shape, 20, 15, 1.25);
  const auto gap = hertz_gap(shape, grid);
  int rows = 0;
  for (int iy = 0; iy < grid.ny; ++iy) rows += std::isnan(gap[grid.index(10, iy)]) ? 0 : 1;
  EXPECT_NEAR(rows * grid.dy, 120e-3, 1e-15);
  EXPECT_EQ((grid.ny - rows) % 2, 0);
  EXPECT_EQ(hertz_grid(shape, 20, 1, 1.25).dy, 120e-3);
}

TEST(Hertz, RefusesInputWithoutMeaning) {
  EXPECT_THROW(hertz_from_curvatures(0.0, 1.0, kForce, kSteel), Error);
  EXPECT_THROW(hertz_from_curvatures(1.0, 1.0, {true, -1.0}, kSteel), Error);
  EXPECT_THROW(hertz_from_semi_axes(1e-3, std::nan(""), kForce, kSteel), Error);
  EXPECT_THROW(hertz_line_from_curvature(1.0, 0.1, {false, 1e-5}, kSteel), Error);
}

}  // namespace
}  // namespace treadmark::kalker
