// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::cli {

Command add_simulate(CLI::App& verb) { return add_left_out(verb); }
Command add_assess(CLI::App& verb) { return add_left_out(verb); }
Command add_sweep(CLI::App& verb) { return add_left_out(verb); }
Command add_evolve(CLI::App& verb) { return add_left_out(verb); }
Command add_stability(CLI::App& verb) { return add_left_out(verb); }
Command add_response(CLI::App& verb) { return add_left_out(verb); }
Command add_track(CLI::App& verb) { return add_left_out(verb); }
Command add_table(CLI::App& verb) { return add_left_out(verb); }

void check_study_file(const std::string& name, const std::vector<std::string>&) {
  left_out("vehicle", "studies such as " + name);
}
void check_evolution_file(const std::string& name, const std::vector<std::string>&) {
  left_out("vehicle", "evolutions such as " + name);
}
void check_simulation_file(const std::string& name, const std::vector<std::string>&) {
  left_out("vehicle", "simulations such as " + name);
}
void check_vehicle_file(const std::string& name, const std::vector<std::string>&) {
  left_out("vehicle", "vehicles such as " + name);
}
void check_track_file(const std::string& name, const std::vector<std::string>&) {
  left_out("vehicle", "tracks such as " + name);
}
void check_limits_file(const std::string& name, const std::vector<std::string>&) {
  left_out("vehicle", "limits such as " + name);
}

io::CaseFile cases_of_instant(const std::string& store, const std::string&, double, const std::vector<std::string>&) {
  left_out("vehicle", "results of simulations such as " + store);
}

std::string vehicle_schema() { left_out("vehicle", "the schema of vehicle files"); }
std::string track_schema() { left_out("vehicle", "the schema of track files"); }
std::string simulation_schema() { left_out("vehicle", "the schema of simulation files"); }
std::string study_schema() { left_out("vehicle", "the schema of study files"); }
std::string evolve_schema() { left_out("vehicle", "the schema of evolution files"); }
std::string design_schema() { left_out("vehicle", "the schema of design files"); }
std::string limits_schema() { left_out("vehicle", "the schema of files of limits"); }

}  // namespace treadmark::cli
