// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <optional>

#include <fmt/format.h>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/cli/report_file.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/report/pages/read_report.hpp"
#include "treadmark/app/report/pages/simulation_page.hpp"
#include "treadmark/app/simulation/file_lock.hpp"
#include "treadmark/app/simulation/simulation_outputs.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::cli {
namespace {

int exit_status(const io::SimulationResult& result) { return result.status == "complete" ? kOk : kFailed; }

/// Whether a finished result lies there. Errors: Error(configuration) where it belongs to another simulation.
bool is_finished(const std::filesystem::path& store, const io::SimulationFile& file,
                 const std::vector<std::string>& settings) {
  if (!std::filesystem::exists(store)) return false;
  app::require_same_simulation(store, io::read_checkpoint(store), file, settings);
  return io::read_simulation_head(store).status == "complete";
}

/// Nobody else writes into the folder as long as this lives.
app::FileLock claim(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ErrorKind::configuration, "cannot create the output folder: " + failure.message(), {folder.string()});
  auto lock = app::FileLock::attempt(folder / "lock");
  if (!lock)
    throw Error(ErrorKind::configuration, "another simulation is writing into " + folder.string(), {},
                "choose another folder");
  io::remove_leftovers(folder);
  return std::move(*lock);
}

/// JSON to standard output in place of the text, or into a file beside it.
void print(const std::string& json_file, const std::string& json, const std::string& text) {
  const bool instead = json_file == "-";
  std::cout << (instead ? json : text);
  std::cout.flush();
  if (!instead && !json_file.empty()) io::write_text_file(json_file, json);
  if (!std::cout) throw Error(ErrorKind::numerical, "the results could not be written to standard output");
}

}  // namespace

int simulate_command(const SimulateOptions& options, const CommonOptions& common) {
  if (options.resume && options.output_folder.empty())
    throw Error(ErrorKind::configuration, "--resume needs the folder of the interrupted simulation", {},
                "give it with -o FOLDER");
  if (io::is_study_file(options.file))
    throw Error(ErrorKind::configuration, options.file + " is a study of several simulations", {},
                "use treadmark sweep");
  std::vector<std::string> overrides = options.overrides;
  if (!options.wheel_backend.empty()) overrides.push_back("wheel.backend=" + options.wheel_backend);
  if (!options.rail_backend.empty()) overrides.push_back("rail.backend=" + options.rail_backend);
  const ThreadLimit limit(common.threads);
  const io::SimulationFile file = io::read_simulation_file(options.file, overrides);
  if (!common.quiet)
    for (const std::string& note : file.notes) std::cerr << "note: " << note << '\n';

  app::SurfaceStore store;
  app::SimulationOptions run;
  run.settings = overrides;
  if (options.modes_only) {
    const io::SimulationResult result = app::static_results(file, store, run);
    print(options.json_file, app::to_json(result, {}), app::statics_text(result) + '\n' + app::modes_text(result));
    return kOk;
  }

  const std::filesystem::path folder = options.output_folder;
  std::optional<app::FileLock> lock;
  if (!folder.empty()) {
    lock.emplace(claim(folder));
    run.checkpoint_file = folder / "unfinished.h5";
    run.table_file = folder / "history.csv";
    run.resume = options.resume;
    if (options.resume && is_finished(folder / "simulation.h5", file, overrides)) {
      std::cerr << "the simulation in " << folder.string() << " is complete already\n";
      write_report_file(options.report_file, [&] { return app::report::read_report(folder); });
      return kOk;
    }
    if (!options.resume) {
      std::error_code failure;
      std::filesystem::remove(folder / "simulation.h5", failure);
      std::filesystem::remove(run.checkpoint_file, failure);
    }
  }

  catch_interrupt();
  app::SimulationTimes times;
  io::SimulationResult result;
  {
    ProgressLine line(common.quiet);
    Progress progress;
    progress.stop = &interrupted();
    progress.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
      line.update(finished, total, what);
    };
    result = app::run_simulation(file, store, run, progress, &times);
  }
  if (!folder.empty()) {
    app::write_simulation_folder(folder, result);
    std::error_code ignored;
    if (result.status == "complete") std::filesystem::remove(run.checkpoint_file, ignored);
  }
  write_report_file(options.report_file,
                    [&] { return app::report::simulation_page(std::make_shared<io::SimulationResult>(result), {}); });
  print(options.json_file, app::to_json(result, times), app::summary_text(result) + app::times_text(times));
  if (result.status == "interrupted")
    std::cerr << result.message << (folder.empty() ? "" : "; --resume goes on from there") << '\n';
  if (result.status == "failed") std::cerr << "treadmark: " << result.message << '\n';
  return exit_status(result);
}

}  // namespace treadmark::cli
