// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>

namespace treadmark::cli {

/// Set by Ctrl-C while it is caught: work stops after the units that run now. A second Ctrl-C ends the program at once.
const std::atomic<bool>& interrupted();
/// To be called as often as wanted.
void catch_interrupt();

/// One line on stderr with count and estimated time left, redrawn at most ten times a second. Silent off a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  void update(std::size_t finished, std::size_t total, const std::string& what);

 private:
  bool visible_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace treadmark::cli
