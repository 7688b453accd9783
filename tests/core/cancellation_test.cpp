// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/cancellation.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/support/counting_token.hpp"

namespace treadmark {
namespace {

using testing::CountingToken;

TEST(Cancellation, HoldsInItsScopeAndThread) {
  std::atomic<bool> stop{true};
  EXPECT_NO_THROW(check_cancelled());
  {
    const CancellationScope scope(&stop);
    EXPECT_THROW(check_cancelled(), Cancelled);
    std::thread([] { EXPECT_NO_THROW(check_cancelled()); }).join();
    {
      const CountingToken never;
      const CancellationScope inner(&never);
      EXPECT_NO_THROW(check_cancelled());
      EXPECT_EQ(current_cancellation(), &never);
    }
    {
      const std::atomic<bool>* nothing = nullptr;
      const CancellationScope inner(nothing);
      EXPECT_THROW(check_cancelled(), Cancelled) << "nothing leaves what holds";
    }
    stop = false;
    EXPECT_NO_THROW(check_cancelled());
    stop = true;
  }
  EXPECT_EQ(current_cancellation(), nullptr);
  EXPECT_NO_THROW(check_cancelled());
}

TEST(Cancellation, IsNoError) {
  std::atomic<bool> stop{true};
  const CancellationScope scope(&stop);
  try {
    check_cancelled();
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(), "the work was interrupted");
  }
}

TEST(Cancellation, ReachesAllThreadsOfALoop) {
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    std::atomic<bool> stop{false};
    const CancellationScope scope(&stop);
    std::atomic<int> finished{0};
    constexpr std::size_t kBodies = 10000;
    EXPECT_THROW(parallel_for(kBodies,
                              [&](std::size_t i) {
                                EXPECT_NE(current_cancellation(), nullptr);
                                if (i == 7) stop = true;
                                // loops within loops hear it too
                                parallel_for(3, [&](std::size_t) { EXPECT_NE(current_cancellation(), nullptr); });
                                ++finished;
                              }),
                 Cancelled);
    EXPECT_LT(finished.load(), static_cast<int>(kBodies));
    // threads of the pool keep nothing
    stop = false;
    EXPECT_NO_THROW(parallel_for(100, [](std::size_t) {}));
  }
  const ThreadLimit limit(4);
  parallel_for(100, [](std::size_t) { EXPECT_EQ(current_cancellation(), nullptr); });
}

TEST(Cancellation, NothingMoreIsDoneAfterTheRequest) {
  const ThreadLimit one(1);
  const CountingToken token(6);
  const CancellationScope scope(&token);
  int done = 0;
  EXPECT_THROW(parallel_for(100, [&](std::size_t) { ++done; }), Cancelled);
  EXPECT_EQ(done, 5);
  EXPECT_EQ(token.passed(), 6);
}

}  // namespace
}  // namespace treadmark
