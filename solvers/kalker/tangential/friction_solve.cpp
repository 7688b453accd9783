// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/friction_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "treadmark/solvers/kalker/tangential/friction_sweeps.hpp"

namespace treadmark::kalker {

namespace {

constexpr int kFirstSweeps = 4;
/// Of Newton's method and sweeps in turn. Sweeps double, so that far fewer use up any number of them.
constexpr int kMostRounds = 100;
/// Sweeps stop at this share of the accuracy, because their change a sweep is smaller than the error.
constexpr double kSweepAccuracy = 0.1;

}  // namespace

FrictionSolveResult FrictionSolve::run(const FrictionProblem& problem, FrictionState& state, double eps,
                                       int max_iterations, bool updated) {
  FrictionSolveResult result;
  std::optional<FrictionSweeps> sweeps;
  NewtonSettings settings;
  settings.eps = eps;
  settings.updated = updated;
  settings.max_steps = std::min(settings.max_steps, max_iterations);
  int count = kFirstSweeps;
  double before = std::numeric_limits<double>::infinity();  // violation before the last sweeps
  bool settled = false;                                     // they ended by themselves
  for (int round = 0; round < kMostRounds; ++round) {
    const NewtonResult newton = newton_.solve(problem, state, settings);
    settings.updated = false;
    result.steps += newton.steps;
    result.converged = newton.converged;
    if (newton.converged || result.sweeps >= max_iterations || !std::isfinite(state.violation)) break;
    // Neither method gets on.
    if (settled && newton.steps == 0 && state.violation >= before) break;
    if (!sweeps) sweeps.emplace(*problem.matrix);
    const int most = std::min(count, max_iterations - result.sweeps);
    before = state.violation;
    const int done = sweeps->run(problem, state.traction, kSweepAccuracy * eps, most);
    settled = done < most;
    result.sweeps += done;
    count = std::min(count, max_iterations / 2) * 2;
    state.update(problem);
  }
  return result;
}

FrictionSolveResult FrictionSolve::run_sweeps(const FrictionProblem& problem, FrictionState& state, double eps,
                                              int max_iterations) {
  limit_to_bound(state.traction, problem.bound);
  FrictionSweeps sweeps(*problem.matrix);
  FrictionSolveResult result;
  result.sweeps = sweeps.run(problem, state.traction, kSweepAccuracy * eps, max_iterations);
  state.update(problem);
  result.converged = result.sweeps < max_iterations && std::isfinite(state.violation);
  return result;
}

}  // namespace treadmark::kalker
