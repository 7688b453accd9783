// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>
#include <string>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/pages/plain_page.hpp"
#include "treadmark/app/stability/stability_run.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::cli {
namespace {

struct StabilityOptions {
  app::StabilityRequest request;
  std::string file, json_file, folder, report_file;  ///< empty = none; JSON "-" = stdout
  app::FallingRequest falling;
  bool falls = false;
};

int stability_command(const StabilityOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  app::StabilityRequest request = options.request;
  request.file = options.file;
  request.cache = io::ContentCache::from_environment();
  if (options.falls) {
    request.falling = options.falling;
    if (!options.folder.empty()) require_part("hdf5", "histories of falling speeds");
    request.falling->folder = options.folder;
  }
  const app::StabilityRun run =
      with_progress(common.quiet, [&](const Progress& progress) { return app::run_stability(request, progress); });
  print_notes(run.notes, common.quiet);
  const auto json = [&] { return app::stability_json(run); };
  write_json_file(options.json_file, json);
  if (!options.folder.empty()) app::write_stability_folder(options.folder, run);
  write_report_file(options.report_file, [&] {
    return app::pages::plain_page("stability", "the stability of a vehicle", json(),
                                  {{"stability", "Eigenvalues", report::PictureView{app::stability_svg(run)}}});
  });
  print_results(options.json_file, json, [&] { return app::stability_table(run); });
  if (run.falling && run.falling->status() != "complete") {
    std::cerr << "treadmark: " << app::falling_verdict(*run.falling)
              << (options.folder.empty() ? "" : "; the same command goes on from there") << '\n';
    return kFailed;
  }
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
    CLI::Option* const in_m_s =
        verb.add_option(name, value, text)->check(CLI::Range(1e-3, 1e3))->capture_default_str()->type_name("M/S");
    verb.add_option_function<double>(
            std::string(name) + "-km-h", [&value](double speed) { value = speed / 3.6; }, "The same in km/h")
        ->check(CLI::Range(3.6e-3, 3.6e3))
        ->type_name("KM/H")
        ->excludes(in_m_s);
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
  add_output(verb, "--json", options->json_file, "Write the numbers here; - for standard output instead of the text",
             "FILE");
  add_output(verb, "-o,--output", options->folder,
             "Folder for stability.json, eigenvalues.csv and stability.svg, with --falling histories too", "FOLDER");
  app::FallingRequest& falling = options->falling;
  CLI::Option* const falls =
      verb.add_flag("--falling", options->falls,
                    "Also the nonlinear critical speed: a run in time with falling speed until hunting ends");
  const auto add_fall = [&](const char* name, double& value, const char* text, double highest, const char* unit) {
    verb.add_option(name, value, text)
        ->check(CLI::Range(1e-6, highest))
        ->capture_default_str()
        ->type_name(unit)
        ->needs(falls);
  };
  add_fall("--deceleration", falling.deceleration, "At which the speed falls; again at a quarter of it [m/s2]", 10.0,
           "M/S2");
  add_fall("--hold-m", falling.hold, "Distance at the highest speed, before it falls [m]", 1e6, "M");
  add_fall("--window-m", falling.window, "Distance over which the hunting amplitude is averaged [m]", 1e6, "M");
  add_fall("--amplitude-m", falling.amplitude, "Of a wheelset, below which it does not hunt [m]", 0.1, "M");
  add_fall("--wave-m", falling.wave_height, "Height of the track's wave to the side that disturbs the vehicle [m]", 0.1,
           "M");
  add_fall("--wave-length-m", falling.wave_length, "Its length [m]", 1e3, "M");
  verb.add_flag("--anew", falling.anew, "Begin --falling again, and discard what is in the output folder")
      ->needs(falls);
  add_report_file(verb, options->report_file);
  add_overrides(verb, request.overrides, "simulation.vehicle=mine.toml");
  return command(options, stability_command);
}

}  // namespace treadmark::cli
