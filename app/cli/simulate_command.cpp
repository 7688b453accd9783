// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/simulation/file_lock.hpp"
#include "treadmark/app/simulation/pages/simulation_page.hpp"
#include "treadmark/app/simulation/simulation_outputs.hpp"
#include "treadmark/app/track/track_run.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/results/write_vtk.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::cli {
namespace {

struct SimulateOptions {
  std::string file;
  std::string output_folder, json_file;              ///< empty = none; JSON "-" = stdout
  std::string backend, wheel_backend, rail_backend;  ///< backend: of both, where they are empty
  bool resume = false, anew = false;
  bool vtk = false;          ///< snapshots, wheel and rail for ParaView
  bool modes_only = false;   ///< print eigenfrequencies, do not integrate
  std::string track_folder;  ///< show how the track gives way, do not integrate; empty = none
  std::vector<std::string> overrides;
  std::string report_file;  ///< HTML; empty = none
};

double doubtful_steps(const io::SimulationResult& result) {
  const auto found = ranges::find(result.summary, "doubtful_steps", &io::NamedValue::name);
  return found == result.summary.end() ? 0.0 : found->value;
}

int exit_status(const io::SimulationResult& result) {
  return result.status == "complete" && doubtful_steps(result) == 0.0 ? kOk : kFailed;
}

void warn_of_derailment(const io::SimulationResult& result) {
  if (result.status == "derailed") std::cerr << "warning: derailed: " << result.message << '\n';
}

int show_track(const SimulateOptions& options, const io::SimulationFile& file,
               const std::vector<std::string>& overrides) {
  if (!file.track && !file.flexible_track)
    throw Error(ErrorKind::configuration, "the track of this simulation is rigid: it has no receptance", {},
                "give it one as simulation.track");
  app::TrackRequest request;
  request.file = options.file;
  request.overrides = overrides;
  catch_interrupt();
  const CancellationScope scope(&interrupted());
  const app::TrackResult result =
      app::run_track(request, file.flexible_track ? io::AnyTrack(*file.flexible_track) : io::AnyTrack(*file.track));
  app::write_track_folder(options.track_folder, result);
  const auto json = [&] { return app::track_json(result); };
  write_json_file(options.json_file, json);
  print_results(options.json_file, json, [&] { return app::track_table(result); });
  return kOk;
}

void print_summary(const std::string& json_file, const std::string& json, const std::string& text) {
  print_results(
      json_file, [&] { return json; }, [&] { return text; });
  write_json_file(json_file, [&] { return json; });
}

/// Contact, wheel and rail at the snapshots over their times [s].
void write_snapshots_vtk(const std::filesystem::path& folder, const io::SimulationResult& result) {
  if (result.snapshots.cases.empty()) {
    std::cerr << "note: --vtk shows the contact at snapshots, and this simulation keeps none (simulation.fields)\n";
    return;
  }
  io::write_vtk(folder, result.snapshots, "snapshots", result.snapshot_times);
  io::write_vtk_bodies(folder, result.snapshots, "bodies", result.snapshot_times);
}

int simulate_command(const SimulateOptions& options, const CommonOptions& common) {
  if (options.resume && options.output_folder.empty())
    throw Error(ErrorKind::configuration, "--resume needs the folder of the interrupted simulation", {},
                "give it with -o FOLDER");
  if (options.vtk && options.output_folder.empty())
    throw Error(ErrorKind::configuration, "--vtk needs a folder to write to", {}, "give it with -o FOLDER");
  if (!options.output_folder.empty()) require_part("hdf5", "folders of simulations");
  if (io::is_study_file(options.file))
    throw Error(ErrorKind::configuration, options.file + " is a study of several simulations", {},
                "use treadmark sweep");
  std::vector<std::string> overrides = options.overrides;
  const auto choose_backend = [&](const char* key, const std::string& own) {
    const std::string& name = own.empty() ? options.backend : own;
    if (!name.empty()) overrides.push_back(key + name);
  };
  choose_backend("wheel.backend=", options.wheel_backend);
  choose_backend("rail.backend=", options.rail_backend);
  const ThreadLimit limit(common.threads);
  const io::SimulationFile file = io::read_simulation_file(options.file, overrides);
  print_notes(file.notes, common.quiet);
  if (!options.track_folder.empty()) return show_track(options, file, overrides);

  app::SurfaceStore store;
  app::SimulationOptions run;
  app::ContactTables tables(io::ContentCache::from_environment());
  run.settings = overrides;
  run.tables = &tables;
  run.doubt = [](const std::string& message) { std::cerr << "warning: " << message << '\n'; };
  const int found = app::simulation_doubts(file).empty() ? kOk : kFailed;
  if (options.modes_only) {
    const io::SimulationResult result = app::static_results(file, store, run);
    print_summary(options.json_file, app::to_json(result, {}),
                  app::statics_text(result) + '\n' + app::modes_text(result));
    return found;
  }

  app::check_vehicle(file, store);  // what is refused leaves no folder behind
  const std::filesystem::path folder = options.output_folder;
  std::optional<app::FileLock> lock;
  if (!folder.empty()) {
    lock.emplace(app::claim_folder(folder));
    run.checkpoint_file = folder / "unfinished.h5";
    run.table_file = folder / "history.csv";
    if (options.resume && app::is_finished(folder / "simulation.h5", file, overrides)) {
      const io::SimulationResult there = io::read_simulation_head(folder / "simulation.h5");
      const bool derailed = there.status == "derailed";
      std::cerr << "the simulation in " << folder.string() << (derailed ? " has ended" : " is complete")
                << " already\n";
      warn_of_derailment(there);
      write_report_file(options.report_file, [&] { return app::pages::read_report(folder); });
      return derailed ? kFailed : kOk;
    }
    if (options.anew) remove_file(run.checkpoint_file);
    if (app::goes_on(run.checkpoint_file, options.resume)) {
      print_notes({"goes on with the interrupted simulation in " + folder.string() + "; --anew begins again"},
                  common.quiet);
    } else {
      remove_file(folder / "simulation.h5");  // where it stands, the other files are of its making
      remove_file(run.checkpoint_file);
      remove_file(folder / "assessment.json");
      for (const char* collection : {"snapshots.pvd", "bodies.pvd"}) remove_file(folder / "vtk" / collection);
    }
  }

  app::SimulationTimes times;
  const auto shared = std::make_shared<const io::SimulationResult>(with_progress(
      common.quiet, [&](const Progress& progress) { return app::run_simulation(file, store, run, progress, &times); }));
  const io::SimulationResult& result = *shared;
  const std::optional<app::AssessedRun> assessed = app::assess_own(shared, file.assessment);
  const app::AssessedRun* const own = assessed ? &*assessed : nullptr;
  if (!folder.empty()) {
    if (own) app::write_assessment_folder(folder, std::span(own, 1), {});
    app::write_simulation_folder(folder, result);
    if (options.vtk) write_snapshots_vtk(folder / "vtk", result);
    std::error_code ignored;
    if (result.ended()) std::filesystem::remove(run.checkpoint_file, ignored);
  }
  write_report_file(options.report_file, [&] { return app::pages::simulation_page(shared, {}, own); });
  print_summary(
      options.json_file, app::to_json(result, times, own),
      app::summary_text(result) + (own ? app::assessment_text(std::span(own, 1)) : "") + app::times_text(times));
  if (result.status == "interrupted")
    std::cerr << result.message << (folder.empty() ? "" : "; the same command goes on from there") << '\n';
  warn_of_derailment(result);
  if (result.status == "failed") std::cerr << "treadmark: " << result.message << '\n';
  if (const double steps = doubtful_steps(result); steps > 0.0)
    std::cerr << fmt::format(
        "warning: the contact is doubtful in {:.0f} steps (column doubts of the history); keep contact fields there to "
        "see why\n",
        steps);
  const int status = exit_status(result);
  return status == kOk ? found : status;
}

}  // namespace

Command add_simulate(CLI::App& verb) {
  auto options = std::make_shared<SimulateOptions>();
  verb.add_option("FILE", options->file, "Simulation file (.toml)")->required();
  add_output(verb, "-o,--output", options->output_folder,
             "Folder for simulation.h5, history.csv, events.csv, modes.csv and pictures (SVG)", "FOLDER");
  add_output(verb, "--json", options->json_file, "Write the summary here; - for standard output instead of the table",
             "FILE");
  verb.add_option("--backend", options->backend, "Surface backend for wheel and rail")->type_name(kBackendName);
  verb.add_option("--wheel-backend", options->wheel_backend, "Surface backend for the wheel")->type_name(kBackendName);
  verb.add_option("--rail-backend", options->rail_backend, "Surface backend for the rail")->type_name(kBackendName);
  CLI::Option* const resume =
      verb.add_flag("--resume", options->resume, "Leave a simulation alone that is complete in the output folder");
  verb.add_flag("--anew", options->anew, "Begin again, and discard an interrupted simulation in the output folder")
      ->excludes(resume);
  verb.add_flag("--vtk", options->vtk,
                "Write the contact at the snapshots, wheel and rail for ParaView too, over time: FOLDER/vtk");
  verb.add_flag("--modes", options->modes_only, "Print eigenfrequencies and modes in static equilibrium, and stop");
  add_output(verb, "--receptance", options->track_folder,
             "Write the track dynamics (track.json, receptance.csv, track.svg) into this folder, and stop", "FOLDER");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides, "simulation.speed_m_s=20");
  return command(options, simulate_command);
}

}  // namespace treadmark::cli
