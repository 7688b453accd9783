// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/stability/falling_run.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/simulation/file_lock.hpp"
#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/app/simulation/simulation_outputs.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/model/vehicle/running_limits.hpp"

namespace treadmark::app {
namespace {

constexpr double kWaveBegins = 20.0;  // of the foremost wheelset's way [m]

/// One wave of both rails to the right and back, and nothing behind it.
IrregularitySpec lateral_wave(double from, double height, double length) {
  constexpr int kPoints = 40;
  IrregularitySpec spec;
  spec.table.emplace();
  const auto add = [&](double place, double value) {
    spec.table->distance.push_back(place);
    spec.table->values[static_cast<std::size_t>(Irregularity::alignment)].push_back(value);
  };
  add(from - length, 0.0);
  for (int i = 0; i <= kPoints; ++i) {
    const double share = static_cast<double>(i) / kPoints;
    add(from + share * length, i < kPoints ? 0.5 * height * (1.0 - std::cos(2.0 * kPi * share)) : 0.0);
  }
  add(from + 2.0 * length, 0.0);
  spec.begin = from - length;
  spec.wind_up = 0.0;
  return spec;
}

io::SimulationFile file_of(io::SimulationFile file, const FallingRequest& request, const vehicle::FallSettings& fall) {
  constexpr double kBetweenInstants = 0.2;  // written down [m]
  io::SimulationSettings& s = file.settings;
  s.profile = vehicle::profile_of(fall);
  s.speed = fall.from;
  s.duration = s.profile.time.back();
  s.distance = travel_at(s.profile, s.duration).distance;
  s.output_every = kBetweenInstants;
  file.start = 0.0;
  const double front = io::wheelset_places(file.vehicle).to;
  file.irregularities = lateral_wave(front + kWaveBegins, request.wave_height, request.wave_length);
  file.irregularity_file.reset();
  file.torques.clear();
  file.free_run.reset();
  file.forces.clear();
  file.spring_motions.clear();
  file.rail_shifts.clear();
  file.assessment.reset();
  file.fields = {};
  file.history = {};
  file.history.channels = {"line.speed_m_s", "ws*.sumY_N"};
  for (const WheelsetSpec& wheelset : file.vehicle.wheelsets) file.history.channels.push_back(wheelset.body + ".y_m");
  return file;
}

vehicle::SwayHistory history_of(const io::SimulationResult& result, const std::vector<std::string>& columns) {
  vehicle::SwayHistory history;
  const auto column = [&](const std::string& name) {
    return io::column_values(result, io::column_index(result, name));
  };
  history.distance = column("x_m");
  history.speed = column("line.speed_m_s");
  for (const std::string& name : columns) history.sway.push_back(column(name));
  return history;
}

/// Sums of guiding forces over their limit of instability, half of what EN 14363 allows a wheelset, in its simplified
/// way to measure stability.
vehicle::SwayHistory forces_of(const io::SimulationResult& result, std::size_t wheelsets) {
  std::vector<std::string> columns;
  for (std::size_t i = 1; i <= wheelsets; ++i) columns.push_back(fmt::format("ws{}.sumY_N", i));
  vehicle::SwayHistory history = history_of(result, columns);
  for (std::size_t i = 0; i < wheelsets; ++i) {
    const std::string load = fmt::format("wheelset{}.load_N", i + 1);
    const auto found = ranges::find(result.statics, load, &io::NamedValue::name);
    LimitInput input;
    input.load = found->value;
    const double allowed = limit_of(usual_limits(), "sumY_rms", input);
    for (double& value : history.sway[i]) value /= allowed;
  }
  return history;
}

class Falls {
 public:
  Falls(const io::SimulationFile& file, const std::vector<std::string>& settings, SurfaceStore& store,
        ContactTables& tables, const Progress& progress)
      : file_(file), settings_(settings), store_(store), tables_(tables), progress_(progress) {}

  Fall run(const FallingRequest& request, const vehicle::FallSettings& settings, const std::string& name) const {
    const io::SimulationFile file = file_of(file_, request, settings);
    const io::SimulationResult result = simulate(file, request, settings, name);
    Fall fall;
    fall.settings = settings;
    fall.status = result.status;
    fall.message = result.message;
    if (result.status != "complete") return fall;
    std::vector<std::string> places;
    for (const WheelsetSpec& wheelset : file.vehicle.wheelsets) places.push_back(wheelset.body + ".y_m");
    fall.result = vehicle::judge_fall(history_of(result, places), settings);
    fall.forces = vehicle::running_sway(forces_of(result, places.size()), settings.window);
    return fall;
  }

 private:
  io::SimulationResult simulate(const io::SimulationFile& file, const FallingRequest& request,
                                const vehicle::FallSettings& fall, const std::string& name) const {
    SimulationOptions options;
    options.tables = &tables_;
    options.settings = settings_;
    options.settings.push_back(
        fmt::format("falling from {} m/s, held for {} m, {} m/s2 to {} m/s, wave of {} m, {} m long", fall.from,
                    fall.hold, fall.deceleration, fall.to, request.wave_height, request.wave_length));
    if (request.folder.empty()) return run_simulation(file, store_, options, progress_);
    const std::filesystem::path folder = request.folder / name, store = folder / "simulation.h5";
    const FileLock lock = claim_folder(folder);
    options.checkpoint_file = folder / "unfinished.h5";
    options.table_file = folder / "history.csv";
    if (request.anew) remove_file(store);
    if (is_finished(store, file, options.settings)) return io::read_simulation(store);
    if (request.anew || !goes_on(options.checkpoint_file)) remove_file(options.checkpoint_file);
    remove_file(store);
    io::SimulationResult result = run_simulation(file, store_, options, progress_);
    write_simulation_folder(folder, result);
    if (result.ended()) remove_file(options.checkpoint_file);
    return result;
  }

  const io::SimulationFile& file_;
  const std::vector<std::string>& settings_;
  SurfaceStore& store_;
  ContactTables& tables_;
  const Progress& progress_;
};

}  // namespace

FallingRun run_falling(const io::SimulationFile& file, const std::vector<std::string>& settings,
                       const FallingRequest& request, SurfaceStore& store, ContactTables& tables,
                       const Progress& progress) {
  constexpr double kSlower = 4.0;  // that slowest_fall takes
  constexpr double kAround = 0.1;  // of the speed at which it died before
  FallingRun run;
  run.request = request;
  const Falls falls(file, settings, store, tables, progress);
  vehicle::FallSettings fast{request.from,         request.to,     request.hold,
                             request.deceleration, request.window, request.amplitude};
  run.falls.push_back(falls.run(request, fast, "fall"));
  const Fall& first = run.falls.front();
  if (first.status != "complete") return run;
  if (first.result.verdict == vehicle::FallVerdict::died) {
    const double died = first.result.speed;
    vehicle::FallSettings slow = fast;
    slow.deceleration /= kSlower;
    slow.to = std::max(request.to, (1.0 - kAround) * died);
    run.falls.push_back(falls.run(request, slow, "slow-fall"));
    if (run.status() != "complete") return run;
    const vehicle::FallResult& second = run.falls.back().result;
    if (second.verdict == vehicle::FallVerdict::died)
      run.critical = vehicle::slowest_fall(run.falls.front().result.speed, second.speed);
  }
  if (run.falls.back().result.verdict != vehicle::FallVerdict::none)
    run.forces_fall = vehicle::last_above(run.falls.back().forces, 1.0);
  return run;
}

std::string falling_word(const FallingRun& run) {
  if (run.status() != "complete") return run.status();
  switch (run.falls.back().result.verdict) {
    case vehicle::FallVerdict::died:
      return "died";
    case vehicle::FallVerdict::lasting:
      return "lasting";
    case vehicle::FallVerdict::none:
      break;
  }
  return "none";
}

std::string falling_verdict(const FallingRun& run) {
  const Fall& last = run.falls.back();
  if (last.status != "complete") return fmt::format("falling speed: {}: {}", last.status, last.message);
  const vehicle::FallSettings& s = last.settings;
  const vehicle::FallResult& r = last.result;
  if (r.verdict == vehicle::FallVerdict::none)
    return fmt::format(
        "falling speed: no limit cycle at {:g} m/s: behind the disturbance hunting dies away, to {:.3g} mm after {:g} "
        "m; begin at a higher speed, or hold it for longer",
        s.from, kMilli * r.first_amplitude, s.hold);
  std::string text =
      run.critical ? fmt::format(
                         "falling speed: the limit cycle dies at {:.5g} m/s ({:.4g} km/h) when the speed falls by {:g} "
                         "m/s2, at {:.5g} m/s by {:g} m/s2: at {:.5g} to {:.5g} m/s when it falls endlessly slowly",
                         r.speed, 3.6 * r.speed, s.deceleration, run.falls.front().result.speed,
                         run.falls.front().settings.deceleration, run.critical->low, run.critical->high)
                   : fmt::format("falling speed: the limit cycle still lasts at {:g} m/s", s.to);
  if (const auto& forces = run.forces_fall) {
    if (forces->never_above)
      text += "; guiding forces never reach half of their limit";
    else if (!forces->at_end)
      text += fmt::format("; guiding forces fall below half of their limit at {:.5g} m/s", forces->speed);
  }
  return text;
}

std::string falling_csv(const FallingRun& run) {
  std::string text = "deceleration_m_s2,distance_m,speed_m_s,amplitude_m,guiding_forces_share\n";
  for (const Fall& fall : run.falls)
    for (std::size_t i = 0; i < fall.result.sway.size(); ++i) {
      const vehicle::SwayAt& at = fall.result.sway[i];
      text += fmt::format("{},{},{},{},{}\n", io::csv_number(fall.settings.deceleration), io::csv_number(at.distance),
                          io::csv_number(at.speed), io::csv_number(std::sqrt(2.0) * at.rms),
                          io::csv_number(fall.forces[i].rms));
    }
  return text;
}

}  // namespace treadmark::app
