// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/parallel_sort.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark {
namespace {

std::vector<double> work(int threads) {
  const ThreadLimit limit(threads);
  std::vector<double> results(5000);
  parallel_for(results.size(), [&](std::size_t i) {
    double sum = 0.0;
    for (int k = 1; k < 50; ++k) sum += std::sin(static_cast<double>(i) * k) / k;
    results[i] = sum;
  });
  return results;
}

TEST(ParallelFor, GivesTheSameForEveryNumberOfThreads) {
  const auto one = work(1);
  for (const int threads : {2, 3, 8, 0}) EXPECT_EQ(work(threads), one) << threads;
}

TEST(ParallelFor, CallsEveryIndexOnce) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{1000}}) {
    std::vector<std::atomic<int>> calls(count);
    parallel_for(count, [&](std::size_t i) { calls[i].fetch_add(1); });
    for (const auto& c : calls) EXPECT_EQ(c.load(), 1);
  }
}

TEST(ParallelFor, RethrowsWhatABodyThrows) {
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    try {
      parallel_for(100, [](std::size_t i) {
        if (i == 37) throw Error(ErrorKind::numerical, "body 37");
      });
      ADD_FAILURE() << "nothing thrown with " << threads << " threads";
    } catch (const Error& error) {
      EXPECT_EQ(error.message(), "body 37");
    }
  }
}

TEST(ParallelFor, MayBeNested) {
  std::vector<int> sums(20, 0);
  parallel_for(sums.size(), [&](std::size_t i) {
    std::vector<int> parts(30, 0);
    parallel_for(parts.size(), [&](std::size_t j) { parts[j] = static_cast<int>(i + j); });
    for (const int p : parts) sums[i] += p;
  });
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_EQ(sums[i], static_cast<int>(30 * i) + 435);
}

TEST(ParallelBlocks, CoverEveryNumberOnce) {
  for (const std::size_t count : {0u, 1u, 10u, 11u, 1000u}) {
    std::vector<std::atomic<int>> calls(count);
    parallel_blocks(count, 10, [&](std::size_t from, std::size_t to) {
      EXPECT_EQ(from % 10, 0u);
      EXPECT_LE(to, from + 10);
      for (std::size_t i = from; i < to; ++i) calls[i].fetch_add(1);
    });
    for (const auto& c : calls) EXPECT_EQ(c.load(), 1);
  }
}

TEST(ParallelSort, GivesWhatASortGivesForEveryNumberOfThreads) {
  for (const std::size_t count : {0u, 1u, 32768u, 32769u, 300'000u}) {
    Random random(count);
    std::vector<std::pair<int, std::size_t>> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = {static_cast<int>(1000.0 * random.uniform()), i};
    auto wanted = values;
    std::sort(wanted.begin(), wanted.end());
    const auto by_first = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto sorted = [&](int threads, const auto& less) {
      const ThreadLimit limit(threads);
      auto out = values;
      parallel_sort(out, less);
      return out;
    };
    EXPECT_EQ(sorted(2, std::less<>()), wanted);
    const auto one = sorted(1, by_first);
    EXPECT_TRUE(std::is_sorted(one.begin(), one.end(), by_first));
    EXPECT_EQ(sorted(3, by_first), one);
  }
}

TEST(ThreadLimit, HoldsWhileItLives) {
  const int before = thread_count();
  EXPECT_GE(before, 1);
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(thread_count(), 1);
    std::mutex guard;
    std::set<std::thread::id> ids;
    parallel_for(200, [&](std::size_t) {
      const std::lock_guard lock(guard);
      ids.insert(std::this_thread::get_id());
    });
    EXPECT_EQ(ids.size(), 1u);
    EXPECT_EQ(*ids.begin(), std::this_thread::get_id());
  }
  EXPECT_EQ(thread_count(), before);
}

TEST(Progress, StopsOnlyWhenAsked) {
  Progress progress;
  EXPECT_FALSE(progress.stop_requested());
  std::atomic<bool> stop{false};
  progress.stop = &stop;
  EXPECT_FALSE(progress.stop_requested());
  stop = true;
  EXPECT_TRUE(progress.stop_requested());
}

}  // namespace
}  // namespace treadmark
