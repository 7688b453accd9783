// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/solvers/kalker/subsurface_load.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker {
namespace {

using testing::at;

constexpr double kPoisson = 0.28;
const Material kSteel{82e9, 82e9, kPoisson, kPoisson};

TEST(SubsurfaceConvergence, BelowASmallElementItIsBoussinesqsPointForce) {
  // On the axis (Johnson 1985, eq. 3.19): axial -3 P/(2 pi z^2), radial (1 - 2 nu) P/(4 pi z^2).
  std::array<double, 2> before{};
  for (const int depths : {2, 4, 8, 16, 32}) {
    const double size = 1e-3, z = depths * size, unit = size * size / (2.0 * std::numbers::pi * z * z);
    const Mat3 stress = at(testing::one_element(size, 1.0, 0.0, 0.0), kSteel, {0.0, 0.0, z}).stress;
    const std::array<double, 2> error{stress(2, 2) / (-3.0 * unit) - 1.0,
                                      stress(0, 0) / (0.5 * (1.0 - 2.0 * kPoisson) * unit) - 1.0};
    treadmark::testing::expect_documented("Boussinesq", depths, {error[0], error[1]});
    for (std::size_t i = 0; i < 2 && depths > 4; ++i) EXPECT_NEAR(before[i] / error[i], 4.0, 0.15) << depths;
    before = error;
  }
}

TEST(SubsurfaceConvergence, BelowASphereItIsHertz) {
  // Johnson 1985, eq. (3.45), on the axis; the pressures are those of the solver.
  const double a = 5e-3;
  const HertzShape shape = hertz_from_semi_axes(a, a, {true, 1e5}, combine(kSteel));
  const double p0 = hertz_max_pressure(shape);
  std::vector<double> before;
  for (const int n : {11, 21, 41, 81}) {
    testing::OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, n, n, 1.2));
    owned.problem.settings.eps = 1e-7;
    const ContactSolution solution = ContactSolver().solve_normal(owned.problem);
    std::vector<double> errors;
    for (const double zeta : {0.25, 0.5, 1.0, 2.0}) {
      const Vec3 point(0.0, 0.0, zeta * a);
      const SurfaceTractions tractions = surface_tractions(owned.problem.grid, solution);
      const Mat3 stress = subsurface_stress(tractions, kSteel, std::span(&point, 1)).front().stress / p0;
      const double axial = -1.0 / (1.0 + zeta * zeta);
      const double radial = -(1.0 + kPoisson) * (1.0 - zeta * std::atan(1.0 / zeta)) - 0.5 * axial;
      errors.push_back(std::hypot(stress(2, 2) - axial, stress(0, 0) - radial));
    }
    treadmark::testing::expect_documented("Hertz-axis", n, errors);
    for (std::size_t i = 0; i < errors.size() && !before.empty(); ++i) EXPECT_GT(before[i] / errors[i], 2.5) << n;
    before = errors;
  }
}

}  // namespace
}  // namespace treadmark::kalker
