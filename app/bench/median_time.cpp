// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/median_time.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace treadmark::app {

double median_time(const std::function<void()>& call, double seconds) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kLeast = 3, kMost = 100000;
  std::vector<double> times;
  call();
  for (double total = 0.0; times.size() < kLeast || (total < seconds && times.size() < kMost); total += times.back()) {
    const auto start = Clock::now();
    call();
    times.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace treadmark::app
