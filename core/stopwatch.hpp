// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark {

/// Seconds since some moment: where work may use one thread only, processor time of the thread that asks, which other
/// programs do not lengthen; else time of the day.
double used_seconds();

/// Adds the seconds from its making to its end to a total [s], which must outlive it. Not to be shared between threads.
class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total), start_(used_seconds()) {}
  ~Stopwatch() { total_ += used_seconds() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_;
  double start_;
};

}  // namespace treadmark
