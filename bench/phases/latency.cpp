// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// How long a program waits for one contact after another that is nearly the same, as a simulation of its own asks for
// them.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/bench/phases/solved_case.hpp"

namespace treadmark::bench {
namespace {

/// The wheel rolls on by 2 mm and drifts to and fro by a hundredth of a millimetre: never twice the same problem.
void move_on(wheelrail::Problem& p, int step) {
  constexpr double kOn = 2e-3, kAside = 1e-5;
  p.state.position.pitch -= kOn / p.wheelset.nominal_radius;
  p.state.position.y += step % 2 == 0 ? kAside : -kAside;
}

// Agreement: the vertical force is the prescribed one, and all forces are those of a pair that knows of nothing before.
std::string check(const SolvedCase& s, wheelrail::Problem p, kalker::HistoryUse history) {
  wheelrail::Pair pair(s.geometry);
  const double load = *p.vertical_force;
  constexpr int kSteps = 5;
  for (int i = 0; i < kSteps; ++i) {
    p.history = i == 0 ? kalker::HistoryUse::start : history;
    const Vec3 force = pair.solve(p).load.track.force;
    p.history = kalker::HistoryUse::start;
    const Vec3 alone = wheelrail::Pair(s.geometry).solve(p).load.track.force;
    constexpr double kBalance = 1e-5, kForces = 5e-5;
    if (!(std::abs(force.z() - load) <= kBalance * load)) return "the vertical force is not the prescribed one";
    if (!((force - alone).norm() <= kForces * load)) return "forces depend on what was solved before";
    move_on(p, i);
  }
  return "";
}

void pair_solve(benchmark::State& state, bool flat, kalker::HistoryUse history) {
  const SolvedCase& s = solved_case_of_half_a_millimetre(flat);
  if (const std::string wrong = check(s, s.problem, history); !wrong.empty()) {
    refuse(state, wrong);
    return;
  }
  wheelrail::Pair pair(s.geometry);
  wheelrail::Problem p = s.problem;
  pair.solve(p);
  p.history = history;
  wheelrail::PhaseTimes times;
  int step = 0, elements = 0;
  for (auto _ : state) {
    constexpr int kBack = 10;  // over the flat, and back to where it began
    if (step % kBack == 0) p.state.position = s.problem.state.position;
    move_on(p, step++);
    const wheelrail::PairSolution solution = pair.solve(p);
    times += solution.times;
    elements = solution.patches.front().contact.elements_contact;
  }
  const auto ms = [&](double seconds) { return benchmark::Counter(1e3 * seconds / step); };
  state.counters["search_ms"] = ms(times.search_s);
  state.counters["distance_ms"] = ms(times.distance_s);
  state.counters["normal_ms"] = ms(times.normal_s);
  state.counters["tangential_ms"] = ms(times.tangential_s);
  state.counters["searches"] = times.searches / static_cast<double>(step);
  state.counters["tangentials"] = times.tangential_solves / static_cast<double>(step);
  state.counters["elements"] = elements;
}

}  // namespace

BENCHMARK_CAPTURE(pair_solve, round / alone, false, kalker::HistoryUse::start)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_solve, round / after_another, false, kalker::HistoryUse::keep_going)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_solve, flat / alone, true, kalker::HistoryUse::start)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_solve, flat / after_another, true, kalker::HistoryUse::keep_going)
    ->Unit(benchmark::kMillisecond);

}  // namespace treadmark::bench
