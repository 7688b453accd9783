// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/remarks.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <string>

#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;

TEST(RemarksOfResults, DocumentationHasTheTable) {
  std::ifstream file(TREADMARK_SOURCE_DIR "/docs/results.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::string table;
  for (const RemarkRow& row : kRemarkRows)
    table += fmt::format("| `{}` | {} | {} |\n", row.name, row.grave ? "warning" : "minor warning", row.meaning);
  EXPECT_THAT(text, HasSubstr(table)) << "docs/results.md must have\n" << table;
}

TEST(RemarksOfResults, StandInTheTableAndInJson) {
  CaseResult c;
  c.number = 4;
  c.remarks = {{RemarkKind::grid_cuts_contact, 2, "3 of 40 elements"}, {RemarkKind::step_rule, 0, "too long"}};
  EXPECT_THAT(summary(c), HasSubstr("  warning: patch 2: 3 of 40 elements\n  minor warning: too long\n"));
  EXPECT_EQ(words(c), "warning: patch 2: 3 of 40 elements; minor warning: too long");
  RunResult run;
  run.cases = {c};
  const auto json = nlohmann::json::parse(to_json(run));
  const nlohmann::json expected = {
      {{"name", "grid_cuts_contact"}, {"grave", true}, {"patch", 2}, {"text", "3 of 40 elements"}},
      {{"name", "step_rule"}, {"grave", false}, {"patch", 0}, {"text", "too long"}}};
  EXPECT_EQ(json["cases"][0]["remarks"], expected);
}

}  // namespace
}  // namespace treadmark::io
