// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/bench/phases/solved_case.hpp"

namespace treadmark::bench {
namespace {

constexpr int kSteps = 20;

/// Steps of transient rolling at the height of the solved case, none as long as another.
std::vector<Vec3> roll(wheelrail::Pair& pair, wheelrail::Problem p) {
  std::vector<Vec3> forces;
  p.regime = kalker::Regime::transient;
  p.vertical_force.reset();
  p.history = kalker::HistoryUse::start;
  for (int i = 0; i < kSteps; ++i) {
    forces.push_back(pair.solve(p).load.track.force);
    p.history = kalker::HistoryUse::keep_going;
    p.discretisation.dq_relative = 1.0 + 1e-4 * std::sin(i);
    const double travelled = p.discretisation.dq_relative * p.discretisation.dx;
    p.state.position.x += travelled;
    p.state.position.pitch -= travelled / p.wheelset.nominal_radius;
  }
  return forces;
}

// Agreement: both ways give the same forces, to a ten-millionth of the load.
void rolling_steps(benchmark::State& state, bool as_simulated) {
  const SolvedCase& s = solved_case("analytic");
  wheelrail::Problem plain = s.problem;
  plain.state.position.z = s.solution.z;
  wheelrail::Problem kept = plain;
  kept.discretisation.usual_dq_relative = 1.0;
  wheelrail::Pair pair(s.geometry);
  const std::vector<Vec3> a = roll(pair, plain), b = roll(pair, kept);
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!((a[i] - b[i]).norm() < 1e-7 * *s.problem.vertical_force) || !(a[i].z() > 0.0)) {
      refuse(state, "forces of rolling steps as simulations take them differ from those of single cases");
      return;
    }
  for (auto _ : state) benchmark::DoNotOptimize(roll(pair, as_simulated ? kept : plain));
  state.counters["step"] = time_each(kSteps);
}

}  // namespace

BENCHMARK_CAPTURE(rolling_steps, as_cases, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rolling_steps, as_simulated, true)->Unit(benchmark::kMillisecond);

}  // namespace treadmark::bench
