// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"

namespace treadmark::cli {
namespace {

struct CheckOptions {
  std::vector<std::string> cases;
  std::vector<std::string> overrides;  ///< key=value
};

void check_case_file(const std::string& name, const std::vector<std::string>& overrides) {
  const io::CaseFile file = io::read_any_case(name, overrides);
  app::check_geometry(file);
  print_notes(file.notes, false);
  std::cout << name << ": " << file.cases.size() << (file.cases.size() == 1 ? " case" : " cases") << ", no errors\n";
}

int check_command(const CheckOptions& options, const CommonOptions&) {
  for (const std::string& name : options.cases)
    if (io::is_study_file(name))
      check_study_file(name, options.overrides);
    else if (io::is_simulation_file(name))
      check_simulation_file(name, options.overrides);
    else
      check_case_file(name, options.overrides);
  return kOk;
}

}  // namespace

Command add_check(CLI::App& verb) {
  auto options = std::make_shared<CheckOptions>();
  add_case_files(verb, options->cases, options->overrides);
  return command(options, check_command);
}

}  // namespace treadmark::cli
