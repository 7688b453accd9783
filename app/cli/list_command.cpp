// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/theories.hpp"

namespace treadmark::cli {

namespace {

int list_command(const std::string& what) {
  if (what == "backends") {
    for (const auto name : backend_names()) std::cout << name << '\n';
  } else if (what == "profiles") {
    for (const auto name : standard_profile_names()) std::cout << name << '\n';
  } else if (what == "solvers") {
    std::cout << theory_list();
  } else if (what == "verbs") {
    for (const Verb& verb : verbs()) std::cout << verb.name << '\n';
  } else {
    throw Error(ErrorKind::configuration, "cannot list '" + what + "'", {},
                "choose backends, profiles, solvers or verbs");
  }
  return kOk;
}

}  // namespace

Command add_list(CLI::App& verb) {
  auto what = std::make_shared<std::string>();
  verb.add_option("WHAT", *what, "backends, profiles, solvers or verbs")->required();
  return [what](const CommonOptions&) { return list_command(*what); };
}

}  // namespace treadmark::cli
