// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker {
namespace {

/// C11, C22, C23 and the last one once more, from the moment that lateral creepage makes.
using Coefficients = std::array<double, 4>;

struct PrintedCoefficients {
  double ratio = 0.0;
  const char* name = "";
  double c11 = 0.0, c22 = 0.0, c23 = 0.0, poisson = 0.25;
};

/// Kalker 1990, table E.3: three digits.
constexpr std::array<PrintedCoefficients, 9> kTable{{{0.1, "a/b=0.1", 3.31, 2.52, 0.473},
                                                     {0.2, "a/b=0.2", 3.37, 2.63, 0.603},
                                                     {0.5, "a/b=0.5", 3.62, 3.01, 0.929},
                                                     {1.0, "a/b=1", 4.12, 3.67, 1.47},
                                                     {2.0, "a/b=2", 5.10, 4.90, 2.62},
                                                     {5.0, "a/b=5", 7.78, 8.14, 6.63},
                                                     {10.0, "a/b=10", 11.7, 12.8, 14.6},
                                                     {1.0, "a/b=1,nu=0", 3.40, 3.40, 1.33, 0.0},
                                                     {1.0, "a/b=1,nu=0.5", 5.20, 3.98, 1.63, 0.5}}};
constexpr std::array<int, 3> kSizes{20, 40, 80};

/// Slopes of the forces of steady rolling on n elements across the contact in each direction, so small a creepage and
/// so much friction that nothing slips.
Coefficients slopes(double ratio, double poisson, int n) {
  const Material material{82e9, 82e9, poisson, poisson};
  const double size = 5e-3;
  const HertzShape shape =
      hertz_from_semi_axes(size * std::sqrt(ratio), size / std::sqrt(ratio), {true, 1e5}, combine(material));
  const double margin = 1.0 + 2.0 / n;  // one element on each side
  testing::OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, n + 2, n + 2, margin));
  ContactProblem& problem = owned.problem;
  problem.material = material;
  problem.settings.eps = 1e-7;
  problem.friction.kinetic = 1e3;
  problem.regime = Regime::steady;
  const double creepage = 1e-7, spin = creepage / size;
  ContactSolver solver;
  const auto roll = [&](Creepage c) {
    problem.creepage = c;
    const ContactSolution s = solver.solve(problem);
    EXPECT_EQ(s.status, Status::ok) << s.tangential.message;
    EXPECT_EQ(s.elements_slip, 0);
    return s;
  };
  const ContactSolution x = roll({creepage, 0.0, 0.0}), y = roll({0.0, creepage, 0.0}), z = roll({0.0, 0.0, spin});
  // c of the area of whole elements in contact: the coefficients depend on the form, and hardly on the jagged edge,
  // then
  const double c2 = x.elements_contact * problem.grid.cell_area() / std::numbers::pi, g = material.shear_modulus_1;
  const double c3 = std::pow(c2, 1.5);
  return {-x.force_x / (g * c2 * creepage), -y.force_y / (g * c2 * creepage), -z.force_y / (g * c3 * spin),
          y.moment_n / (g * c3 * creepage)};
}

TEST(LinearCoefficients, SlopesTendToKalkersTable) {
  for (const PrintedCoefficients& printed : kTable) {
    std::array<Coefficients, 3> found{};
    const auto difference = [&](const Coefficients& c) {
      return std::vector<double>{c[0] / printed.c11 - 1.0, c[1] / printed.c22 - 1.0, c[2] / printed.c23 - 1.0,
                                 c[3] / printed.c23 - 1.0};
    };
    for (std::size_t k = 0; k < kSizes.size(); ++k) {
      found[k] = slopes(printed.ratio, printed.poisson, kSizes[k]);
      treadmark::testing::expect_documented(printed.name, kSizes[k], difference(found[k]));
    }
    Coefficients limit{};  // first order
    for (std::size_t i = 0; i < limit.size(); ++i) limit[i] = 2.0 * found[2][i] - found[1][i];
    treadmark::testing::expect_documented(std::string(printed.name) + ",limit", 0, difference(limit));
    // The table's own accuracy; the two values of C23 are equal by reciprocity, whatever the table says.
    for (const double d : difference(limit)) EXPECT_LT(std::abs(d), printed.ratio < 4.0 ? 0.01 : 0.02) << printed.name;
    EXPECT_NEAR(limit[2] / limit[3], 1.0, 5e-4) << printed.name;
    // first order; in slender contacts the rows of whole elements make it irregular
    if (printed.ratio > 2.0) continue;
    for (const std::size_t i : {0u, 1u, 3u}) {
      EXPECT_GT(std::abs(found[0][i] - limit[i]), 2.0 * std::abs(found[2][i] - limit[i])) << printed.name << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace treadmark::kalker
