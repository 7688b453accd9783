// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/pages/plain_page.hpp"
#include "treadmark/app/stability/response_run.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct ResponseOptions {
  app::ResponseRequest request;
  std::string file, json_file, folder, report_file;  ///< empty = none; JSON "-" = stdout
};

std::vector<report::Figure> pictures_of(const app::ResponseRun& run) {
  std::vector<report::Figure> out{{"response", "Transfer functions", report::PictureView{app::response_svg(run)}}};
  if (std::string modes = app::modes_svg(run); !modes.empty())
    out.push_back({"modes", "Vibrations", report::PictureView{std::move(modes)}});
  return out;
}

int response_command(const ResponseOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  app::ResponseRequest request = options.request;
  request.file = options.file;
  request.cache = io::ContentCache::from_environment();
  const app::ResponseRun run =
      with_progress(common.quiet, [&](const Progress& progress) { return app::run_response(request, progress); });
  print_notes(run.notes, common.quiet);
  const auto json = [&] { return app::response_json(run); };
  write_json_file(options.json_file, json);
  if (!options.folder.empty()) app::write_response_folder(options.folder, run);
  write_report_file(options.report_file, [&] {
    return app::pages::plain_page("response", "the response of a vehicle", json(), pictures_of(run));
  });
  print_results(options.json_file, json, [&] { return app::response_table(run); });
  return kOk;
}

}  // namespace

Command add_response(CLI::App& verb) {
  auto options = std::make_shared<ResponseOptions>();
  app::ResponseRequest& request = options->request;
  verb.add_option("FILE", options->file, "Simulation file (.toml)")->required();
  const auto add_frequency = [&](const char* name, double& value, const char* text) {
    verb.add_option(name, value, text)->check(CLI::Range(1e-3, 1e5))->capture_default_str()->type_name("HZ");
  };
  add_frequency("--from", request.from, "Lowest frequency [Hz]");
  add_frequency("--to", request.to, "Highest frequency [Hz]");
  verb.add_option("--count", request.count, "Frequencies, by equal ratios")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  add_values(verb, "--inputs", request.inputs,
             "What shakes: longitudinal_level, cross_level, alignment, gauge, ws1_left.vertical_force, "
             "ws1_left.roughness, left_rail.roughness ..., * for any letters",
             "INPUT,...");
  add_values(verb, "--channels", request.channels, "What responds, by the names of a history, as ws1_*.Q_N",
             "CHANNEL,...");
  verb.add_flag("--iso-3095", request.iso_3095,
                "Also spectra of what both rails do, as rough as ISO 3095:2013 allows, beside the irregularities");
  add_output(verb, "--json", options->json_file, "Write the numbers here; - for standard output instead of the text",
             "FILE");
  add_output(verb, "-o,--output", options->folder,
             "Folder for response.json, response.csv, response.svg, spectra.csv and modes.svg", "FOLDER");
  add_report_file(verb, options->report_file);
  add_overrides(verb, request.overrides, "simulation.speed_m_s=40");
  return command(options, response_command);
}

}  // namespace treadmark::cli
