// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::kSteel;

ContactSolution solve(const HertzShape& shape, const Grid2& grid) {
  ContactProblem problem;
  problem.grid = grid;
  problem.hertz = shape;
  problem.normal_model = NormalModel::semi_double_elliptic;
  problem.normal_force = shape.force;
  ContactSolver solver;
  return solver.solve_normal(problem);
}

TEST(SemiDoubleElliptic, WithEqualHalvesItIsHertz) {
  const HertzShape shape = hertz_semi_double_elliptic(5e-3, 3e-3, 3e-3, {true, 80e3}, kSteel);
  const HertzShape hertz = hertz_from_semi_axes(5e-3, 3e-3, {true, 80e3}, kSteel);
  EXPECT_TRUE(is_semi_double_elliptic(shape));
  EXPECT_FALSE(is_semi_double_elliptic(hertz));
  EXPECT_EQ(shape.approach, hertz.approach);
  for (const double x : {0.0, 1e-3, -4.5e-3})
    for (const double y : {0.0, 2e-3, -2.9e-3})
      EXPECT_NEAR(semi_double_elliptic_pressure(shape, x, y), hertz_pressure(hertz, x, y),
                  1e-6 * hertz_max_pressure(hertz));
}

TEST(SemiDoubleElliptic, CarriesTheForceOnAPatchThatFillsItsGrid) {
  const double a = 5e-3, minus = 6e-3, plus = 2e-3;
  const HertzShape shape = hertz_semi_double_elliptic(a, minus, plus, {true, 80e3}, kSteel);
  const Grid2 grid = hertz_grid(shape, 200, 200, 1.0);
  const ContactSolution solution = solve(shape, grid);
  EXPECT_NEAR(solution.force_n / 80e3, 1.0, 1e-3);
  EXPECT_NEAR(solution.max_pressure / (1.5 * 80e3 / (M_PI * a * 4e-3)), 1.0, 1e-3);
  // Centre of gravity of a half ellipsoid: 3/8 of its semi-axis from the joint, which lies at (minus - plus)/2.
  const double joint = 0.5 * (minus - plus);
  const double centre = joint + 3.0 / 8.0 * (plus * plus - minus * minus) / (plus + minus);
  EXPECT_NEAR(solution.moment_x / solution.force_n, centre, 1e-5);
  // The patch reaches both ends of the grid and carries most where its halves meet.
  int greatest_row = 0;
  double greatest = 0.0;
  for (int iy = 0; iy < grid.ny; ++iy) {
    double sum = 0.0;
    for (int ix = 0; ix < grid.nx; ++ix) sum += solution.pressure[grid.index(ix, iy)];
    if (sum > greatest) greatest_row = iy;
    greatest = std::max(greatest, sum);
    EXPECT_GT(sum, 0.0) << iy;
  }
  EXPECT_NEAR(grid.y(greatest_row), joint, 0.2e-3);
}

TEST(SemiDoubleElliptic, DisplacementIsThatOfTheHalfSpace) {
  // Equal halves: Hertz' displacement, approach - A x^2 - B y^2, up to the grid.
  const HertzShape shape = hertz_semi_double_elliptic(5e-3, 3e-3, 3e-3, {true, 80e3}, kSteel);
  const Grid2 grid = hertz_grid(shape, 61, 61, 1.0);
  const ContactSolution solution = solve(shape, grid);
  for (const int iy : {15, 30, 40}) {
    const double x = grid.x(25), y = grid.y(iy);
    const double expected = shape.approach - shape.curvature_x * x * x - shape.curvature_y * y * y;
    EXPECT_NEAR(solution.displacement_n[grid.index(25, iy)] / expected, 1.0, 3e-3);
  }
  EXPECT_EQ(solution.elastic_energy, 0.0) << "an assumed pressure has no energy";
}

TEST(SemiDoubleElliptic, RefusesBadInput) {
  EXPECT_THROW(hertz_semi_double_elliptic(0.0, 3e-3, 3e-3, {true, 80e3}, kSteel), Error);
  EXPECT_THROW(hertz_semi_double_elliptic(5e-3, -1e-3, 3e-3, {true, 80e3}, kSteel), Error);
  EXPECT_THROW(hertz_semi_double_elliptic(5e-3, 3e-3, 0.0, {true, 80e3}, kSteel), Error);
  EXPECT_THROW(hertz_semi_double_elliptic(5e-3, 3e-3, std::nan(""), {true, 80e3}, kSteel), Error);
  const HertzShape hertz = hertz_from_semi_axes(5e-3, 3e-3, {true, 80e3}, kSteel);
  EXPECT_THROW(solve(hertz, hertz_grid(hertz, 10, 10, 1.0)), Error) << "no half ellipses are given";
}

}  // namespace
}  // namespace treadmark::kalker
