// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/stability/stability_run.hpp"

#include <fmt/format.h>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/stability/straight_vehicle.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/vehicle/train.hpp"

namespace treadmark::app {
namespace {

std::vector<double> speeds_of(const StabilityRequest& r) {
  if (!(r.from > 0.0) || !(r.to > r.from) || r.count < 2)
    throw Error(ErrorKind::configuration,
                fmt::format("{} speeds from {:g} to {:g} m/s make no range", r.count, r.from, r.to));
  std::vector<double> speeds;
  speeds.reserve(static_cast<std::size_t>(r.count));
  for (int i = 0; i < r.count; ++i) speeds.push_back(r.from + (r.to - r.from) * i / (r.count - 1.0));
  speeds.back() = r.to;
  return speeds;
}

}  // namespace

StabilityRun run_stability(const StabilityRequest& request, const Progress& progress) {
  StabilityRun run;
  run.request = request;
  vehicle::StabilitySettings settings;
  settings.speeds = speeds_of(request);
  settings.speed_tolerance = request.tolerance;
  io::SimulationFile file = straight_vehicle(request.file, request.overrides);
  if (request.falling && runs_free(file.vehicle))
    throw Error(
        ErrorKind::configuration,
        "--falling slows the frames of the vehicles down, not these vehicles: nothing holds them along the track",
        {file.path.string()}, "take one vehicle whose car is not free in x, or leave --falling out");
  run.title = file.title.empty() ? file.vehicle.name : file.title;
  run.notes = file.notes;
  file.layout.reset();
  file.irregularities.reset();
  SurfaceStore store;
  ContactTables tables(request.cache);
  {
    const CancellationScope scope(progress.stop);
    const vehicle::VehicleOnTrack built = build_vehicle(file, store, &tables).vehicle;
    run.system = built.system;
    run.result = vehicle::stability(
        [&](double speed) {
          vehicle::VehicleOnTrack v = built;
          v.speed = speed;
          v.system = vehicle::assemble(file.vehicle, file.track, speed, file.settings.gravity);
          v.connect();
          return v;
        },
        settings);
  }
  if (request.falling) {
    FallingRequest falling = *request.falling;
    falling.from = request.to;
    falling.to = request.from;
    run.falling = run_falling(file, request.overrides, falling, store, tables, progress);
  }
  return run;
}

std::string stability_verdict(const StabilityRun& run) {
  const vehicle::StabilityResult& r = run.result;
  const auto motion = [&](const vehicle::ModesAtSpeed& at) {
    const vehicle::Eigenmode& mode = at.modes[*at.fastest_growth];
    return mode.frequency > 0.0 ? fmt::format("{:.3g} Hz: {}", mode.frequency, vehicle::describe(mode, run.system))
                                : "without vibration: " + vehicle::describe(mode, run.system);
  };
  switch (r.verdict) {
    case vehicle::StabilityVerdict::stable:
      return fmt::format("stable from {:g} to {:g} m/s ({:.4g} to {:.4g} km/h)", r.at.front().speed, r.at.back().speed,
                         3.6 * r.at.front().speed, 3.6 * r.at.back().speed);
    case vehicle::StabilityVerdict::critical:
      return fmt::format("critical speed {:.5g} m/s ({:.4g} km/h), within {:.2g} m/s; {}", r.critical->speed,
                         3.6 * r.critical->speed, r.critical->error, motion(r.critical->beyond));
    case vehicle::StabilityVerdict::unstable:
      return fmt::format("unstable already at {:g} m/s ({:.4g} km/h); {}", r.at.front().speed, 3.6 * r.at.front().speed,
                         motion(r.at.front()));
    case vehicle::StabilityVerdict::unknown:
      break;
  }
  const auto failed = ranges::find_if(r.at, [](const auto& at) { return at.report.status != Status::ok; });
  return fmt::format("not known: at {:g} m/s {}", failed->speed, failed->report.message);
}

}  // namespace treadmark::app
