// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "treadmark/app/simulation/file_lock.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

class FileLockTest : public ::testing::Test {
 protected:
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "lock";
};

TEST_F(FileLockTest, OneHolderAtATime) {
  auto first = FileLock::attempt(file);
  ASSERT_TRUE(first);
  EXPECT_FALSE(FileLock::attempt(file));
  first.reset();
  EXPECT_TRUE(FileLock::attempt(file));
}

TEST_F(FileLockTest, MovesWithTheObject) {
  auto first = FileLock::attempt(file);
  ASSERT_TRUE(first);
  const FileLock second(std::move(*first));
  first.reset();
  EXPECT_FALSE(FileLock::attempt(file)) << "the new object holds it";
}

TEST_F(FileLockTest, ThreadsExcludeEachOther) {
  int inside = 0, most = 0, sum = 0;  // guarded by the lock alone
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        const FileLock lock = FileLock::wait(file);
        most = std::max(most, ++inside);
        sum += 1;
        --inside;
      }
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(most, 1);
  EXPECT_EQ(sum, 200);
}

TEST_F(FileLockTest, WaitReturnsWhenTheOtherHolderLetsGo) {
  auto held = FileLock::attempt(file);
  ASSERT_TRUE(held);
  std::atomic<bool> entered{false};
  std::thread waiting([&] {
    const FileLock lock = FileLock::wait(file);
    entered = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(entered);
  held.reset();
  waiting.join();
  EXPECT_TRUE(entered);
}

TEST_F(FileLockTest, AKilledProcessLosesIt) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const auto lock = FileLock::attempt(file);
    const char held = lock ? 'y' : 'n';
    if (::write(ready[1], &held, 1) == 1) pause();
    _exit(1);
  }
  char held = 0;
  ASSERT_EQ(read(ready[0], &held, 1), 1);
  EXPECT_EQ(held, 'y');
  EXPECT_FALSE(FileLock::attempt(file)) << "held by the other process";
  kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(FileLock::attempt(file));
  close(ready[0]);
  close(ready[1]);
}

TEST_F(FileLockTest, AFileThatCannotBeMadeIsTold) {
  try {
    FileLock::attempt(file / "no" / "folder");
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::configuration);
    EXPECT_NE(std::string(e.what()).find(file.string()), std::string::npos);
  }
}

}  // namespace
}  // namespace treadmark::app
