// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/support/counting_token.hpp"

namespace treadmark::kalker {
namespace {

using treadmark::testing::CountingToken;

testing::OwnedProblem rolling_problem(int elements, Regime regime, SolverSettings::Method method) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 80e3}, combine(Material{}));
  testing::OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, elements, elements, 1.2));
  owned.problem.regime = regime;
  owned.problem.creepage = {1e-3, -5e-4, 0.1};
  owned.problem.rolling.step = owned.problem.grid.dx;
  owned.problem.settings.method = method;
  return owned;
}

TEST(CancelledSolves, EndAtTheNextCheckPointAndLeaveASolverThatCanBeReset) {
  const ThreadLimit one(1);
  for (const Regime regime : {Regime::steady, Regime::transient, Regime::shift})
    for (const auto method : {SolverSettings::Method::automatic, SolverSettings::Method::sweeps}) {
      const testing::OwnedProblem owned = rolling_problem(12, regime, method);
      const ContactSolution expected = ContactSolver().solve(owned.problem);
      const CountingToken never;
      {
        const CancellationScope scope(&never);
        ContactSolver().solve(owned.problem);
      }
      // one an iteration at least
      EXPECT_GE(never.passed(), expected.normal.iterations + expected.tangential.iterations);
      for (const long last : {1L, 2L, never.passed() / 3, never.passed() / 2, never.passed()}) {
        ContactSolver solver;
        const CountingToken token(last);
        {
          const CancellationScope scope(&token);
          EXPECT_THROW(solver.solve(owned.problem), Cancelled);
        }
        EXPECT_EQ(token.passed(), last);
        solver.reset();
        const ContactSolution again = solver.solve(owned.problem);
        EXPECT_EQ(again.traction_x, expected.traction_x);
        EXPECT_EQ(again.pressure, expected.pressure);
      }
    }
}

TEST(CancelledSolves, CheckPointsOfLargeProblemsAreClose) {
  // Between two check points lies one product with the matrix at most: their number follows that of products.
  const ThreadLimit one(1);
  const testing::OwnedProblem owned = rolling_problem(100, Regime::transient, SolverSettings::Method::automatic);
  const CountingToken token;
  ContactSolution solution;
  {
    const CancellationScope scope(&token);
    solution = ContactSolver().solve(owned.problem);
  }
  EXPECT_EQ(solution.status, Status::ok);
  EXPECT_GE(token.passed(), solution.normal.iterations + 2 * solution.tangential.iterations);
}

}  // namespace
}  // namespace treadmark::kalker
