// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/output_files.hpp"
#include "treadmark/app/stability/stability_run.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct StabilityOptions {
  app::StabilityRequest request;
  std::string file, json_file, folder;  ///< empty = none; JSON "-" = stdout
};

int stability_command(const StabilityOptions& options, const CommonOptions& common) {
  require_different({options.file}, {options.json_file});
  catch_interrupt();
  const CancellationScope scope(&interrupted());
  const ThreadLimit limit(common.threads);
  app::StabilityRequest request = options.request;
  request.file = options.file;
  request.cache = io::ContentCache::from_environment();
  const app::StabilityRun run = app::run_stability(request);
  print_notes(run.notes, common.quiet);
  const auto json = [&] { return app::stability_json(run); };
  write_json_file(options.json_file, json);
  if (!options.folder.empty()) app::write_stability_folder(options.folder, run);
  print_results(options.json_file, json, [&] { return app::stability_table(run); });
  if (run.result.verdict != vehicle::StabilityVerdict::unknown) return kOk;
  std::cerr << "treadmark: " << app::stability_verdict(run) << '\n';
  return kNotConverged;
}

}  // namespace

Command add_stability(CLI::App& verb) {
  auto options = std::make_shared<StabilityOptions>();
  app::StabilityRequest& request = options->request;
  verb.add_option("FILE", options->file, "Simulation file (.toml)")->required();
  const auto add_speed = [&](const char* name, double& value, const char* text) {
    verb.add_option(name, value, text)->check(CLI::Range(1e-3, 1e3))->capture_default_str()->type_name("M/S");
  };
  add_speed("--from", request.from, "Lowest speed [m/s]");
  add_speed("--to", request.to, "Highest speed [m/s]");
  verb.add_option("--count", request.count, "Speeds, evenly spaced")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  add_speed("--tolerance", request.tolerance, "How exactly the critical speed is found [m/s]");
  verb.add_option("--shown-hz", request.shown, "Highest frequency in the picture [Hz]")
      ->check(CLI::Range(1e-3, 1e5))
      ->capture_default_str()
      ->type_name("HZ");
  verb.add_option("--json", options->json_file, "Write the numbers here; - for standard output instead of the text")
      ->type_name("FILE");
  verb.add_option("-o,--output", options->folder, "Folder for stability.json, eigenvalues.csv and stability.svg")
      ->type_name("FOLDER");
  add_overrides(verb, request.overrides, "simulation.vehicle=mine.toml");
  return command(options, stability_command);
}

}  // namespace treadmark::cli
