// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/evolve/run_evolution.hpp"
#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/simulation/line_summary.hpp"
#include "treadmark/app/simulation/study_figures.hpp"
#include "treadmark/io/simulations/read_evolution.hpp"
#include "treadmark/io/simulations/read_limits.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::cli {
namespace {

void check_run(const std::variant<io::SimulationFile, io::CaseFile>& run, app::SurfaceStore& surfaces) {
  if (const auto* simulation = std::get_if<io::SimulationFile>(&run))
    app::check_vehicle(*simulation, surfaces);
  else
    app::check_geometry(std::get<io::CaseFile>(run));
}

}  // namespace

void check_study_file(const std::string& name, const std::vector<std::string>& overrides) {
  const io::StudyFile study = io::read_study_file(name, overrides);
  app::check_study_figures(study);
  app::SurfaceStore surfaces;
  for (const io::StudyRun& run : study.runs) {
    const auto input = io::read_study_run(study, run);
    check_run(input, surfaces);
  }
  std::cout << name << ": " << study.runs.size() << (study.runs.size() == 1 ? " run" : " runs") << ", no errors\n";
}

void check_evolution_file(const std::string& name, const std::vector<std::string>& overrides) {
  const io::EvolutionFile file = io::read_evolution_file(name, overrides);
  app::check_evolution(file);
  std::cout << name << ": an evolution of " << file.positions.runs.size()
            << (file.positions.runs.size() == 1 ? " position" : " positions") << ", no errors\n";
}

void check_simulation_file(const std::string& name, const std::vector<std::string>& overrides) {
  app::SurfaceStore surfaces;
  const io::SimulationFile file = io::read_simulation_file(name, overrides);
  check_run(file, surfaces);
  print_notes(file.notes, false);
  for (const std::string& text : app::line_summary(file)) std::cout << name << ": " << text << '\n';
  std::cout << name << ": a simulation, no errors\n";
}

void check_vehicle_file(const std::string& name, const std::vector<std::string>& overrides) {
  const VehicleModel vehicle = io::read_vehicle_file(name, overrides);
  std::cout << fmt::format("{}: vehicle \"{}\": {} bodies, {} wheelsets, {} parts between them; no errors\n", name,
                           vehicle.name, vehicle.bodies.size(), vehicle.wheelsets.size(),
                           vehicle.springs.size() + vehicle.bump_stops.size() + vehicle.damper_curves.size() +
                               vehicle.frictions.size() + vehicle.air_springs.size());
}

void check_track_file(const std::string& name, const std::vector<std::string>& overrides) {
  const io::AnyTrack track = io::read_any_track_file(name, overrides);
  if (const auto* lumped = std::get_if<TrackModel>(&track))
    std::cout << fmt::format("{}: track \"{}\": {} bodies, {} springs; no errors\n", name, lumped->name,
                             lumped->bodies.size(), lumped->springs.size());
  else
    std::cout << fmt::format("{}: track \"{}\": flexible rails on {} seats; no errors\n", name,
                             std::get<FlexibleTrack>(track).name, std::get<FlexibleTrack>(track).seats.size());
}

void check_limits_file(const std::string& name, const std::vector<std::string>& overrides) {
  if (!overrides.empty())
    throw Error(ErrorKind::configuration, "limits of a file cannot be set", {name}, "change the file");
  AssessmentRequest request;
  request.limits = io::read_limits_file(name);
  app::check(request);
  std::cout << fmt::format("{}: {} limits, {}; no errors\n", name, request.limits->limits.size(),
                           app::limits_text(*request.limits));
}

std::string vehicle_schema() { return io::vehicle_file_schema(); }
std::string track_schema() { return io::track_file_schema(); }
std::string simulation_schema() { return io::simulation_file_schema(); }
std::string study_schema() { return io::study_file_schema(); }
std::string evolve_schema() { return io::evolve_file_schema(); }
std::string design_schema() { return io::design_file_schema(); }
std::string limits_schema() { return io::limits_file_schema(); }

}  // namespace treadmark::cli
