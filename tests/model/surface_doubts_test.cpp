// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/shape/surface_doubts.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace treadmark {
namespace {

std::vector<SurfaceDoubt> some_doubts() {
  std::string words = "first: of many";
  for (int i = 0; i < 120; ++i) words += " word" + std::to_string(i);
  return {{"no_flange", "the flange was not scanned: y = 0 was put where it fits"},
          {"many", words},
          {"long", std::string(500, 'x')},
          {"short", "a"}};
}

TEST(SurfaceDoubts, LinesGiveThemBack) {
  const std::vector<SurfaceDoubt> doubts = some_doubts();
  std::vector<std::string> lines = to_lines(doubts);
  for (const std::string& line : lines) {
    EXPECT_TRUE(line.starts_with(kSurfaceDoubt)) << line;
    const bool one_long_word = line.find("xxx") != std::string::npos;
    EXPECT_TRUE(one_long_word || line.size() <= 200) << line;
  }
  EXPECT_EQ(doubts_of_lines(lines), doubts);
  lines.insert(lines.begin() + 1, {"surface-errors 1 2 1 0 0 1 0 250.5 3 -4", "other words", ""});
  for (std::string& line : lines) line += "\r";
  EXPECT_EQ(doubts_of_lines(lines), doubts);
  EXPECT_TRUE(to_lines(std::vector<SurfaceDoubt>()).empty());
  EXPECT_TRUE(doubts_of_lines({}).empty());
}

TEST(SurfaceDoubts, AShortHeadHasTheirNames) {
  const std::vector<SurfaceDoubt> doubts = some_doubts();
  EXPECT_EQ(names_line({}), "");
  const std::vector<std::string> head{"binary STL", ' ' + names_line(doubts) + "   "};
  const std::vector<SurfaceDoubt> found = doubts_of_lines(head);
  ASSERT_EQ(found.size(), doubts.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].name, doubts[i].name);
    EXPECT_FALSE(found[i].text.empty());
  }
}

TEST(SurfaceDoubts, WhateverStandsThereIsTold) {
  const std::vector<std::string> lines{"surface-doubt-goes-on of nothing", "surface-doubt without a name",
                                       "surface-doubt no_sides: rung \x07 and \xff", "surface-doubts-of-others a",
                                       "surface-doubt"};
  const std::vector<SurfaceDoubt> found = doubts_of_lines(lines);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0], (SurfaceDoubt{"import", "without a name"}));
  EXPECT_EQ(found[1], (SurfaceDoubt{"no_sides", "rung ? and ?"}));
  EXPECT_EQ(found[2].name, "import");
}

TEST(SurfaceDoubts, EachIsKeptOnce) {
  std::vector<SurfaceDoubt> doubts{{"a", "1"}};
  add_doubts(doubts, std::vector<SurfaceDoubt>{{"a", "1"}, {"a", "2"}, {"b", "1"}, {"b", "1"}});
  EXPECT_EQ(doubts, (std::vector<SurfaceDoubt>{{"a", "1"}, {"a", "2"}, {"b", "1"}}));
  EXPECT_EQ(in_words(doubts.front(), "wheel", "w.ply"), "wheel surface w.ply: a: 1");
}

}  // namespace
}  // namespace treadmark
