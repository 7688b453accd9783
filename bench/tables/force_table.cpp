// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What one wheel costs by a table of forces, with the height given and with the load.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "treadmark/backends/create.hpp"
#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/solvers/vehicle/contacts/force_table.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::bench {
namespace {

using vehicle::ForceTable;

constexpr double kRadius = 0.46, kSpeed = 20.0, kLoad = 8e4;

wheelrail::Geometry standard_pair() {
  static const wheelrail::Geometry bodies{
      create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}, 0.0}).surface,
      create_natural({Body::wheel, kRadius, StandardProfile{"S1002"}, {}, 0.0}).surface, true, true};
  return bodies;
}

wheelrail::Problem standard_problem() {
  wheelrail::Problem p;
  p.track.cant = 1.0 / 40.0;
  p.discretisation.dx = p.discretisation.ds = 1e-3;
  return p;
}

/// axes: with rolls and yaws.
ForceTable table_of(bool axes, bool exact_creep) {
  vehicle::ContactTableOptions options{
      .lateral_range = 3e-3, .growth = 0.0, .step = 1e-3, .element_size = 1e-3, .heavier = {}};
  if (axes) options.roll = {6e-3, 2}, options.yaw = {12e-3, 2};
  const wheelrail::Problem p = standard_problem();
  return {vehicle::build_contact_table(standard_pair(), p, kLoad, options), wheelrail::Side::right,
          exact_creep ? vehicle::build_creep_table(combine(p.material).poisson, {2, 2, 4.0, 8, 6}) : nullptr};
}

// Agreement: the comparison with the exact theory, here of a coarse table.
std::string check(const ForceTable& table) {
  const vehicle::TableCheck found = vehicle::check_table(table, standard_pair(), standard_problem(), {.points = 10});
  if (found.compared != 10) return "the table does not answer everywhere";
  constexpr double kHeight = 20e-6, kForce = 0.3;
  if (found.of("z").rms > kHeight || found.of("normal_force").rms > kForce)
    return "the table is far from the exact theory";
  return "";
}

void force_table(benchmark::State& state, bool axes, bool exact_creep, bool load) {
  ForceTable table = table_of(axes, exact_creep);
  if (const std::string wrong = check(table); !wrong.empty()) {
    refuse(state, wrong);
    return;
  }
  vehicle::WheelMotion w;
  w.motion.wheelset_velocity.x = kSpeed, w.motion.wheelset_velocity.pitch = -1.001 * kSpeed / kRadius;
  w.vertical_load = kLoad;
  w.motion.wheelset.z = table.at(w).z;
  if (!load) w.vertical_load = 0.0;
  int step = 0;
  for (auto _ : state) {
    w.motion.wheelset.y = 1e-5 * (step % 100);
    w.motion.wheelset.yaw = 1e-5 * (step++ % 70);
    benchmark::DoNotOptimize(table.at(w).reaction.normal_force);
  }
}

}  // namespace

BENCHMARK_CAPTURE(force_table, one_sheet / linear / height, false, false, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(force_table, nine_sheets / linear / height, true, false, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(force_table, nine_sheets / exact_table / height, true, true, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(force_table, nine_sheets / exact_table / load, true, true, true)->Unit(benchmark::kMicrosecond);

}  // namespace treadmark::bench
