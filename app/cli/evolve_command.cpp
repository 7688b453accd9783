// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/evolve/run_evolution.hpp"
#include "treadmark/app/report/pages/read_report.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/simulations/read_evolution.hpp"

namespace treadmark::cli {
namespace {

struct EvolveOptions {
  std::string file, output_folder, report_file, json_file;
  bool resume = false;
  std::vector<std::string> overrides;
};

std::string evolution_table(const io::EvolutionResult& result) {
  if (result.generations.empty()) return "";
  const auto shown = [](const std::string& name) {
    return name == "distance_km" || name == "passages" || name == "pmax_MPa" || name == "t_gamma_N" ||
           name.find("_depth_mm") != std::string::npos || name.find("_volume_mm3") != std::string::npos;
  };
  std::string text = fmt::format("{:>10}", "generation");
  for (const io::EvolutionQuantity& q : io::quantities_of(result.generations.front()))
    if (shown(q.name)) text += fmt::format("  {:>{}}", q.name, std::max<std::size_t>(q.name.size(), 10));
  text += '\n';
  for (const io::Generation& g : result.generations) {
    text += fmt::format("{:>10}", g.number);
    for (const io::EvolutionQuantity& q : io::quantities_of(g))
      if (shown(q.name)) text += fmt::format("  {:>{}.5g}", q.value, std::max<std::size_t>(q.name.size(), 10));
    text += '\n';
  }
  return text;
}

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
  const auto json = [&] { return app::evolution_json(result); };
  write_json_file(options.json_file, json);
  write_report_file(options.report_file, [&] { return app::report::read_report(options.output_folder); });
  print_results(options.json_file, json, [&] { return evolution_table(result); });
  if (result.status != "complete") {
    std::cerr << result.status << ": " << result.message << '\n';
    return kFailed;
  }
  double doubts = 0.0;
  for (const io::Generation& g : result.generations)
    for (const io::EvolvedCase& c : g.cases) doubts += c.doubts;
  if (doubts > 0.0 && !common.quiet)
    std::cerr << fmt::format("{:.0f} doubts about contacts: see evolution.json and the contacts of their generation\n",
                             doubts);
  return doubts > 0.0 ? kFailed : kOk;
}

}  // namespace

Command add_evolve(CLI::App& verb) {
  auto options = std::make_shared<EvolveOptions>();
  verb.add_option("FILE", options->file, "Evolution file (.toml)")->required();
  verb.add_option("-o,--output", options->output_folder, "Folder for generations, surfaces and tables")
      ->type_name("FOLDER")
      ->required();
  verb.add_flag("--resume", options->resume,
                "Go on with an evolution that was stopped; there must be one in the folder");
  verb.add_option("--json", options->json_file, "Write the results here as JSON; - for standard output")
      ->type_name("FILE");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides, "evolve.max_depth_mm=0.1");
  return command(options, evolve_command);
}

}  // namespace treadmark::cli
