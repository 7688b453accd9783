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

/// Lines of a table of 5 candidates with 3 lines of head: errors of the surfaces, errors of the contact, costs.
constexpr std::size_t kBlock = 3 + 5 + 1;

TEST(ComparisonTable, OneLineACandidateWithTheWorstOfItsCases) {
  const auto lines = lines_of(io::comparison_table(testing::sample_comparison()));
  ASSERT_GE(lines.size(), 3 * kBlock - 1);
  for (std::size_t i = 0; i < 3 * kBlock - 1; ++i) EXPECT_LE(lines[i].size(), 80u) << lines[i];
  EXPECT_THAT(words_of(lines[2]), ElementsAre("[mm]", "[um]", "[um]", "[mrad]", "[1/m]"));
  EXPECT_THAT(words_of(lines[kBlock + 2]), ElementsAre("[mm]", "[%]", "[%]", "[%]", "[mm]", "[%]"));
  EXPECT_THAT(words_of(lines[2 * kBlock + 2]), ElementsAre("[mm]", "[ms]", "[ms]", "[s]", "[MB]"));
  const auto at = [&](std::size_t block, std::size_t candidate) {
    return words_of(lines[block * kBlock + 3 + candidate]);
  };
  EXPECT_THAT(at(0, 0), ElementsAre("analytic", "-", "-", "-", "-", "-"));
  EXPECT_THAT(at(1, 0), ElementsAre("analytic", "-", "0", "0", "0", "0", "0"));
  // Search times of the cases: 4, 8, 12 and 16 ms.
  EXPECT_THAT(at(2, 0), ElementsAre("analytic", "-", "10", "1", "1.25", "4", "3/4"));
  EXPECT_THAT(at(0, 1), ElementsAre("mesh", "1", "4", "1", "1.5", "3"));
  EXPECT_THAT(at(1, 1), ElementsAre("mesh", "1", "20", "10", "2", "0.4", "10"));
  EXPECT_THAT(at(0, 2), ElementsAre("mesh", "0.5", "0.625", "0.25", "0.75", "1.5"));
  EXPECT_THAT(at(1, 2), ElementsAre("mesh", "0.5", "5", "2.5", "0.5", "0.1", "2.5"));
  EXPECT_THAT(at(2, 2), ElementsAre("mesh", "0.5", "10", "1", "1.25", "4", "2/4"));
  EXPECT_THAT(at(0, 4), ElementsAre("vdb", "1", "-", "-", "-", "-"));
  EXPECT_THAT(at(2, 4), ElementsAre("vdb", "1", "-", "-", "-", "-", "failed"));
}

TEST(ComparisonTable, SaysBelowWhatTheNumbersDoNot) {
  const std::string text = io::comparison_table(testing::sample_comparison());
  EXPECT_THAT(text, HasSubstr("\nvdb 1 mm: failed: no \"grid\" <in> this build, \\ & so on\n"));  // on one line
  EXPECT_THAT(text, HasSubstr("\nmesh 0.5 mm, case 2: not_converged (the outer loop stopped)\n"));
  EXPECT_THAT(text, HasSubstr("\nmesh 0.5 mm, wheel: 3 triangles mended\n"));
  EXPECT_THAT(text, ContainsRegex("mesh 1 mm, rail: no surface at 7 points"));
  EXPECT_THAT(text, HasSubstr("\nerrors are those against the first, analytic\n"));
  EXPECT_EQ(text.find("interrupted"), std::string::npos);
  io::Comparison cut = testing::sample_comparison();
  cut.complete = false;
  EXPECT_THAT(io::comparison_table(cut), HasSubstr("interrupted"));
}

TEST(ComparisonTable, ColumnsAreAligned) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates[1].rows[0].pmax_error = -1234567.0;
  const auto lines = lines_of(io::comparison_table(comparison));
  for (const std::size_t block : {std::size_t{0}, kBlock, 2 * kBlock})
    for (const std::size_t i : {1, 3, 4, 5, 6, 7})
      EXPECT_EQ(lines[block + i].size(), lines[block].size()) << lines[block + i];
  EXPECT_EQ(lines[2 * kBlock + 2].find("[MB]"), lines[2 * kBlock].find("memory") + 2);  // no cases, and no blanks
  comparison.candidates[2].name = "müsh";                                               // five bytes, four characters
  const auto longer = lines_of(io::comparison_table(comparison));
  EXPECT_EQ(longer[5].size(), longer[4].size() + 1);
}

TEST(ComparisonTable, PassesOverWhatIsNotFinite) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates[1].rows[1].pmax_error = std::numeric_limits<double>::quiet_NaN();
  comparison.candidates[1].rows[0].search_s = std::numeric_limits<double>::infinity();
  const auto lines = lines_of(io::comparison_table(comparison));
  EXPECT_EQ(words_of(lines[kBlock + 4])[2], "10");      // case 1 is left
  EXPECT_EQ(words_of(lines[2 * kBlock + 4])[2], "12");  // 8, 12 and 16 ms
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
  EXPECT_EQ(words_of(lines_of(text)[kBlock + 4])[2], "10") << "that of case 1";
  EXPECT_STREQ(io::judged_pressure(comparison).name, "pmax") << "other cases have a limit";
  for (std::size_t i = 1; i < 4; ++i)
    for (io::ComparisonRow& row : comparison.candidates[i].rows)
      row.pmax_error = std::numeric_limits<double>::quiet_NaN();
  text = io::comparison_table(comparison);
  EXPECT_THAT(text, HasSubstr("\ncase 1, 2, 3: the largest"));
  EXPECT_EQ(words_of(lines_of(text)[kBlock + 4])[2], "-");
  EXPECT_EQ(words_of(lines_of(text)[kBlock + 4])[3], "10") << "the mean pressure is left";
  EXPECT_STREQ(io::judged_pressure(comparison).name, "pmean");
}

TEST(ComparisonTable, AnEmptyComparisonIsTheHead) {
  EXPECT_EQ(lines_of(io::comparison_table({})).size(), 3u * 3u + 2u);
}

}  // namespace
}  // namespace treadmark
