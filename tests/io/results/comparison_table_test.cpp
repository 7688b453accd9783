// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "treadmark/tests/io/results/comparison_sample.hpp"

namespace treadmark {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

TEST(ComparisonTable, OneLineACandidateWithTheWorstOfItsCases) {
  const auto lines = lines_of(io::comparison_table(testing::sample_comparison()));
  ASSERT_GE(lines.size(), 8u);
  EXPECT_THAT(words_of(lines[2]), ElementsAre("[mm]", "[um]", "[um]", "[mrad]", "[1/m]", "[%]", "[%]", "[%]", "[mm]",
                                              "[%]", "[ms]", "[ms]", "[s]", "[MB]"));
  // Search times of the cases: 4, 8, 12 and 16 ms.
  EXPECT_THAT(words_of(lines[3]), ElementsAre("analytic", "(reference)", "-", "-", "-", "-", "-", "0", "0", "0", "0",
                                              "0", "10", "1", "1.25", "4", "3/4"));
  EXPECT_THAT(words_of(lines[4]), ElementsAre("mesh", "1", "4", "1", "1.5", "3", "20", "10", "2", "0.4", "10", "10",
                                              "1", "1.25", "4", "3/4"));
  EXPECT_THAT(words_of(lines[5]), ElementsAre("mesh", "0.5", "0.625", "0.25", "0.75", "1.5", "5", "2.5", "0.5", "0.1",
                                              "2.5", "10", "1", "1.25", "4", "2/4"));
  EXPECT_THAT(words_of(lines[7]),
              ElementsAre("vdb", "1", "-", "-", "-", "-", "-", "-", "-", "-", "-", "-", "-", "-", "-", "failed"));
}

TEST(ComparisonTable, SaysBelowWhatTheNumbersDoNot) {
  const std::string text = io::comparison_table(testing::sample_comparison());
  EXPECT_THAT(text, HasSubstr("\nvdb 1 mm: failed: no \"grid\" <in> this build, \\ & so on\n"));  // on one line
  EXPECT_THAT(text, HasSubstr("\nmesh 0.5 mm, case 2: not_converged (the outer loop stopped)\n"));
  EXPECT_THAT(text, HasSubstr("\nmesh 0.5 mm, wheel: 3 triangles mended\n"));
  EXPECT_THAT(text, ContainsRegex("mesh 1 mm, rail: no surface at 7 points"));
  EXPECT_EQ(text.find("interrupted"), std::string::npos);
  io::Comparison cut = testing::sample_comparison();
  cut.complete = false;
  EXPECT_THAT(io::comparison_table(cut), HasSubstr("interrupted"));
}

TEST(ComparisonTable, ColumnsAreAligned) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates[1].rows[0].pmax_error = -1234567.0;
  const auto lines = lines_of(io::comparison_table(comparison));
  for (const std::size_t i : {1, 3, 4, 5, 6, 7}) EXPECT_EQ(lines[i].size(), lines[0].size()) << lines[i];
  EXPECT_EQ(lines[2].find("[MB]"), lines[0].find("memory") + 2);  // no cases, and no blanks for them
  comparison.candidates[2].name = "müsh";                         // five bytes, four characters
  const auto longer = lines_of(io::comparison_table(comparison));
  EXPECT_EQ(longer[5].size(), longer[4].size() + 1);
}

TEST(ComparisonTable, PassesOverWhatIsNotFinite) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates[1].rows[1].pmax_error = std::numeric_limits<double>::quiet_NaN();
  comparison.candidates[1].rows[0].search_s = std::numeric_limits<double>::infinity();
  const auto words = words_of(lines_of(io::comparison_table(comparison))[4]);
  EXPECT_EQ(words[6], "10");   // case 1 is left
  EXPECT_EQ(words[11], "12");  // 8, 12 and 16 ms
}

TEST(ComparisonTable, SaysWhereTheLargestPressureTellsNothing) {
  io::Comparison comparison = testing::sample_comparison();
  EXPECT_EQ(io::comparison_table(comparison).find("no limit"), std::string::npos);
  EXPECT_STREQ(io::judged_pressure(comparison).name, "pmax");
  for (std::size_t i = 1; i < 4; ++i)
    for (io::ComparisonRow& row : comparison.candidates[i].rows)
      if (row.case_number == 2) row.pmax_error = std::numeric_limits<double>::quiet_NaN();
  std::string text = io::comparison_table(comparison);
  EXPECT_THAT(text, HasSubstr("\ncase 2: the largest pressure has no limit (edge_pressure)"));
  EXPECT_EQ(words_of(lines_of(text)[4])[6], "10") << "that of case 1";
  EXPECT_STREQ(io::judged_pressure(comparison).name, "pmax") << "other cases have a limit";
  for (std::size_t i = 1; i < 4; ++i)
    for (io::ComparisonRow& row : comparison.candidates[i].rows)
      row.pmax_error = std::numeric_limits<double>::quiet_NaN();
  text = io::comparison_table(comparison);
  EXPECT_THAT(text, HasSubstr("\ncase 1, 2, 3: the largest"));
  EXPECT_EQ(words_of(lines_of(text)[4])[6], "-");
  EXPECT_EQ(words_of(lines_of(text)[4])[7], "10") << "the mean pressure is left";
  EXPECT_STREQ(io::judged_pressure(comparison).name, "pmean");
}

TEST(ComparisonTable, AnEmptyComparisonIsTheHead) { EXPECT_EQ(lines_of(io::comparison_table({})).size(), 3u); }

}  // namespace
}  // namespace treadmark
