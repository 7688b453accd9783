// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "chebyshev_backend.hpp"
#include "fine_grid.hpp"
#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_surfaces.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/backends/conformance/promises.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/core/report.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/results/summary.hpp"

namespace {

using namespace treadmark;

void expect(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

void core_and_io() {
  const double quarter = std::acos(0.0);
  const Pose X_AB{{1.0, 2.0, 3.0}, rotation_y(quarter)};
  const Vec3 p_A = X_AB.apply({0.0, 0.0, 0.5});  // z turns to x
  expect((p_A - Vec3(1.5, 2.0, 3.0)).norm() <= 1e-15, "a quarter turn about the axle");

  io::CaseResult result;
  result.number = 7;
  result.status = Status::no_contact;
  expect(io::summary(result).rfind("case 7: no_contact", 0) == 0, "the summary of an empty case");
}

/// The wheel with a flat on the rail with a squat that the benchmark is made of, compared, timed, and asked for by key.
void cases() {
  const io::CaseFile file = app::bench_case();
  app::CompareSettings compare;
  compare.backends = {"spline", "chebyshev", "mesh"};
  compare.resolutions = {1e-3, 0.5e-3};
  const io::Comparison comparison = app::compare_cases(file, compare);
  expect(comparison.truth == "analytic" && comparison.candidates.size() == 1 + 2 * compare.backends.size(),
         "the truth, and every backend twice");
  for (const auto& candidate : comparison.candidates) {
    expect(candidate.failure.empty() && !candidate.rows.empty(), "a candidate could not be built");
    std::printf("%s %g mm: pmax %+.3f %%, position %.5f mm\n", candidate.name.c_str(), 1e3 * candidate.resolution,
                1e2 * candidate.rows.front().pmax_error, 1e3 * candidate.rows.front().position_error);
    if (candidate.name != "chebyshev") continue;
    const double tolerance = candidate.resolution < 0.8e-3 ? 2e-3 : 1e-2;  // curvatures at the rims come in late
    expect(std::fabs(candidate.rows.front().pmax_error) < tolerance, "the pressure is that of the formula");
    expect(candidate.rows.front().position_error < 1e-5, "the contact lies where that of the formula lies");
    expect(candidate.wheel.difference.height_max < 1e-6 && candidate.rail.difference.height_max < 1e-6,
           "the series follow the formulas");
  }

  app::BenchSettings bench;
  bench.backends = {"chebyshev"};
  bench.resolutions = {1e-3};
  bench.seconds_per_measure = 1e-3;
  bench.grid = {0.5e-3, 6000};
  const app::BenchReport report = app::bench_surfaces(file, bench);
  for (const app::BenchRow& row : report.rows)
    if (!row.agrees) std::puts(row.reason.c_str());
  expect(report.rows.size() == 2 && report.agrees() && report.rows[0].base_height > 0.0,
         "heights, search and distance");

  io::CaseFile keyed = io::parse_case_text(R"(
[wheel]
shape.standard = "S1002"
[rail]
shape.standard = "60E1"
backend = "chebyshev"
[track]
gauge_mm = 1435.0
gauge_height_mm = 14.0
cant = "1:40"
[wheelset]
flange_back_distance_mm = 1360.0
flange_back_position_mm = -70.0
nominal_radius_mm = 460.0
vertical_force_N = 1e5
velocity_m_s = 2.0
vpitch_rad_s = -4.3478
[material]
shear_modulus_GPa = 82.0
poisson_ratio = 0.28
[friction]
coefficient = 0.3
[discretisation]
dx_mm = 1.0
ds_mm = 1.0
)",
                                           "keyed.toml");
  const io::RunResult run = app::run_cases(keyed);
  bool used = false;
  for (const auto& use : run.surfaces) used = used || (use.body == "rail" && use.backend == "chebyshev");
  expect(used && run.cases.front().status == Status::ok, "rail.backend in a case file");
}

/// The same case by a built-in detector and by one of this program.
void detectors() {
  register_fine_grid();
  app::CompareSettings compare;
  compare.detectors = {"grid", "fine-grid"};
  const io::Comparison comparison = app::compare_cases(app::bench_case(), compare);
  expect(comparison.candidates.size() == 3, "the truth and two detectors");
  for (const auto& candidate : comparison.candidates) {
    expect(candidate.failure.empty(), "a detector could not be made");
    std::printf("%s: pmax %+.4f %%, search %.3g s\n", candidate.name.c_str(), 1e2 * candidate.rows.front().pmax_error,
                candidate.rows.front().search_s);
    expect(std::fabs(candidate.rows.front().pmax_error) < 5e-3, "detectors agree");
  }
}

void refused(void (*call)(), const std::string& words) {
  try {
    call();
  } catch (const Error& error) {
    if (std::string(error.what()).find(words) != std::string::npos) return;
    throw;
  }
  throw std::runtime_error("not refused: " + words);
}

}  // namespace

/// A program outside the project, with a backend of its own: what it can do with the installed package.
int main() {
  try {
    core_and_io();
    refused([] { create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}}, "chebyshev"); }, "unknown backend");
    register_chebyshev();
    refused(register_chebyshev, "exists already");
    expect(backend_names().back() == "chebyshev", "new backends come last");
    const conformance::Record record = conformance::hold_backend("chebyshev", 0.5e-3);
    expect(record.kept(), record.text().c_str());
    cases();
    detectors();
  } catch (const std::exception& error) {
    std::printf("failed: %s\n", error.what());
    return 1;
  }
  std::puts("the installed package works");
  return 0;
}
