// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/cli/output_files.hpp"
#include "treadmark/app/cli/report_file.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/compare_cases.hpp"
#include "treadmark/app/report/pages/compare_page.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/results/comparison_json.hpp"
#include "treadmark/io/results/comparison_table.hpp"

namespace treadmark::cli {
namespace {

app::CompareSettings settings_of(const CompareOptions& options) {
  using Bodies = app::CompareSettings::Bodies;
  app::CompareSettings settings;
  settings.backends = options.backends;
  settings.wheel_backends = options.wheel_backends;
  settings.rail_backends = options.rail_backends;
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

}  // namespace

int compare_command(const CompareOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  catch_interrupt();
  const io::CaseFile file = io::read_any_case(options.case_file, options.overrides);
  const auto compared = std::make_shared<io::Comparison>();
  io::Comparison& result = *compared;
  {
    ProgressLine line(common.quiet);
    Progress progress;
    progress.stop = &interrupted();
    progress.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
      line.update(finished, total, what);
    };
    result = app::compare_cases(file, settings_of(options), progress);
  }
  result.settings = echo(options);
  if (!common.quiet)
    for (const std::string& note : file.notes) std::cerr << "note: " << note << '\n';
  if (!options.output_folder.empty()) write_comparison_folder(options.output_folder, result);
  write_report_file(options.report_file, [&] { return app::report::compare_page(compared, io::to_json(result)); });
  if (options.json_file == "-")
    std::cout << io::to_json(result);
  else
    std::cout << io::comparison_table(result);
  if (!options.json_file.empty() && options.json_file != "-") io::write_json(options.json_file, result);
  if (!result.complete) std::cerr << "interrupted: " << result.candidates.size() << " representations finished\n";
  std::cout.flush();
  if (!std::cout) throw Error(ErrorKind::numerical, "the results could not be written to standard output");
  return exit_status(result);
}

}  // namespace treadmark::cli
