// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <chrono>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/imports/import_report.hpp"

namespace treadmark::app {

/// Times the steps of an import, tells the caller about them and looks for a request to stop between them.
class StepClock {
 public:
  /// steps: how many are known to come.
  StepClock(io::ImportReport& report, const Progress& progress, std::size_t steps)
      : report_(report), progress_(progress), steps_(steps) {}

  /// A step that was not known to come.
  void begin_extra(const std::string& name) {
    ++steps_;
    begin(name);
  }
  /// Ends the step before and begins one.
  void begin(const std::string& name) {
    end();
    if (progress_.stop_requested())
      throw Error(ErrorKind::numerical, "the import was stopped before the step '" + name + "'");
    name_ = name;
    start_ = Clock::now();
    if (progress_.report) progress_.report(report_.steps.size(), steps_, name);
  }
  /// Says what the step is at.
  void tell(const std::string& what) const {
    if (progress_.report) progress_.report(report_.steps.size(), steps_, name_ + " " + what);
  }
  void end() {
    if (name_.empty()) return;
    report_.steps.push_back({name_, std::chrono::duration<double>(Clock::now() - start_).count()});
    name_.clear();
  }

 private:
  using Clock = std::chrono::steady_clock;
  io::ImportReport& report_;
  const Progress& progress_;
  std::size_t steps_;
  std::string name_;
  Clock::time_point start_;
};

}  // namespace treadmark::app
