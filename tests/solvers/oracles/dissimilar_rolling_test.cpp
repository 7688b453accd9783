// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker {
namespace {

constexpr double kPi = std::numbers::pi;

/// An aluminium roller on a steel one, radii 50 mm: n elements across the contact. Half-width by Hertz 0.1 mm,
/// `narrowing` times less by the theory at hand, so that the edge is a border between elements.
struct Rollers {
  static constexpr double radius = 0.025, a = 0.1e-3, length = 1.0;

  explicit Rollers(int n, double narrowing = 1.0) {
    const double d = 2.0 * a / narrowing / n;
    const int m = n + 2 * (n / 20 + 1);
    problem.grid = {-0.5 * (m - 1) * d, 0.0, d, length, m, 1};
    for (int i = 0; i < m; ++i) gap.push_back(std::pow(problem.grid.x(i), 2) / (2.0 * radius));
    problem.gap = gap;
    problem.material = {23e9, 82e9, 0.31, 0.28};
    const CombinedMaterial c = combine(problem.material);
    problem.normal_force = kPi * a * a * c.shear_modulus / (4.0 * radius * (1.0 - c.poisson)) * length;
    problem.regime = Regime::steady;
    problem.rolling.chi = kPi;
    problem.settings.eps = 1e-9;
  }
  Rollers(const Rollers&) = delete;

  /// Dundurs' constant.
  double beta() const {
    const CombinedMaterial c = combine(problem.material);
    return c.difference / (1.0 - c.poisson);
  }

  std::vector<double> gap;
  ContactProblem problem;
};

/// All sticks: p + i q solves a singular integral equation with the solution (a + x)^(1/2 + ie) (a - x)^(1/2 - ie)
/// (Bufler 1959), e = ln((1 + beta)/(1 - beta))/(2 pi). Without tangential force the creepage is 2 e a/R, and the
/// contact is narrower than that of Hertz by (1 + 4 e^2)^(1/2).
struct Bufler {
  explicit Bufler(double beta)
      : e(std::atanh(beta) / kPi),
        narrowing(std::sqrt(1.0 + 4.0 * e * e)),
        creepage(2.0 * e * Rollers::a / narrowing / Rollers::radius) {}
  double e, narrowing, creepage;
};

TEST(DissimilarRolling, WithoutSlipItIsBuflersSolution) {
  double before = std::numeric_limits<double>::infinity();
  for (const int n : {50, 100, 200, 400}) {
    const Bufler exact(Rollers(n).beta());
    const double creepage = exact.creepage;
    Rollers rollers(n, exact.narrowing);
    ContactProblem& problem = rollers.problem;
    problem.friction.kinetic = 100.0;
    problem.fx_relative = 0.0;
    problem.creepage.xi = creepage;
    ContactSolver solver;
    const ContactSolution s = solver.solve(problem);
    ASSERT_EQ(s.status, Status::ok) << s.tangential.message;
    treadmark::testing::expect_documented("Bufler", n, {s.creepage.xi / creepage - 1.0});
    EXPECT_EQ(s.elements_contact, n);
    const double error = std::abs(s.creepage.xi / creepage - 1.0);
    EXPECT_GT(before / error, 1.6);
    before = error;
  }
}

TEST(DissimilarRolling, WithVanishingFrictionSlipTurnsWherePressureHasHalfTheForceWithin) {
  // The bodies stretch by -2 beta (1 - nu)/G p under Hertz' pressure; all slips, forwards where |x| < x0, backwards
  // outside: half of the force each.
  double theta = 0.4;
  for (int i = 0; i < 50; ++i)
    theta -= (2.0 * theta + std::sin(2.0 * theta) - 0.5 * kPi) / (2.0 + 2.0 * std::cos(2.0 * theta));
  for (const int n : {50, 100, 200, 400}) {
    Rollers rollers(n);
    const double creepage = rollers.beta() * Rollers::a / Rollers::radius * std::cos(theta);
    ContactProblem& problem = rollers.problem;
    problem.friction.kinetic = 1e-6;
    problem.fx_relative = 0.0;
    problem.creepage.xi = creepage;
    ContactSolver solver;
    const ContactSolution s = solver.solve(problem);
    ASSERT_EQ(s.status, Status::ok) << s.tangential.message;
    treadmark::testing::expect_documented("all-slip", n, {s.creepage.xi / creepage - 1.0});
    // x0 lies within one element
    EXPECT_LT(std::abs(s.creepage.xi / creepage - 1.0), std::tan(theta) / std::cos(theta) * 2.0 / n);
  }
}

TEST(DissimilarRolling, MicroSlipIsThatOfTheReferenceProgram) {
  // Printed creepages for elements of 1 micrometre, 200 across the contact.
  struct Printed {
    double friction, force, creepage;
  };
  for (const Printed& p : {Printed{1e-4, 0.0, 5.260e-4}, Printed{10.0, 0.0, 3.591e-4}, Printed{0.05, 0.0, 4.294e-4},
                           Printed{0.05, 0.75, 2.108e-4}, Printed{0.05, -0.75, 5.392e-4}}) {
    Rollers rollers(200);
    ContactProblem& problem = rollers.problem;
    problem.friction.kinetic = p.friction;
    problem.fx_relative = p.force;
    problem.creepage.xi = p.creepage;
    ContactSolver solver;
    const ContactSolution s = solver.solve(problem);
    ASSERT_EQ(s.status, Status::ok) << s.tangential.message;
    EXPECT_NEAR(s.creepage.xi, p.creepage, 0.55e-7)
        << s.creepage.xi / p.creepage - 1.0 << " mu " << p.friction << ' ' << p.force;
    if (p.friction > 1.0)
      treadmark::testing::expect_documented("Bufler,inside", 200,
                                            {s.creepage.xi / Bufler(rollers.beta()).creepage - 1.0});
  }
}

}  // namespace
}  // namespace treadmark::kalker
