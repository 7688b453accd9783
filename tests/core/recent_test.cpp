// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/recent.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace treadmark {
namespace {

TEST(Recent, KeepsTheLastOnesAndMakesOthersAnew) {
  Recent<int, int, 2> recent;
  std::vector<int> made;
  const auto of = [&](int key) {
    return *recent.of(key, [&] {
      made.push_back(key);
      return std::make_shared<const int>(10 * key);
    });
  };
  for (const int key : {0, 1, 0, 1, 2, 1, 0}) EXPECT_EQ(of(key), 10 * key);
  EXPECT_EQ(made, (std::vector<int>{0, 1, 2, 0}))
      << "2 takes the place of 0, the oldest, and 1 stays until 0 comes again";
}

TEST(Recent, OwnersDiffer) {
  const std::uint64_t first = owner_number();
  EXPECT_GT(first, 0u);
  EXPECT_GT(owner_number(), first);
}

}  // namespace
}  // namespace treadmark
