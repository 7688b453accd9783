// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/run_cases.hpp"
#include "treadmark/io/cases/read_case.hpp"

namespace treadmark::cli {

int check_command(const RunOptions& options) {
  for (const std::string& name : options.cases) {
    const io::CaseFile file = io::read_any_case(name, options.overrides);
    app::check_geometry(file);
    for (const std::string& note : file.notes) std::cerr << "note: " << note << '\n';
    std::cout << name << ": " << file.cases.size() << (file.cases.size() == 1 ? " case" : " cases") << ", no errors\n";
  }
  return kOk;
}

}  // namespace treadmark::cli
