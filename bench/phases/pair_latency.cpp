// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What a program waits for one contact of profiles, a round wheel on a prismatic rail as splines, without
// history: by theory, with the height given and with the force.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "treadmark/backends/create.hpp"
#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::bench {
namespace {

using kalker::NormalModel;
using kalker::TangentialModel;

/// What is asked of a pair.
struct Asked {
  NormalModel normal = NormalModel::full;
  TangentialModel tangential = TangentialModel::full;
  bool force = false;  ///< given, else the height
  double lift = 0.0;   ///< of the wheel over where it carries its load [m]
  bool rolls = true;   ///< with tractions
  double element = 1e-3;
};

wheelrail::Geometry profiles() {
  static const wheelrail::Geometry bodies = [] {
    SurfaceSpec rail, wheel;
    rail.shape = StandardProfile{"60E1"}, rail.body = Body::rail;
    wheel.shape = StandardProfile{"S1002"}, wheel.body = Body::wheel, wheel.nominal_radius = 0.46;
    const auto as_spline = [](SurfaceSpec spec) {
      return represent(create_natural(std::move(spec)), {"spline", 0.5e-3, {}}).surface;
    };
    return wheelrail::Geometry{as_spline(std::move(rail)), as_spline(std::move(wheel)), true, true};
  }();
  return bodies;
}

wheelrail::Problem problem_of(const Asked& a) {
  wheelrail::Problem p;
  p.track.cant = 1.0 / 40.0;
  p.wheelset.nominal_radius = 0.46;
  p.discretisation.dx = p.discretisation.ds = a.element;
  p.normal_model = a.normal, p.tangential_model = a.tangential;
  p.regime = a.rolls ? kalker::Regime::steady : kalker::Regime::frictionless;
  p.state.velocity.x = 20.0, p.state.velocity.pitch = -1.001 * 20.0 / 0.46;
  p.vertical_force = 8e4;
  return p;
}

/// The wheel drifts to and fro and yaws: never twice the same problem.
void drift(wheelrail::Problem& p, int step) {
  p.state.position.y = 1e-5 * (step % 20);
  p.state.position.yaw = 1e-5 * (step % 7);
}

// Agreement: the same bits as a pair that was asked nothing before.
std::string check(const Asked& a, wheelrail::Problem p) {
  wheelrail::Pair pair(profiles());
  for (const int step : {3, 15, 8}) {
    drift(p, step);
    const wheelrail::PairSolution found = pair.solve(p), alone = wheelrail::Pair(profiles()).solve(p);
    if (found.status != alone.status || found.load.track.force != alone.load.track.force ||
        found.least_gap != alone.least_gap)
      return "answers depend on what was asked before";
    if (found.status != (a.lift > 0.0 ? Status::no_contact : Status::ok))
      return "another status than is meant: " + found.message;
  }
  return "";
}

void pair_latency(benchmark::State& state, const Asked& a) {
  wheelrail::Problem p = problem_of(a);
  drift(p, 0);
  if (!a.force) {
    const wheelrail::PairSolution s = wheelrail::Pair(profiles()).solve(p);
    p.state.position.z = s.z - a.lift;
    p.vertical_force.reset();
  }
  if (const std::string wrong = check(a, p); !wrong.empty()) {
    refuse(state, wrong);
    return;
  }
  wheelrail::Pair pair(profiles());
  int step = 0, elements = 0;
  for (auto _ : state) {
    drift(p, step++);
    const wheelrail::PairSolution s = pair.solve(p);
    elements = s.patches.empty() ? 0 : s.patches.front().contact.elements_contact;
    benchmark::DoNotOptimize(s.load.track.force);
  }
  state.counters["elements"] = elements;
}

#define LATENCY(name, ...) BENCHMARK_CAPTURE(pair_latency, name, Asked{__VA_ARGS__})->Unit(benchmark::kMicrosecond)

LATENCY(no_contact, .lift = 5e-3);
LATENCY(just_no_contact, .lift = 0.2e-3);
LATENCY(kpec_fastsim / height, .normal = NormalModel::kpec, .tangential = TangentialModel::fastsim);
LATENCY(kpec_fastsim / force, .normal = NormalModel::kpec, .tangential = TangentialModel::fastsim, .force = true);
LATENCY(exact / height, .force = false);
LATENCY(exact / force, .force = true);
LATENCY(normal / exact, .rolls = false);
LATENCY(normal / kpec, .normal = NormalModel::kpec, .rolls = false);
LATENCY(normal / analyn, .normal = NormalModel::analyn, .rolls = false);
#undef LATENCY

}  // namespace
}  // namespace treadmark::bench
