// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <benchmark/benchmark.h>

#include <cmath>

#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/bench/phases/solved_case.hpp"

namespace treadmark::bench {
namespace {

// Agreement: tractions keep to the friction bound, adhesion elements do not slip, slipping ones oppose their slip.
bool conditions_hold(const kalker::ContactSolution& s) {
  const double largest_slip = 1e-3;  // of the order of the creepage
  for (std::size_t i = 0; i < s.pressure.size(); ++i) {
    const double bound = s.friction[i] * s.pressure[i];
    const double traction = std::hypot(s.traction_x[i], s.traction_y[i]);
    if (traction > bound * (1.0 + 1e-4) + 1.0) return false;
    if (s.state[i] == kalker::ElementState::adhesion && std::hypot(s.slip_x[i], s.slip_y[i]) > 1e-2 * largest_slip)
      return false;
    if (s.state[i] == kalker::ElementState::slip && s.traction_x[i] * s.slip_x[i] + s.traction_y[i] * s.slip_y[i] > 1.0)
      return false;
  }
  return true;
}

void tangential(benchmark::State& state, bool warm) {
  const kalker::ContactProblem problem = patch_problem(solved_case("spline"));
  kalker::ContactSolver solver;
  const kalker::ContactSolution normal = solver.solve_normal(problem);
  kalker::ContactSolution solution = normal;
  solver.solve_tangential(problem, solution);
  if (solution.tangential.status != Status::ok || !conditions_hold(solution)) {
    refuse(state, "friction conditions are violated");
    return;
  }
  for (auto _ : state) {
    if (!warm) solver.reset();
    kalker::ContactSolution s = normal;
    solver.solve_tangential(problem, s);
    benchmark::DoNotOptimize(s);
  }
  state.counters["contact_elements"] = solution.elements_contact;
}

}  // namespace

BENCHMARK_CAPTURE(tangential, cold, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tangential, warm, true)->Unit(benchmark::kMillisecond);

}  // namespace treadmark::bench
