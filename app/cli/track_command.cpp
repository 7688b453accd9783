// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/pages/plain_page.hpp"
#include "treadmark/app/track/track_run.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/output_file.hpp"

namespace treadmark::cli {
namespace {

struct TrackOptions {
  std::string file;
  std::string csv_file, json_file, folder, report_file;  ///< empty = none; "-": standard output instead of the table
  int layers = 0;
  double from = 10.0, to = 1500.0;
  int count = 200;
  double aside_mm = 0.0;
  std::vector<std::string> overrides;
};

int track_command(const TrackOptions& options, const CommonOptions&) {
  catch_interrupt();
  const CancellationScope scope(&interrupted());
  app::TrackRequest request;
  request.file = options.file;
  request.overrides = options.overrides;
  request.from = options.from;
  request.to = options.to;
  request.count = options.count;
  request.layers = options.layers;
  request.aside = 1e-3 * options.aside_mm;
  const app::TrackResult result = app::run_track(request);
  const auto json = [&] { return app::track_json(result); };
  write_json_file(options.json_file, json);
  if (options.csv_file == "-")
    std::cout << app::track_csv(result);
  else if (!options.csv_file.empty())
    write_file(options.csv_file, app::track_csv(result));
  if (!options.folder.empty()) app::write_track_folder(options.folder, result);
  write_report_file(options.report_file, [&] {
    return app::pages::plain_page("track", "how a track gives way", json(),
                                  {{"receptance", "Receptance", report::PictureView{app::track_svg(result)}}});
  });
  if (options.csv_file != "-") print_results(options.json_file, json, [&] { return app::track_table(result); });
  if (!result.fitted || result.fitted->fit.report.status == Status::ok) return kOk;
  std::cerr << "treadmark: " << result.fitted->fit.report.message << '\n';
  return kNotConverged;
}

}  // namespace

Command add_track(CLI::App& verb) {
  auto options = std::make_shared<TrackOptions>();
  verb.add_option("FILE", options->file, "Track file (.toml), flexible or lumped")->required();
  add_output(verb, "--receptance", options->csv_file,
             "Write magnitude and phase over the frequency here (CSV); - for standard output instead of the text",
             "FILE");
  verb.add_option("--fit", options->layers, "Fit a lumped track of so many masses at each rail to the receptance")
      ->check(CLI::Range(1, vehicle::kMostLumpedLayers))
      ->type_name("LAYERS");
  verb.add_option("--from", options->from, "Lowest frequency [Hz]")
      ->check(CLI::Range(1e-3, 1e5))
      ->capture_default_str()
      ->type_name("HZ");
  verb.add_option("--to", options->to, "Highest frequency [Hz]")
      ->check(CLI::Range(1e-3, 1e5))
      ->capture_default_str()
      ->type_name("HZ");
  verb.add_option("--count", options->count, "Frequencies, evenly spaced in the logarithm")
      ->check(CLI::Range(10, 10000))
      ->capture_default_str();
  verb.add_option("--aside", options->aside_mm,
                  "Place of the force beside the middle of a head that rolls: couples vertical and lateral motion [mm]")
      ->check(CLI::Range(-100.0, 100.0))
      ->capture_default_str()
      ->type_name("MM");
  add_output(verb, "--json", options->json_file, "Write all numbers here; - for standard output instead of the text",
             "FILE");
  add_output(verb, "-o,--output", options->folder,
             "Folder for track.json, receptance.csv, track.svg and the fitted track, fitted.toml", "FOLDER");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides, "scale_stiffness=2");
  return command(options, track_command);
}

}  // namespace treadmark::cli
