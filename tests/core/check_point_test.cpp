// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/check_point.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "treadmark/core/output_file.hpp"
#include "treadmark/tests/support/counting_token.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using treadmark::testing::CountingToken;

TEST(CheckPoint, AsksSeldom) {
  const CountingToken never;
  const CancellationScope scope(&never);
  CheckPoint check;
  for (int i = 0; i < 40'000; ++i) check.pass();
  EXPECT_EQ(never.passed(), 40'000 / 4096);
}

TEST(SortMany, SortsAndCanBeCancelled) {
  std::vector<int> values(100'000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(i * 7919 % values.size());
  std::vector<int> sorted = values;
  const CountingToken never;
  {
    const CancellationScope scope(&never);
    sort_many(sorted);
  }
  EXPECT_TRUE(std::is_sorted(sorted.begin(), sorted.end()));
  EXPECT_GT(never.passed(), 100) << "more than 17 comparisons a value";
  sort_many(sorted, std::greater<>());
  EXPECT_EQ(sorted.front(), 99'999);
  const CountingToken token(never.passed() / 2);
  const CancellationScope scope(&token);
  EXPECT_THROW(sort_many(values), Cancelled);
}

TEST(OutputFile, IsLeftBetweenPiecesOfALargeFile) {
  const treadmark::testing::TemporaryFolder folder;
  folder.write("large", "old");
  const std::filesystem::path file = folder.path() / "large";
  const std::string content(std::size_t{3} << 24, 'x');
  const CountingToken token(2);
  const CancellationScope scope(&token);
  EXPECT_THROW(write_file(file, content), Cancelled);
  EXPECT_EQ(std::filesystem::file_size(file), 3u) << "the old one";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()),
            1);
}

TEST(OutputFile, MayBeReadWithALockAndIsNotTakenForDeadWhileItIsWritten) {
  const treadmark::testing::TemporaryFolder folder;
  OutputFile file(folder.path() / "result.h5");
  file.write("half");
  const auto hidden = std::filesystem::directory_iterator(folder.path())->path();
  const int reader = ::open(hidden.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  EXPECT_EQ(::flock(reader, LOCK_SH | LOCK_NB), 0) << "as HDF5 does, should it meet a file just renamed";
  EXPECT_NE(::flock(reader, LOCK_EX | LOCK_NB), 0) << "as who removes what dead writers left";
  ::close(reader);
}

}  // namespace
}  // namespace treadmark
