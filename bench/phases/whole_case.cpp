// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <benchmark/benchmark.h>

#include <cmath>

#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/bench/phases/solved_case.hpp"

namespace treadmark::bench {
namespace {

// Agreement: the vertical force is the prescribed one.
void whole_case(benchmark::State& state, const char* backend) {
  const SolvedCase& s = solved_case(backend);
  if (std::abs(s.solution.load.track.force.z() - *s.problem.vertical_force) > 1e-4 * *s.problem.vertical_force) {
    refuse(state, "the vertical force is not the prescribed one");
    return;
  }
  wheelrail::Pair pair(s.geometry);
  for (auto _ : state) benchmark::DoNotOptimize(pair.solve(s.problem));
  state.counters["searches"] = s.solution.times.searches;
}

}  // namespace

BENCHMARK_CAPTURE(whole_case, analytic, "analytic")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_case, spline, "spline")->Unit(benchmark::kMillisecond);

}  // namespace treadmark::bench
