// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/run_simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/assessment/assess_result.hpp"
#include "treadmark/app/simulation/history_record.hpp"
#include "treadmark/app/simulation/result_head.hpp"
#include "treadmark/app/simulation/simulation_outputs.hpp"
#include "treadmark/app/simulation/snapshots.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/stopwatch.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/solvers/vehicle/stability/eigenmodes.hpp"

namespace treadmark::app {

std::string energy_doubt(const vehicle::EnergyBalance& now, const vehicle::EnergyBalance& start) {
  constexpr double kDoubtful = 0.02;
  const double off = std::max(std::abs(now.contact_error(start)), std::abs(now.integration_error(start)));
  if (!(off > kDoubtful * now.turnover)) return {};
  return fmt::format(
      "energies do not balance: {:.2g} of the turnover is missing (energy.contact_error_J, "
      "energy.integration_error_J), so forces are doubtful; try shorter steps or smaller elements",
      off / now.turnover);
}

std::vector<std::string> simulation_doubts(const io::SimulationFile& file) {
  std::vector<std::string> out;
  const io::WheelRailCase& contact = file.contact;
  const auto take = [&](std::vector<std::string> doubts) {
    for (std::string& doubt : doubts)
      if (ranges::find(out, doubt) == out.end()) out.push_back(std::move(doubt));
  };
  std::set<double> radii;
  for (const io::WheelContactInput& wheel : file.wheels) radii.insert(file.wheel_radius(wheel.wheelset));
  const auto look_at_wheel = [&](const io::SurfaceSource& source) {
    // What a profile states of its wheel must hold for one of those that have it.
    std::optional<std::vector<std::string>> least;
    for (const double radius : radii) {
      std::vector<std::string> doubts =
          source_doubts(source, Body::wheel, {contact.wheelset.flange_back_position, radius, true});
      if (!least || doubts.size() < least->size()) least = std::move(doubts);
    }
    if (least) take(*std::move(least));
  };
  const auto look_at_rail = [&](Side side) {
    take(source_doubts(file.rail(side), Body::rail, {{}, {}, contact.track.gauge_based, contact.track.cant}));
  };
  look_at_wheel(contact.wheel);
  if (file.other_wheel) look_at_wheel(*file.other_wheel);
  look_at_rail(Side::left);
  look_at_rail(Side::right);
  return out;
}

namespace {

using Clock = std::chrono::steady_clock;

/// A simulation with everything that is written down of it.
class Run {
 public:
  Run(const io::SimulationFile& file, SurfaceStore& store, const SimulationOptions& options, const Progress& progress,
      SimulationTimes& times)
      : file_(file),
        options_(options),
        times_(times),
        result_(result_head(file, options)),
        kept_(find_kept()),
        built_(build(file, store, options.tables, progress, times)),
        snapshots_(file, built_) {
    equilibrium_ = balance();
    describe_statics();
    {
      const Stopwatch watch(times_.modes_s);
      for (const vehicle::Eigenmode& mode : vehicle::eigenmodes(built_.vehicle, equilibrium_.state))
        result_.modes.push_back({mode.frequency, mode.damping_ratio, vehicle::describe(mode, built_.vehicle.system)});
    }
    say_if_unstable();
    for (const std::string& doubt : simulation_doubts(file))
      result_.message += (result_.message.empty() ? "" : "; ") + doubt;
    if (options_.doubt && !result_.message.empty()) options_.doubt(result_.message);
  }

  io::SimulationResult take() { return std::move(result_); }

  void integrate(const Progress& progress) {
    const wheelrail::PhaseTimes before = contact_times();
    {
      const Stopwatch watch(times_.integration_s);
      begin();
      try {
        loop(progress);
      } catch (const Error& e) {
        if (e.kind() != ErrorKind::numerical) throw;
        result_.status = "failed";
        result_.message = e.what();
      }
    }
    const wheelrail::PhaseTimes after = contact_times();
    times_.shared = thread_count() > 1 && ranges::count(built_.full, nullptr) + 2 <= std::ssize(built_.full);
    times_.contact = {after.search_s - before.search_s,           after.distance_s - before.distance_s,
                      after.normal_s - before.normal_s,           after.tangential_s - before.tangential_s,
                      after.searches - before.searches,           after.distances - before.distances,
                      after.normal_solves - before.normal_solves, after.tangential_solves - before.tangential_solves};
    if (!simulation_->derailed().empty()) {
      result_.status = "derailed";
      result_.message = simulation_->derailed();
    }
    finish();
    if (!result_.ended()) keep_checkpoint();
  }

 private:
  static BuiltVehicle build(const io::SimulationFile& file, SurfaceStore& store, ContactTables* tables,
                            const Progress& progress, SimulationTimes& times) {
    const Stopwatch watch(times.build_s);
    BuiltVehicle built = build_vehicle(file, store, tables, progress);
    times.tables_s = built.table_seconds;
    return built;
  }

  vehicle::Equilibrium balance() {
    const Stopwatch watch(times_.equilibrium_s);
    vehicle::Equilibrium e = vehicle::find_equilibrium(built_.vehicle, {}, built_.easy ? &*built_.easy : nullptr);
    if (e.report.status != Status::ok) throw Error(ErrorKind::numerical, e.report.message, {}, no_balance_advice());
    result_.message = e.report.message;
    return e;
  }

  const char* no_balance_advice() const {
    if (!file_.train.empty())
      return "let a train start on a straight at constant speed and gradient, with torques and forces that grow from "
             "0: where couplers have free play each vehicle must be in balance by itself";
    return built_.vehicle.line && built_.vehicle.line->setup().path
               ? "let the vehicle start on a straight in front of the curve (layout.start_m)"
               : vehicle::kNoEquilibriumAdvice;
  }

  void say_if_unstable() {
    // Forces of full contacts jump with their elements: their slopes tell less.
    const bool any_full =
        ranges::any_of(file_.wheels, [](const auto& w) { return w.model == io::ContactModelInput::full; });
    const double growing = any_full ? -0.01 : -1e-3;
    constexpr double kSlowest = 0.1;  // [Hz]
    const auto least = ranges::min_element(result_.modes, {}, &io::ModeRow::damping_ratio);
    if (least == result_.modes.end() || !(least->damping_ratio < growing) || !(least->frequency_Hz > kSlowest)) return;
    if (!result_.message.empty()) result_.message += "; ";
    result_.message += fmt::format(
        "the linearised vehicle is unstable at {:.6g} m/s: {:.3g} Hz, damping {:.2g} of critical, {} (treadmark "
        "stability)",
        file_.settings.speed, least->frequency_Hz, least->damping_ratio, least->shape);
  }

  void describe_statics() {
    const auto add = [&](std::string name, double value, const char* unit, const char* description) {
      result_.statics.push_back({std::move(name), value, unit, description});
    };
    for (std::size_t i = 0; i < built_.vehicle.wheels.size(); ++i) {
      const std::string& wheel = built_.vehicle.wheels[i].name;
      const vehicle::ContactReaction& r = equilibrium_.reactions[i];
      const vehicle::PairMotion m = built_.vehicle.motion(i, equilibrium_.state);
      add(wheel + ".Q_N", r.on_rail.force.z(), "N", "vertical force on the rail");
      add(wheel + ".Y_N", r.on_rail.force.y(), "N", "lateral force on the rail");
      add(wheel + ".Ty_N", r.lateral_creep_force, "N", "lateral creep force on the rail");
      add(wheel + ".y_cp_m", r.contact_y, "m", "contact in track axes");
      add(wheel + ".rail_z_m", m.rail.z + r.bending.z, "m", "vertical displacement of the rail");
    }
    for (std::size_t set = 0; set < built_.vehicle.system.wheelsets.size(); ++set)
      add(fmt::format("wheelset{}.load_N", set + 1), built_.vehicle.system.wheelset_load[set], "N",
          "weight that the two wheels carry");
    add("residual", equilibrium_.residual, "1", "largest force out of balance over a wheelset's load");
    if (const auto& line = built_.vehicle.line; line && line->setup().path) {
      add(kCantBaseName, line->setup().base, "m", "over which cant is an angle");
      add(kGravityName, line->setup().gravity, "m/s2", "acceleration of gravity");
    }
  }

  wheelrail::PhaseTimes contact_times() const {
    wheelrail::PhaseTimes sum;
    for (const auto& full : built_.full)
      if (full) sum += full->times();
    return sum;
  }

  void begin() {
    for (const auto& chosen : built_.chosen) chosen->begin();
    simulation_.emplace(built_.vehicle, equilibrium_.state, integration_settings(file_));
    record_.emplace(file_, *simulation_);
    summary_.emplace(file_, *simulation_);
    result_.columns = record_->columns();
    if (kept_) return restore();
    record_->append(result_.values);
    summary_->note();
    snapshots_.take_start();
  }

  void loop(const Progress& progress) {
    constexpr double kPerMetre = 1e4;
    const auto total = to_whole<std::size_t>(kPerMetre * file_.settings.distance);
    auto last_kept = Clock::now(), last_told = last_kept - std::chrono::hours(1);
    // Histories grow, and with them what a checkpoint costs: together no more than a twentieth of the time.
    constexpr double kLeastApart = 20.0;  // times as long as the last one took
    double apart = file_.settings.checkpoint;
    while (!simulation_->finished()) {
      if (progress.stop_requested()) return stop();
      const vehicle::SystemState before = simulation_->state();
      try {
        // The rest of the loop notes the step: all of it or nothing.
        const CancellationScope scope(progress.stop);
        simulation_->advance();
      } catch (const Cancelled&) {
        return stop();
      }
      if (!simulation_->derailed().empty()) {
        if (last_written(0) < simulation_->state().time) record_->append(result_.values);
        return;
      }
      summary_->note();
      snapshots_.take_passed(*simulation_, before);
      if (due(built_.vehicle.travel(simulation_->state().time).distance)) record_->append(result_.values);
      const auto now = Clock::now();
      if (progress.report && now - last_told > std::chrono::milliseconds(100)) {
        last_told = now;
        const double x = built_.vehicle.travel(simulation_->state().time).distance;
        progress.report(std::min(total, to_whole<std::size_t>(kPerMetre * x)), total, fmt::format("x = {:.3f} m", x));
      }
      if (!options_.checkpoint_file.empty() && std::chrono::duration<double>(now - last_kept).count() > apart) {
        keep_checkpoint();
        last_kept = Clock::now();
        const double took = std::chrono::duration<double>(last_kept - now).count();
        apart = std::max(file_.settings.checkpoint, kLeastApart * took);
      }
    }
  }

  void stop() {
    result_.status = "interrupted";
    result_.message = fmt::format("stopped at t = {:.6g} s", simulation_->state().time);
  }

  /// Of the last instant that was written down: 0: when, 1: where.
  double last_written(std::size_t column) const {
    return result_.values[result_.values.size() - result_.columns.size() + column];
  }

  /// Whether the instant at x is to be written down.
  bool due(double x) {
    const double every = file_.settings.output_every;
    if (every <= 0.0 || simulation_->finished()) return true;
    return std::floor(x / every) > std::floor(last_written(1) / every);
  }

  void finish() {
    if (result_.status == "complete") {
      for (const std::string& doubt :
           {energy_doubt(simulation_->energy(), simulation_->energy_at_start()), speed_doubt()})
        if (!doubt.empty()) result_.message += (result_.message.empty() ? "" : "; ") + doubt;
    }
    result_.events.clear();
    for (const vehicle::ContactEvent& e : simulation_->events())
      result_.events.push_back({e.time, built_.vehicle.travel(e.time).distance, built_.vehicle.wheels[e.wheel].name,
                                e.regained ? "contact regained" : "contact lost"});
    for (const ContactChange& c : summary_->changes())
      result_.events.push_back({c.time, built_.vehicle.travel(c.time).distance, built_.vehicle.wheels[c.wheel].name,
                                c.full ? "full contact from here" : "table from here"});
    ranges::stable_sort(result_.events, {}, &io::HistoryEvent::time);
    result_.summary = summary_->values();
    snapshots_.put_results(result_);
    result_.snapshots.version = result_.version;
    result_.snapshots.git = result_.git;
  }

  /// Frames travel at the speed of the file, or of a point mass: what curves and hunting take comes on top where
  /// nothing holds the vehicles to them.
  std::string speed_doubt() const {
    const OtherSpeed& most = summary_->other_speed();
    if (!(most.wanted > 0.0)) return {};
    return fmt::format(
        "the vehicles do not keep their speed: at x = {:.4g} m they run at {:.4g} m/s, not at the {:.4g} m/s that {}: "
        "what wheels take makes the difference, and places on the line are off by it",
        most.place, most.mean, most.wanted,
        file_.free_run ? "torques, gradients and resistance give"
                       : "the file wants, as nothing holds them along the track (simulation.free_run drives them)");
  }

  void keep_checkpoint() {
    if (options_.checkpoint_file.empty()) return;
    ByteWriter out;
    simulation_->save(out);
    out.put(result_.values);
    summary_->save(out);
    snapshots_.save(out);
    io::SimulationResult partial = result_;
    if (partial.status == "complete") partial.status = "interrupted";
    partial.snapshots = {};
    partial.snapshot_times.clear();
    partial.snapshot_scenes.clear();
    partial.checkpoint = out.bytes();
    const auto lock = lock_stores();
    io::write_simulation(options_.checkpoint_file, partial);
    if (!options_.table_file.empty()) io::write_history_csv(options_.table_file, wheel_columns(partial));
  }

  std::unique_lock<std::mutex> lock_stores() const {
    return options_.store_mutex ? std::unique_lock(*options_.store_mutex) : std::unique_lock<std::mutex>();
  }

  std::optional<io::SimulationCheckpoint> find_kept() const {
    if (options_.checkpoint_file.empty() || !std::filesystem::exists(options_.checkpoint_file)) return {};
    const auto lock = lock_stores();
    io::SimulationCheckpoint kept = io::read_checkpoint(options_.checkpoint_file);
    require_same_simulation(options_.checkpoint_file, kept, file_, options_.settings);
    return kept;
  }

  void restore() {
    ByteReader in(kept_->bytes);
    simulation_->restore(in);
    in.get(result_.values);
    summary_->restore(in);
    snapshots_.restore(in);
    kept_.reset();
  }

  const io::SimulationFile& file_;
  const SimulationOptions& options_;
  SimulationTimes& times_;
  io::SimulationResult result_;
  std::optional<io::SimulationCheckpoint> kept_;
  BuiltVehicle built_;
  vehicle::Equilibrium equilibrium_;
  std::optional<vehicle::Simulation> simulation_;
  std::optional<HistoryRecord> record_;
  std::optional<HistorySummary> summary_;
  Snapshots snapshots_;
};

}  // namespace

io::SimulationResult run_simulation(const io::SimulationFile& file, SurfaceStore& store,
                                    const SimulationOptions& options, const Progress& progress,
                                    SimulationTimes* times) {
  SimulationTimes unasked;
  std::optional<Run> run;
  {
    const CancellationScope scope(progress.stop);
    run.emplace(file, store, options, progress, times ? *times : unasked);
  }
  run->integrate(progress);
  return run->take();
}

io::SimulationResult static_results(const io::SimulationFile& file, SurfaceStore& store,
                                    const SimulationOptions& options) {
  SimulationTimes unasked;
  return Run(file, store, options, {}, unasked).take();
}

void require_same_simulation(const std::filesystem::path& store, const io::SimulationCheckpoint& kept,
                             const io::SimulationFile& file, const std::vector<std::string>& settings) {
  if (kept.version == version() && kept.git == git_revision() && kept.input_sha256 == file.sha256 &&
      kept.settings == settings && kept.geometry_sha256 == input_hashes(file))
    return;
  throw Error(ErrorKind::configuration, fmt::format("{} belongs to another simulation", store.string()), {},
              "go on with the same files, settings and build of Treadmark, choose another folder, or discard it with "
              "--anew");
}

bool goes_on(const std::filesystem::path& checkpoint, bool also_failed) {
  return std::filesystem::exists(checkpoint) &&
         (also_failed || io::read_simulation_head(checkpoint).status == "interrupted");
}

bool is_finished(const std::filesystem::path& store, const io::SimulationFile& file,
                 const std::vector<std::string>& settings) {
  if (!std::filesystem::exists(store)) return false;
  require_same_simulation(store, io::read_checkpoint(store), file, settings);
  return io::read_simulation_head(store).ended();
}

}  // namespace treadmark::app
