// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace treadmark::io {
struct CaseFile;
}

namespace treadmark::cli {

/// Exit statuses of the program.
enum ExitStatus : int { kOk = 0, kFailed = 1, kUsage = 2, kInputData = 3, kNotConverged = 4 };

struct CommonOptions {
  int threads = 0;             ///< 0 = all cores
  bool threads_given = false;  ///< by the user
  bool quiet = false;          ///< no progress
  std::vector<std::string> plugins;
};

/// Does the work of a verb, whose options it holds. Returns an exit status or throws treadmark::Error.
using Command = std::function<int(const CommonOptions&)>;

/// One verb of the program. part: of parts() (core/parts.hpp), without which the verb says so; nullptr: none. examples:
/// what may stand behind "treadmark ", one a line. add: its options, and the command that they are parsed into.
struct Verb {
  const char *name, *group, *summary, *part, *examples;
  Command (*add)(CLI::App& verb);
};

/// All verbs, in the order in which they are listed.
std::span<const Verb> verbs();

/// The examples of a verb, indented, one a line.
std::string example_lines(const Verb& verb);

#define VERB(name, ...) Command add_##name(CLI::App& verb);
#include "treadmark/app/cli/verbs.def"
#undef VERB

/// Takes anything, and refuses it by the name of the part that this build leaves out. For without_<part>.cpp.
Command add_left_out(CLI::App& verb);

/// The case that treadmark new writes. In new_command.cpp.
std::string text_of_new_case();

/// What treadmark check does with these files: a line about each, or an Error. In check_simulation.cpp.
void check_study_file(const std::string& name, const std::vector<std::string>& overrides);
void check_evolution_file(const std::string& name, const std::vector<std::string>& overrides);
void check_simulation_file(const std::string& name, const std::vector<std::string>& overrides);
void check_vehicle_file(const std::string& name, const std::vector<std::string>& overrides);
void check_track_file(const std::string& name, const std::vector<std::string>& overrides);
void check_limits_file(const std::string& name, const std::vector<std::string>& overrides);
/// In design_command.cpp.
void check_design_file(const std::string& name, const std::vector<std::string>& overrides);
/// In import_command.cpp.
void check_import_file(const std::string& name, const std::vector<std::string>& overrides);

/// The contacts at an instant [s] of the results of a simulation as cases; simulation: its file, empty where it is to
/// be looked for. In instant_file.cpp.
io::CaseFile cases_of_instant(const std::string& store, const std::string& simulation, double time,
                              const std::vector<std::string>& overrides);

// JSON schemas of the files of verbs that a build may leave out.
std::string import_schema();  // this and the next in import_command.cpp
std::string import_report_schema();
std::string vehicle_schema();  // the rest in check_simulation.cpp
std::string track_schema();
std::string simulation_schema();
std::string study_schema();
std::string evolve_schema();
std::string design_schema();
std::string limits_schema();

}  // namespace treadmark::cli
