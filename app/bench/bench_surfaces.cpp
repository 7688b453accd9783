// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/bench_surfaces.hpp"

#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_pair.hpp"
#include "treadmark/app/bench/machine.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"

namespace treadmark::app {
namespace {

using Clock = std::chrono::steady_clock;

std::string name_of(const BackendChoice& c) {
  return c.resolution > 0.0 ? fmt::format("{} {:g} mm", c.backend, 1e3 * c.resolution) : c.backend;
}

void check(const BenchSettings& settings) {
  for (const std::string& name : settings.backends) require_backend(name);
  if (settings.resolutions.empty()) throw Error(ErrorKind::configuration, "no resolution is given");
  for (const double r : settings.resolutions)
    if (!(r > 0.0) || !std::isfinite(r)) throw Error(ErrorKind::configuration, "resolutions must be positive");
  if (!(settings.seconds_per_measure > 0.0) || !(settings.seconds_per_measure <= 600.0))
    throw Error(ErrorKind::configuration, "the time of a measure must be positive and at most 600 seconds");
}

std::array<BenchRow, 2> not_built(const BackendChoice& choice, const Error& error) {
  std::array<BenchRow, 2> rows;
  for (BenchRow& row : rows) {
    row.backend = choice.backend;
    row.resolution = choice.resolution;
    row.reason = fmt::format("cannot be built: {}", error.what());
  }
  rows[1].body = Body::wheel;
  return rows;
}

std::shared_ptr<const Surface> build(const BenchScene& scene, Body body, const BackendChoice& choice, double& seconds) {
  const bool rail = body == Body::rail;
  const Region& region = rail ? scene.regions.rail : scene.regions.wheel;
  const RepresentedSurface r = represent(scene.natural(body), {choice.backend, choice.resolution, region});
  seconds = r.resampled ? r.build_seconds : rail ? scene.rail_build_seconds : scene.wheel_build_seconds;
  return r.surface;
}

}  // namespace

BenchReport bench_surfaces(const io::CaseFile& file, const BenchSettings& settings, const Progress& progress) {
  const auto start = Clock::now();
  check(settings);
  const BenchScene scene = make_bench_scene(file, settings.grid);
  const std::vector<BackendChoice> wanted =
      backend_choices(settings.backends, settings.resolutions, {scene.rail.get(), scene.wheel.get()});

  BenchReport out;
  out.version = version();
  out.git = git_revision();
  out.date = date_now();
  out.machine = machine_name();
  out.compiler = compiler_name();
  out.libraries = library_versions();
  out.threads = thread_count();
  out.seconds_per_measure = settings.seconds_per_measure;
  out.input_file = file.path.string();
  out.input_sha256 = file.sha256;
  out.inputs = io::inputs_of(file.cases, file.path.parent_path());
  const std::string rail(scene.rail->surface->backend()), wheel(scene.wheel->surface->backend());
  out.truth = rail == wheel ? rail : fmt::format("wheel {}, rail {}", wheel, rail);

  constexpr std::size_t kBuilds = 2, kSteps = kBuilds + kStepsOfPair;
  for (std::size_t n = 0; n < wanted.size() && out.complete; ++n) {
    const BackendChoice& choice = wanted[n];
    std::size_t done = n * kSteps;
    const auto step = [&](const std::string& what) {
      if (progress.report) progress.report(done, wanted.size() * kSteps, name_of(choice) + ", " + what);
      ++done;
      return !progress.stop_requested();
    };
    try {
      BenchPair pair{
          choice.backend, choice.resolution, nullptr, nullptr, 0.0, 0.0, backend_of(choice.backend).over_base};
      const bool go_on = step("building the rail");
      if (go_on) pair.rail = build(scene, Body::rail, choice, pair.rail_build_seconds);
      if (go_on && step("building the wheel")) pair.wheel = build(scene, Body::wheel, choice, pair.wheel_build_seconds);
      const auto rows = pair.wheel ? measure_pair(scene, pair, settings.seconds_per_measure, step) : std::nullopt;
      if (rows)
        out.rows.insert(out.rows.end(), rows->begin(), rows->end());
      else
        out.complete = false;
    } catch (const Error& e) {
      const auto rows = not_built(choice, e);
      out.rows.insert(out.rows.end(), rows.begin(), rows.end());
    }
  }
  out.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return out;
}

}  // namespace treadmark::app
