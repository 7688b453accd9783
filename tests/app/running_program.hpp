// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {

/// A program that runs beside the test: {"treadmark", ...} is the one under test, another first word is looked up in
/// PATH.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& command);
  ~RunningProgram();  ///< kills it if it still runs
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  bool running();
  pid_t process() const { return process_; }
  void send(int signal);
  /// Waits for its end. status: -1 where a signal ended it.
  ProgramResult wait();

 private:
  pid_t process_ = -1;
  std::optional<int> ended_;  ///< as of waitpid
  TemporaryFolder folder_;    ///< of what it prints
};

}  // namespace treadmark::testing
