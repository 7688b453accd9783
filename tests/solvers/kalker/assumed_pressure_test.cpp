// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/assumed_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"

namespace treadmark::kalker {
namespace {

/// Of half-spaces that press on each other with Hertz's pressure over an ellipse, in it (Boussinesq 1885): along the
/// chord through (x, y) at an angle the integral of the pressure is known; the mean over all angles is a sum that
/// converges like no other.
double boussinesq(const HertzShape& hertz, double x, double y) {
  constexpr int kDirections = 400;
  constexpr double kPi = std::numbers::pi;
  const Material steel;
  const double compliance =
      0.5 * ((1.0 - steel.poisson_1) / steel.shear_modulus_1 + (1.0 - steel.poisson_2) / steel.shear_modulus_2);
  const double a2 = std::pow(hertz.semi_axis_x, 2), b2 = std::pow(hertz.semi_axis_y, 2);
  double sum = 0.0;
  for (int k = 0; k < kDirections; ++k) {
    const double c = std::cos(kPi * k / kDirections), s = std::sin(kPi * k / kDirections);
    const double rest = 1.0 - x * x / a2 - y * y / b2, lean = x * c / a2 + y * s / b2, bend = c * c / a2 + s * s / b2;
    sum += 0.5 * kPi * (lean * lean + rest * bend) / std::pow(bend, 1.5);
  }
  return hertz_max_pressure(hertz) * compliance * sum / kDirections;
}

TEST(AssumedPressure, DisplacementIsThatOfTheHalfSpace) {
  for (const auto& [a, b] : {std::pair{5e-3, 3e-3}, {2e-3, 6e-3}, {4e-3, 4e-3}}) {
    ContactProblem problem;
    problem.hertz = hertz_from_semi_axes(a, b, {true, 80e3}, combine(Material{}));
    problem.grid = hertz_grid(*problem.hertz, 21, 17, 1.1);
    problem.normal_model = NormalModel::elliptic;
    problem.normal_force = 80e3;
    ContactSolver solver;
    const ContactSolution solution = solver.solve_normal(problem);
    int inside = 0;
    for (int iy = 0; iy < problem.grid.ny; ++iy)
      for (int ix = 0; ix < problem.grid.nx; ++ix) {
        const double x = problem.grid.x(ix), y = problem.grid.y(iy);
        const std::size_t i = problem.grid.index(ix, iy);
        const double square = 1.0 - x * x / (a * a) - y * y / (b * b);
        EXPECT_NEAR(solution.pressure[i],
                    square > 0.0 ? 1.5 * 80e3 / (std::numbers::pi * a * b) * std::sqrt(square) : 0.0,
                    1e-3 * hertz_max_pressure(*problem.hertz));
        if (square <= 0.0) continue;
        ++inside;
        EXPECT_NEAR(solution.displacement_n[i], boussinesq(*problem.hertz, x, y), 1e-6 * solution.approach)
            << x << ' ' << y;
      }
    EXPECT_GT(inside, 200);
  }
}

}  // namespace
}  // namespace treadmark::kalker
