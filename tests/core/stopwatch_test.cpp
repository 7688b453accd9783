// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/stopwatch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "treadmark/core/parallel.hpp"

namespace treadmark {
namespace {

TEST(Stopwatch, AddsToWhatThereIsWhenItEnds) {
  constexpr double kBefore = 7.0;
  double total = kBefore;
  {
    const Stopwatch watch(total);
    EXPECT_EQ(total, kBefore);
    // Until the clock has gone on, however coarse it is.
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::microseconds(1)) continue;
  }
  EXPECT_GT(total, kBefore);
}

TEST(Stopwatch, CountsOnOneThreadOnlyWhatIsUsed) {
  const ThreadLimit one(1);
  const auto begin = std::chrono::steady_clock::now();
  const auto passed = [begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  double idle = 0.0, busy = 0.0;
  {
    const Stopwatch watch(idle);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_LT(idle, 0.025);
  {
    const Stopwatch watch(busy);
    for (const double from = used_seconds(); used_seconds() - from < 0.002;) continue;
  }
  EXPECT_GE(busy, 0.002);
  EXPECT_LT(idle + busy, passed());
}

}  // namespace
}  // namespace treadmark
