// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parallel.hpp"

// One thread, whatever is asked for: results do not depend on their number.
namespace treadmark {

ThreadLimit::ThreadLimit(int) : control_(nullptr) {}
ThreadLimit::~ThreadLimit() = default;

int thread_count() { return 1; }

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace treadmark
