// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/median_time.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

#include "treadmark/core/parallel.hpp"

namespace treadmark::app {
namespace {

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double median_time(const std::function<void()>& call, double seconds) {
  constexpr std::size_t kLeast = 3, kMost = 100000;
  double (*const time)() = thread_count() == 1 ? cpu_time : wall_time;
  std::vector<double> times;
  call();
  const double begin = wall_time();
  while (times.size() < kLeast || (wall_time() - begin < seconds && times.size() < kMost)) {
    const double start = time();
    call();
    times.push_back(time() - start);
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace treadmark::app
