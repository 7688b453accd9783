// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"

// Threads of the standard library for the outermost loop; loops within it run on the thread that meets them. The thread
// sanitizer sees all that happens here, which it does not in a library that was compiled without it.
namespace treadmark {

namespace {

std::mutex& limits_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::multiset<int>& limits() {
  static std::multiset<int> all;
  return all;
}

thread_local bool within_loop = false;

/// Marks this thread as one that works for a loop.
class Within {
 public:
  Within() { within_loop = true; }
  ~Within() { within_loop = false; }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;
};

int all_cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

}  // namespace

ThreadLimit::ThreadLimit(int threads) {
  const std::scoped_lock lock(limits_mutex());
  control_ = new std::multiset<int>::iterator(limits().insert(threads > 0 ? threads : all_cores()));
}

ThreadLimit::~ThreadLimit() {
  const std::scoped_lock lock(limits_mutex());
  auto* own = static_cast<std::multiset<int>::iterator*>(control_);
  limits().erase(*own);
  delete own;
}

int thread_count() {
  if (within_loop) return 1;
  const std::scoped_lock lock(limits_mutex());
  return limits().empty() ? all_cores() : *limits().begin();
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const std::size_t threads = std::min(count, static_cast<std::size_t>(thread_count()));
  if (threads <= 1) {
    for (std::size_t i = 0; i < count; ++i) {
      check_cancelled();
      body(i);
    }
    return;
  }
  const CancellationToken* token = current_cancellation();
  std::atomic<std::size_t> next = 0;
  std::exception_ptr first;
  std::once_flag failed;
  const auto work = [&] {
    const Within within;
    const CancellationScope scope(token);
    try {
      for (std::size_t i = next++; i < count; i = next++) {
        check_cancelled();
        body(i);
      }
    } catch (...) {
      next = count;
      std::call_once(failed, [&] { first = std::current_exception(); });
    }
  };
  std::vector<std::thread> others;
  others.reserve(threads - 1);
  try {
    while (others.size() + 1 < threads) others.emplace_back(work);
  } catch (const std::system_error&) {  // there are no more: fewer do the same
  }
  work();
  for (std::thread& other : others) other.join();
  if (first) std::rethrow_exception(first);
}

}  // namespace treadmark
