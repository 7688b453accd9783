// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/stopwatch.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace treadmark
