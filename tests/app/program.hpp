// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

namespace treadmark::testing {

struct ProgramResult {
  int status = -1;
  std::string out, err;
};

/// Runs the treadmark program with these arguments.
ProgramResult run_program(const std::vector<std::string>& arguments);

}  // namespace treadmark::testing
