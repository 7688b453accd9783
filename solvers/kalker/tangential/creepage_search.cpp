// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/creepage_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "treadmark/solvers/kalker/tangential/prescribed_force.hpp"

namespace treadmark::kalker {

namespace {

/// Forces closer to the friction limit than this cannot be told from full sliding.
constexpr double kFullSliding = 1.0 - 1e-9;
/// Accuracy of tractions on the way to a prescribed force: at first, in relation to the deviation that is left, and by
/// how much it is tightened.
constexpr double kRoughest = 1e-3, kRoughness = 30.0, kRefinement = 0.01;

}  // namespace

CreepageSearch search_creepage(const ContactProblem& problem, PatchSolver& solver,
                               const std::optional<Creepage>& estimate) {
  CreepageSearch outcome;
  outcome.creepage = problem.creepage;
  const double fx = problem.fx_relative.value_or(0.0), fy = problem.fy_relative.value_or(0.0);
  const double size = std::hypot(fx, fy);
  double total = 0.0;
  for (const double bound : solver.bound()) total += bound;
  if (size > 0.0 && (size >= kFullSliding || !(total > 0.0))) {
    solver.slide({fx / size, fy / size});
    outcome.status = Status::not_converged;
    outcome.message =
        "the prescribed tangential force reaches the limit of friction: the contact slides, at a creepage "
        "that is not determined";
    return outcome;
  }
  if (!(total > 0.0)) {
    outcome.status = solver.solve(outcome.creepage, problem.settings.eps) ? Status::ok : Status::not_converged;
    return outcome;
  }

  // The unknowns in the order of the search.
  std::vector<int> unknown;
  if (problem.fx_relative) unknown.push_back(0);
  if (problem.fy_relative) unknown.push_back(1);
  const auto component = [](Creepage& c, int k) -> double& { return k == 0 ? c.xi : c.eta; };
  Creepage start = problem.creepage;
  for (const int k : unknown) {
    component(start, k) = 0.0;
    if (estimate) component(start, k) = k == 0 ? estimate->xi : estimate->eta;
  }
  ForceSearchSettings settings;
  settings.count = static_cast<int>(unknown.size());
  settings.tolerance = problem.settings.eps;
  settings.max_iterations = problem.settings.max_force;
  settings.exact_derivatives = friction_of(problem).constant();
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    settings.target[k] = unknown[k] == 0 ? fx : fy;
    settings.start[k] = component(start, unknown[k]);
  }
  bool solved = true;
  double eps = std::max(kRoughest, settings.tolerance);
  const auto evaluate = [&](std::array<double, 2> values) {
    for (std::size_t k = 0; k < unknown.size(); ++k) component(outcome.creepage, unknown[k]) = values[k];
    ForceSample sample;
    double worst = 0.0;
    const auto measure = [&] {
      solved = solver.solve(outcome.creepage, eps);
      const std::array<double, 2> force = solver.relative_force();
      worst = 0.0;
      for (std::size_t k = 0; k < unknown.size(); ++k) {
        sample.force[k] = force[static_cast<std::size_t>(unknown[k])];
        worst = std::max(worst, std::abs(sample.force[k] - settings.target[k]));
      }
    };
    measure();
    // Far from the target rough tractions will do.
    while (eps > problem.settings.eps && worst < kRoughness * eps) {
      eps = std::max(problem.settings.eps, kRefinement * eps);
      measure();
    }
    sample.sliding = solver.sliding();
    if (worst > settings.tolerance)
      for (std::size_t column = 0; column < unknown.size(); ++column) {
        const std::array<double, 2> d = solver.relative_stiffness(unknown[column]);
        for (std::size_t k = 0; k < unknown.size(); ++k)
          sample.derivative[k][column] = d[static_cast<std::size_t>(unknown[k])];
      }
    return sample;
  };
  const ForceSearchResult found = find_creepage(settings, evaluate);
  if (!found.converged) {
    outcome.status = Status::not_converged;
    outcome.message = "the prescribed tangential force is missed by " + std::to_string(found.residual) +
                      " of the friction limit after " + std::to_string(found.iterations) + " iterations";
  } else if (!solved) {
    outcome.status = Status::not_converged;
  }
  return outcome;
}

}  // namespace treadmark::kalker
