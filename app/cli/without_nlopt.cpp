// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::cli {

Command add_design(CLI::App& verb) { return add_left_out(verb); }

void check_design_file(const std::string& name, const std::vector<std::string>&) {
  left_out("nlopt", "designs such as " + name);
}

}  // namespace treadmark::cli
