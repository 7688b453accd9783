// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "treadmark/io/results/comparison_json.hpp"
#include "treadmark/tests/io/results/comparison_sample.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using Table = std::vector<std::vector<std::string>>;

/// Reads RFC 4180 with quoted cells that may hold commas, quotes and line ends.
Table read_csv(const std::string& text) {
  Table out(1);
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"')
        cell += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        cell += text[++i];
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',' || c == '\n') {
      out.back().push_back(cell);
      cell.clear();
      if (c == '\n') out.emplace_back();
    } else {
      cell += c;
    }
  }
  EXPECT_TRUE(out.back().empty() && cell.empty()) << "the last line has no end";
  out.pop_back();
  return out;
}

TEST(ComparisonCsv, SaysWhatTheRowsOfTheJsonFileSay) {
  const io::Comparison comparison = testing::sample_comparison();
  const nlohmann::ordered_json rows = nlohmann::ordered_json::parse(io::to_json(comparison))["rows"];
  const Table table = read_csv(io::to_csv(comparison));
  ASSERT_EQ(table.size(), rows.size() + 1);
  std::vector<std::string> names;
  for (const auto& [name, value] : rows[0].items()) names.push_back(name);
  EXPECT_EQ(table[0], names);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(table[i + 1].size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string& cell = table[i + 1][k];
      if (!rows[i].contains(names[k]) || rows[i][names[k]].is_null())
        EXPECT_EQ(cell, "") << names[k];
      else if (rows[i][names[k]].is_string())
        EXPECT_EQ(cell, rows[i][names[k]]);
      else
        EXPECT_EQ(std::stod(cell), rows[i][names[k]].get<double>()) << names[k];
    }
  }
}

TEST(ComparisonCsv, QuotesWhatWouldBreakALine) {
  io::Comparison comparison = testing::sample_comparison();
  const std::string awkward = "a,b \"c\"\nd";
  comparison.candidates[0].name = awkward;
  const Table table = read_csv(io::to_csv(comparison));
  EXPECT_EQ(table[1][0], awkward);
  EXPECT_EQ(table[1].size(), table[0].size());
}

TEST(ComparisonCsv, AnEmptyComparisonIsTheHead) {
  const Table table = read_csv(io::to_csv({}));
  ASSERT_EQ(table.size(), 1u);
  EXPECT_EQ(table[0].front(), "backend");
  EXPECT_EQ(table[0].back(), "position_error_mm");
}

TEST(ComparisonCsv, TheFileHoldsTheText) {
  const testing::TemporaryFolder folder;
  io::write_csv(folder.path() / "compare.csv", testing::sample_comparison());
  EXPECT_EQ(testing::read_text(folder.path() / "compare.csv"), io::to_csv(testing::sample_comparison()));
  EXPECT_EQ(folder.count_files(), 1u);
}

}  // namespace
}  // namespace treadmark
