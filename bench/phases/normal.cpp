// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <benchmark/benchmark.h>

#include <cmath>

#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/bench/phases/solved_case.hpp"

namespace treadmark::bench {
namespace {

// Agreement: the complementarity conditions of the normal problem hold in every element.
bool conditions_hold(const kalker::ContactProblem& problem, const kalker::ContactSolution& solution) {
  const double tolerance = 1e-4 * problem.approach;
  for (std::size_t i = 0; i < solution.pressure.size(); ++i) {
    if (std::isnan(problem.gap[i])) continue;
    const double deformed = problem.gap[i] - problem.approach + solution.displacement_n[i];
    if (solution.pressure[i] < 0.0 || deformed < -tolerance) return false;
    if (solution.pressure[i] > 0.0 && std::abs(deformed) > tolerance) return false;
  }
  return solution.elements_contact > 0;
}

void normal(benchmark::State& state, bool warm) {
  const kalker::ContactProblem problem = patch_problem(solved_case("spline"));
  kalker::ContactSolver solver;
  kalker::ContactSolution solution = solver.solve_normal(problem);
  if (!conditions_hold(problem, solution)) {
    refuse(state, "contact conditions are violated");
    return;
  }
  for (auto _ : state) {
    if (!warm) solver.reset();
    solution = solver.solve_normal(problem);
    benchmark::DoNotOptimize(solution);
  }
  state.counters["contact_elements"] = solution.elements_contact;
}

}  // namespace

BENCHMARK_CAPTURE(normal, cold, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(normal, warm, true)->Unit(benchmark::kMillisecond);

}  // namespace treadmark::bench
