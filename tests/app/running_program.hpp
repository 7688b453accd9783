// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/tests/app/program.hpp"

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
  std::filesystem::path out_, err_;
};

}  // namespace treadmark::testing
