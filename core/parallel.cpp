// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parallel.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "treadmark/core/cancellation.hpp"

namespace treadmark {

using tbb::global_control;

ThreadLimit::ThreadLimit(int threads)
    : control_(new global_control(global_control::max_allowed_parallelism,
                                  threads > 0 ? static_cast<std::size_t>(threads)
                                              : static_cast<std::size_t>(tbb::info::default_concurrency()))) {}

ThreadLimit::~ThreadLimit() { delete static_cast<global_control*>(control_); }

int thread_count() { return static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism)); }

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (count == 1 || thread_count() == 1) {
    for (std::size_t i = 0; i < count; ++i) {
      check_cancelled();
      body(i);
    }
    return;
  }
  const CancellationToken* token = current_cancellation();
  // A thread that waits for the rest of this loop must not begin a part of another one: what it holds for itself,
  // buffers and locks, belongs to the work that waits.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const CancellationScope scope(token);
      check_cancelled();
      body(i);
    });
  });
}

}  // namespace treadmark
