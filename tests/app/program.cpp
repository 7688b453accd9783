// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/app/program.hpp"

#include "treadmark/tests/app/running_program.hpp"

namespace treadmark::testing {

ProgramResult run_program(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"treadmark"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return RunningProgram(command).wait();
}

}  // namespace treadmark::testing
