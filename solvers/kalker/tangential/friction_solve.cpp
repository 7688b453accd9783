// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/friction_solve.hpp"

#include <algorithm>
#include <optional>

#include "treadmark/solvers/kalker/tangential/friction_sweeps.hpp"

namespace treadmark::kalker {

namespace {

constexpr int kFirstSweeps = 4;
/// Sweeps stop at this share of the accuracy, because their change a sweep is smaller than the error.
constexpr double kSweepAccuracy = 0.1;

}  // namespace

FrictionSolveResult FrictionSolve::run(const FrictionProblem& problem, FrictionState& state, double eps,
                                       int max_iterations) {
  FrictionSolveResult result;
  std::optional<FrictionSweeps> sweeps;
  NewtonSettings settings;
  settings.eps = eps;
  settings.max_steps = std::min(settings.max_steps, max_iterations);
  for (int count = kFirstSweeps;; count *= 2) {
    const NewtonResult newton = newton_.solve(problem, state, settings);
    result.steps += newton.steps;
    result.converged = newton.converged;
    if (newton.converged || result.sweeps >= max_iterations) return result;
    if (!sweeps) sweeps.emplace(*problem.matrix);
    result.sweeps +=
        sweeps->run(problem, state.traction, kSweepAccuracy * eps, std::min(count, max_iterations - result.sweeps));
    state.update(problem);
  }
}

FrictionSolveResult FrictionSolve::run_sweeps(const FrictionProblem& problem, FrictionState& state, double eps,
                                              int max_iterations) {
  limit_to_bound(state.traction, problem.bound);
  FrictionSweeps sweeps(*problem.matrix);
  FrictionSolveResult result;
  result.sweeps = sweeps.run(problem, state.traction, kSweepAccuracy * eps, max_iterations);
  result.converged = result.sweeps < max_iterations;
  state.update(problem);
  return result;
}

}  // namespace treadmark::kalker
