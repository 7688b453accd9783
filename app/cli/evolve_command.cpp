// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/evolve/run_evolution.hpp"
#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/simulations/read_evolution.hpp"

namespace treadmark::cli {
namespace {

struct EvolveOptions {
  std::string file, output_folder, report_file, json_file;
  bool resume = false, vtk = false;
  std::vector<std::string> overrides;
};

int evolve_command(const EvolveOptions& options, const CommonOptions& common) {
  require_part("hdf5", "evolutions");
  require_part("openvdb", "evolutions");
  const ThreadLimit limit(common.threads);
  const io::EvolutionFile file = io::read_evolution_file(options.file, options.overrides);
  print_notes(file.positions.notes, common.quiet);
  app::EvolutionOptions wanted{options.output_folder, options.resume, options.overrides};
  const io::EvolutionResult result =
      with_progress(common.quiet, [&](const Progress& progress) { return app::run_evolution(file, wanted, progress); });
  app::write_evolution_folder(options.output_folder, result);
  if (options.vtk) app::write_evolution_vtk(file, options.output_folder);
  const auto json = [&] { return app::evolution_json(result); };
  write_json_file(options.json_file, json);
  write_report_file(options.report_file, [&] { return app::pages::read_report(options.output_folder); });
  print_results(options.json_file, json, [&] { return app::evolution_table(result); });
  if (!common.quiet)
    for (const Remark& remark : result.remarks) std::cerr << to_line(remark) << '\n';
  if (result.status != "complete") {
    std::cerr << result.status << ": " << result.message << '\n';
    return kFailed;
  }
  const double doubts = io::doubts_of(result);
  if (doubts > 0.0 && !common.quiet)
    std::cerr << fmt::format(
        "{:.0f} warnings about contacts: see evolution.json and the contacts of their generation\n", doubts);
  return doubts > 0.0 ? kFailed : kOk;
}

}  // namespace

Command add_evolve(CLI::App& verb) {
  auto options = std::make_shared<EvolveOptions>();
  verb.add_option("FILE", options->file, "Evolution file (.toml)")->required();
  add_output(verb, "-o,--output", options->output_folder, "Folder for generations, surfaces and tables", "FOLDER")
      ->required();
  verb.add_flag("--resume", options->resume,
                "Go on with an evolution that was stopped; there must be one in the folder");
  verb.add_flag("--vtk", options->vtk, "Write the surfaces of all generations for ParaView too: FOLDER/vtk");
  add_output(verb, "--json", options->json_file, "Write the results here as JSON; - for standard output", "FILE");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides, "evolve.max_depth_mm=0.1");
  return command(options, evolve_command);
}

}  // namespace treadmark::cli
