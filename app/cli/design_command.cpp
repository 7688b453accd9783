// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/design/run_design.hpp"
#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/simulations/read_design.hpp"

namespace treadmark::cli {
namespace {

struct DesignCommandOptions {
  std::string file, output_folder, report_file, json_file;
  std::vector<std::string> overrides;
};

int design_command(const DesignCommandOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  const OutputClaim claim(app::designed_files(options.output_folder));
  const io::DesignFile file = io::read_design_file(options.file, options.overrides);
  print_notes(file.positions.notes, common.quiet);
  const app::DesignOptions wanted{options.output_folder, options.overrides};
  const app::DesignResult result =
      with_progress(common.quiet, [&](const Progress& progress) { return app::run_design(file, wanted, progress); });
  app::write_design_folder(options.output_folder, result);
  const auto json = [&] { return app::design_json(result); };
  write_json_file(options.json_file, json);
  write_report_file(options.report_file, [&] { return app::pages::read_report(options.output_folder); });
  print_results(options.json_file, json, [&] { return app::design_table(result); });
  print_notes(result.notes, common.quiet);
  for (const std::string& warning : result.warnings)
    if (!common.quiet) std::cerr << "warning: " << warning << '\n';
  if (result.status == "interrupted") {
    std::cerr << result.status << ": " << result.message << '\n';
    return kFailed;
  }
  if (!result.warnings.empty()) return kFailed;
  return result.status == "converged" ? kOk : kNotConverged;
}

}  // namespace

void check_design_file(const std::string& name, const std::vector<std::string>& overrides) {
  const io::DesignFile file = io::read_design_file(name, overrides);
  const app::DesignCases cases(file);
  std::cout << fmt::format("{}: a design of {} numbers over {} cases, no errors\n", name, cases.variables().size(),
                           cases.given().cases.size());
}

Command add_design(CLI::App& verb) {
  auto options = std::make_shared<DesignCommandOptions>();
  verb.add_option("FILE", options->file, "Design file (.toml)")->required();
  add_output(verb, "-o,--output", options->output_folder,
             "Folder for the design, its history and the runs before and after it; the same command goes on there",
             "FOLDER")
      ->required();
  add_output(verb, "--json", options->json_file, "Write the results here as JSON; - for standard output", "FILE");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides, "design.solutions=200");
  return command(options, design_command);
}

}  // namespace treadmark::cli
