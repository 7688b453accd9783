// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/output_files.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/app/compare/pages/compare_page.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/results/comparison_json.hpp"
#include "treadmark/io/results/comparison_table.hpp"

namespace treadmark::cli {
namespace {

struct CompareOptions {
  std::string case_file;
  std::string output_folder, json_file;
  std::vector<std::string> backends, wheel_backends, rail_backends, detectors;
  std::vector<double> resolutions_mm;
  std::string bodies = "auto";
  std::vector<std::string> overrides;
  std::string report_file;  ///< HTML; empty = none
};

app::CompareSettings settings_of(const CompareOptions& options) {
  using Bodies = app::CompareSettings::Bodies;
  app::CompareSettings settings;
  settings.backends = options.backends;
  settings.wheel_backends = options.wheel_backends;
  settings.rail_backends = options.rail_backends;
  settings.detectors = options.detectors;
  settings.bodies = options.bodies == "wheel"  ? Bodies::wheel
                    : options.bodies == "rail" ? Bodies::rail
                    : options.bodies == "both" ? Bodies::both
                                               : Bodies::automatic;
  if (!options.resolutions_mm.empty()) {
    settings.resolutions.clear();
    for (const double r : options.resolutions_mm) settings.resolutions.push_back(1e-3 * r);
  }
  settings.sample_surfaces = !options.output_folder.empty();
  return settings;
}

std::vector<std::string> echo(const CompareOptions& options) {
  std::vector<std::string> out = options.overrides;
  const auto add = [&](const char* key, const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    if (!names.empty()) out.push_back(fmt::format("{}={}", key, text));
  };
  add("backends", options.backends);
  add("wheel-backends", options.wheel_backends);
  add("rail-backends", options.rail_backends);
  add("detectors", options.detectors);
  for (const double r : options.resolutions_mm) out.push_back(fmt::format("resolution_mm={:g}", r));
  out.push_back("bodies=" + options.bodies);
  return out;
}

int exit_status(const io::Comparison& result) {
  if (!result.complete) return kFailed;
  int status = kOk;
  for (const io::ComparisonCandidate& c : result.candidates)
    for (const io::ComparisonRow& row : c.rows) {
      if (row.status == Status::failed) return kFailed;
      if (row.status == Status::not_converged) status = kNotConverged;
    }
  return status;
}

int compare_command(const CompareOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  catch_interrupt();
  const io::CaseFile file = app::read_registered_case(options.case_file, options.overrides);
  const auto compared = std::make_shared<io::Comparison>(with_progress(common.quiet, [&](const Progress& progress) {
    return app::compare_cases(file, settings_of(options), progress);
  }));
  io::Comparison& result = *compared;
  result.settings = echo(options);
  print_notes(file.notes, common.quiet);
  const std::vector<std::string> doubts = app::import_doubts(file);
  for (const std::string& doubt : doubts) std::cerr << "warning: " << doubt << '\n';
  if (!options.output_folder.empty())
    print_notes(app::write_comparison_folder(options.output_folder, result), common.quiet);
  write_report_file(options.report_file, [&] { return app::pages::compare_page(compared, io::to_json(result)); });
  const auto json = [&] { return io::to_json(result); };
  print_results(options.json_file, json, [&] { return io::comparison_table(result); });
  write_json_file(options.json_file, json);
  if (!result.complete) std::cerr << "interrupted: " << result.candidates.size() << " representations finished\n";
  const int status = exit_status(result);
  return status == kOk && !doubts.empty() ? kFailed : status;
}

}  // namespace

Command add_compare(CLI::App& verb) {
  auto options = std::make_shared<CompareOptions>();
  verb.add_option("CASE", options->case_file, "Treadmark case (.toml) or CONTACT input file (.inp)")->required();
  CLI::Option* backends = add_values(verb, "--backends", options->backends,
                                     "Representations, default all that the shapes allow", "A,B,...");
  add_values(verb, "--resolutions", options->resolutions_mm, "Spacings of the data [mm], default 1,0.5,0.25", "MM,...");
  CLI::Option* bodies =
      verb.add_option("--bodies", options->bodies,
                      "Compared bodies: wheel, rail, both; auto = those that change along their length")
          ->check(CLI::IsMember({"auto", "wheel", "rail", "both"}));
  add_values(verb, "--wheel-backends", options->wheel_backends, "With --rail-backends: every wheel on every rail",
             "A,B,...")
      ->excludes(backends)
      ->excludes(bodies);
  add_values(verb, "--rail-backends", options->rail_backends, "See --wheel-backends", "A,B,...")
      ->excludes(backends)
      ->excludes(bodies);
  add_values(verb, "--detectors", options->detectors,
             "Detectors of contact on the surfaces as given, in place of representations (list detectors)", "A,B,...")
      ->excludes(backends)
      ->excludes(bodies)
      ->excludes("--wheel-backends")
      ->excludes("--rail-backends");
  add_output(verb, "-o,--output", options->output_folder,
             "Folder for compare.json, compare.csv, table.txt and pictures (SVG)", "FOLDER");
  add_output(verb, "--json", options->json_file, "Write the rows here; - for standard output instead of the table",
             "FILE");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides);
  return command(options, compare_command);
}

}  // namespace treadmark::cli
