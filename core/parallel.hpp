// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>

namespace treadmark {

/// Limits the threads of parallel_for in the whole process while it lives. threads <= 0: all cores. With oneTBB loops
/// within loops share them; a build without it shares the outermost loop.
class ThreadLimit {
 public:
  /// Of several limits at a time the least one holds.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Number of threads parallel_for may use now.
int thread_count();

/// Calls body(i) once for every i in [0, count), in any order, on any thread. Each call must write only its own
/// results, so that the outcome does not depend on the number of threads. The first exception of a body is rethrown.
/// Before each call is a check point (core/cancellation.hpp), for what holds where the loop was begun.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace treadmark
