// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_schema.hpp"
#include "treadmark/model/theories.hpp"

namespace treadmark::cli {

int list_command(const std::string& what) {
  if (what == "backends") {
    for (const auto name : backend_names()) std::cout << name << '\n';
  } else if (what == "profiles") {
    for (const auto name : standard_profile_names()) std::cout << name << '\n';
  } else if (what == "solvers") {
    std::cout << theory_list();
  } else if (what == "verbs") {
    std::cout << "run\ncompare\nbench\nconvert\nimport\nscan\nsimulate\nsweep\nreport\nplot\ncheck\nlist\nschema\n";
  } else {
    throw Error(ErrorKind::configuration, "cannot list '" + what + "'", {},
                "choose backends, profiles, solvers or verbs");
  }
  return kOk;
}

int schema_command() {
  std::cout << io::case_file_schema() << '\n';
  return kOk;
}

}  // namespace treadmark::cli
