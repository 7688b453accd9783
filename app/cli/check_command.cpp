// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/simulation/study_figures.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_study.hpp"

namespace treadmark::cli {
namespace {

struct CheckOptions {
  std::vector<std::string> cases;
  std::vector<std::string> overrides;  ///< key=value
};

void check_run(const std::variant<io::SimulationFile, io::CaseFile>& run, app::SurfaceStore& surfaces) {
  if (const auto* simulation = std::get_if<io::SimulationFile>(&run))
    app::check_vehicle(*simulation, surfaces);
  else
    app::check_geometry(std::get<io::CaseFile>(run));
}

int check_command(const CheckOptions& options, const CommonOptions&) {
  for (const std::string& name : options.cases) {
    if (io::is_study_file(name)) {
      const io::StudyFile study = io::read_study_file(name, options.overrides);
      app::check_study_figures(study);
      app::SurfaceStore surfaces;
      for (const io::StudyRun& run : study.runs) check_run(io::read_study_run(study, run), surfaces);
      std::cout << name << ": " << study.runs.size() << (study.runs.size() == 1 ? " run" : " runs") << ", no errors\n";
      continue;
    }
    if (io::is_simulation_file(name)) {
      app::SurfaceStore surfaces;
      const io::SimulationFile file = io::read_simulation_file(name, options.overrides);
      check_run(file, surfaces);
      print_notes(file.notes, false);
      std::cout << name << ": a simulation, no errors\n";
      continue;
    }
    const io::CaseFile file = io::read_any_case(name, options.overrides);
    app::check_geometry(file);
    print_notes(file.notes, false);
    std::cout << name << ": " << file.cases.size() << (file.cases.size() == 1 ? " case" : " cases") << ", no errors\n";
  }
  return kOk;
}

}  // namespace

Command add_check(CLI::App& verb) {
  auto options = std::make_shared<CheckOptions>();
  add_case_files(verb, options->cases, options->overrides);
  return command(options, check_command);
}

}  // namespace treadmark::cli
