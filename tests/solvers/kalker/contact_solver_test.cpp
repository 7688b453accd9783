// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/contact_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::hertzian;
using testing::kSteel;
using testing::OwnedProblem;

OwnedProblem ball() {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 80e3}, kSteel);
  return hertzian(shape, hertz_grid(shape, 24, 24, 1.2));
}

TEST(ContactTotals, SumTheFieldsByHand) {
  ContactProblem problem;
  problem.grid = Grid2{1.0, -2.0, 0.5, 2.0, 2, 2};  // elements at x = 1, 1.5 and y = -2, 0; area 1
  problem.regime = Regime::steady;
  problem.rolling.velocity = 10.0;
  ContactSolution s;
  using enum ElementState;
  s.state = {adhesion, slip, exterior, slip};
  s.pressure = {1.0, 2.0, 0.0, 3.0};
  s.traction_x = {0.1, -0.2, 0.0, 0.3};
  s.traction_y = {0.0, 0.4, 0.0, -0.5};
  s.displacement_n = {0.01, 0.02, 9.0, 0.03};
  s.displacement_x = {0.1, 0.0, 9.0, 0.2};
  s.displacement_y = {0.0, 0.1, 9.0, 0.0};
  s.slip_x = {0.0, 0.5, 0.0, -1.0};
  s.slip_y = {0.0, -1.0, 0.0, 2.0};
  accumulate_totals(problem, s);
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(s.force_n, 6.0, kRounding);
  EXPECT_NEAR(s.force_x, 0.2, kRounding);
  EXPECT_NEAR(s.force_y, -0.1, kRounding);
  EXPECT_NEAR(s.moment_x, 1.0 * -2 + 2.0 * -2 + 3.0 * 0, kRounding);
  EXPECT_NEAR(s.moment_y, -(1.0 * 1 + 2.0 * 1.5 + 3.0 * 1.5), kRounding);
  EXPECT_NEAR(s.moment_n, (0.2) + (0.6 - 0.4) + (-0.75), kRounding);
  EXPECT_NEAR(s.elastic_energy, 0.5 * (0.01 + 0.01 + 0.04 + 0.04 + 0.09 + 0.06), kRounding);
  EXPECT_NEAR(s.frictional_power, 10.0 * (-0.1 - 0.4 - 0.3 - 1.0), kRounding);
  EXPECT_EQ(s.max_pressure, 3.0);
  EXPECT_EQ(s.elements_contact, 3);
  EXPECT_EQ(s.elements_adhesion, 1);
  EXPECT_EQ(s.elements_slip, 2);

  problem.regime = Regime::shift;
  accumulate_totals(problem, s);
  EXPECT_NEAR(s.frictional_power, -1.8, kRounding) << "a shift gives work, not power";
  problem.tangential_model = TangentialModel::fastsim;
  accumulate_totals(problem, s);
  EXPECT_NEAR(s.elastic_energy, 0.5 * (0.01 + 0.01 + 0.04 + 0.04 + 0.09 + 0.06), kRounding)
      << "simplified theory has that of its elastic layer";
  problem.normal_model = NormalModel::parabolic;
  accumulate_totals(problem, s);
  EXPECT_EQ(s.elastic_energy, 0.0) << "an assumed pressure has no displacements";
}

TEST(ContactTotals, MomentBelowTheAccuracyIsZero) {
  OwnedProblem owned = ball();
  owned.problem.regime = Regime::steady;
  owned.problem.tangential_model = TangentialModel::fastsim;
  owned.problem.creepage.xi = 1e-3;
  ContactSolver solver;
  EXPECT_EQ(solver.solve(owned.problem).moment_n, 0.0);
  owned.problem.creepage.phi = 0.5;
  EXPECT_GT(std::abs(solver.solve(owned.problem).moment_n), 1.0);
}

TEST(ContactSolver, FrictionlessEnergyIsTheWorkOfTheLoad) {
  // Hertz: F ~ d^1.5, so that the energy is 2/5 F d.
  OwnedProblem owned = ball();
  ContactSolver solver;
  const ContactSolution solution = solver.solve(owned.problem);
  EXPECT_NEAR(solution.elastic_energy / (0.4 * solution.force_n * solution.approach), 1.0, 2e-3);
  EXPECT_TRUE(solution.traction_x.empty());
  EXPECT_NEAR(solution.moment_x, 0.0, 1e-3);
  EXPECT_NEAR(solution.moment_y, 0.0, 1e-3);
}

TEST(ContactSolver, TwoCallsAreOneSolve) {
  OwnedProblem owned = ball();
  owned.problem.regime = Regime::steady;
  owned.problem.tangential_model = TangentialModel::fastsim;
  owned.problem.creepage = {5e-4, -3e-4, 0.2};
  ContactSolver one, two;
  const ContactSolution together = one.solve(owned.problem);
  ContactSolution apart = two.solve_normal(owned.problem);
  EXPECT_TRUE(apart.traction_x.empty());
  two.solve_tangential(owned.problem, apart);
  EXPECT_EQ(together.traction_x, apart.traction_x);
  EXPECT_EQ(together.force_y, apart.force_y);
  EXPECT_EQ(together.creepage.xi, 5e-4);
  EXPECT_EQ(together.rolling_step, owned.problem.grid.dx);
}

TEST(ContactSolver, FullModelChecksAgainstFastsim) {
  OwnedProblem owned = ball();
  owned.problem.regime = Regime::steady;
  owned.problem.creepage.xi = 6e-4;
  ContactSolver solver;
  const ContactSolution full = solver.solve(owned.problem);
  ASSERT_EQ(full.status, Status::ok) << full.tangential.message;
  owned.problem.tangential_model = TangentialModel::fastsim;
  const ContactSolution simple = solver.solve(owned.problem);
  // Simplified theory is known to differ by up to about ten per cent.
  EXPECT_NEAR(simple.force_x / full.force_x, 1.0, 0.1);
  EXPECT_GT(full.elastic_energy, 0.0);
  EXPECT_LT(full.frictional_power, 0.0);
  EXPECT_EQ(full.elements_adhesion + full.elements_slip, full.elements_contact);
}

TEST(ContactSolver, WithoutContactThereAreNoForces) {
  OwnedProblem owned = ball();
  owned.problem.force_prescribed = false;
  owned.problem.approach = -1e-4;
  owned.problem.regime = Regime::steady;
  ContactSolver solver;
  const ContactSolution solution = solver.solve(owned.problem);
  EXPECT_EQ(solution.status, Status::no_contact);
  EXPECT_EQ(solution.force_n, 0.0);
  EXPECT_EQ(solution.force_x, 0.0);
  EXPECT_EQ(solution.traction_x.size(), owned.problem.grid.size());
}

TEST(ContactSolver, TangentialProblemNeedsTheNormalSolution) {
  OwnedProblem owned = ball();
  owned.problem.regime = Regime::steady;
  ContactSolver solver;
  ContactSolution empty;
  EXPECT_THROW(solver.solve_tangential(owned.problem, empty), Error);
}

TEST(ContactSolver, MovesAndResets) {
  OwnedProblem owned = ball();
  ContactSolver solver;
  const ContactSolution first = solver.solve(owned.problem);
  ContactSolver moved = std::move(solver);
  EXPECT_EQ(moved.solve(owned.problem).normal.iterations, 0) << "the last solution moves along";
  moved.reset();
  EXPECT_EQ(moved.solve(owned.problem).pressure, first.pressure);
}

}  // namespace
}  // namespace treadmark::kalker
