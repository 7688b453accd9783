// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/tables/shown.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace treadmark::io {
namespace {

TEST(TableText, GoesOnBelowWhere80CharactersAreFull) {
  std::vector<std::vector<std::string>> lines{{"name"}, {"Müller"}};  // 6 characters
  for (const char* name : {"a", "b", "c"}) {
    lines[0].push_back(name + std::string(34, '_'));
    lines[1].emplace_back("1");
  }
  const std::string wide(34, '_');
  EXPECT_EQ(table_text(lines, {1}), "name    a" + wide + "  b" + wide + "\nMüller" + std::string(36, ' ') + "1" +
                                        std::string(36, ' ') + "1\n\nname    c" + wide + "\nMüller" +
                                        std::string(36, ' ') + "1\n");
  lines[0][1] += "_";  // one character more than there is room for
  EXPECT_THAT(table_text(lines, {1}), ::testing::StartsWith("name    a" + wide + "_\n"));
  EXPECT_EQ(table_text({{"n", "x", "y"}, {"", "", "[m]"}, {"a", "1", "2"}}, {1, 2}),
            "n  x\na  1\n\nn    y\n   [m]\na    2\n")
      << "where it is asked for";
}

}  // namespace
}  // namespace treadmark::io
