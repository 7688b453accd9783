// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"

namespace treadmark::app {
namespace {

using ::testing::Contains;
using ::testing::Not;

/// Steady rolling under 9 kN, with what stands behind IPOTCN; bound: B.
std::string rolling_patch(int bound, const std::string& potential_contact, const std::string& own = {}) {
  return " 3 MODULE\n" + own + " 2" + std::to_string(bound) +
         "3100\n 0022020\n 0000111\n 999 100 30 1 1e-6\n 9000. 0.001 0. 0.\n 0.3 0.3\n 0. 0.1 1000.\n"
         " 0.28 0.28 82000. 82000.\n" +
         potential_contact + " 0\n";
}

io::CaseResult solved_one(const io::CaseFile& file) {
  io::RunResult run = run_cases(file);
  EXPECT_EQ(run.cases.at(0).status, Status::ok) << run.cases.at(0).message;
  return run.cases.at(0);
}

io::CaseResult solved_one(const std::string& text) { return solved_one(io::parse_contact_input(text, "patch.inp")); }

std::vector<RemarkKind> kinds_of(const io::CaseResult& result) {
  std::vector<RemarkKind> out;
  for (const Remark& remark : result.remarks) out.push_back(remark.kind);
  return out;
}

const std::string kTwelveElements = " -1\n 12 12 0.001 0.001 1.1\n", kHalvesOnTwelve = " -6\n 12 12 3. 2. 4. 1.1\n",
                  kCutByGrid = " -1\n 24 24 0.001 0.001 0.8\n";

// Formulas on a dozen elements miss the force by half a per cent; a solved pressure does not.
TEST(FalseAlarms, PressureByFormulaUnderAForce) {
  for (const auto& [bound, contact] : {std::pair{2, kTwelveElements}, {3, kTwelveElements}, {4, kHalvesOnTwelve}}) {
    const io::CaseResult result = solved_one(rolling_patch(bound, contact));
    EXPECT_NEAR(result.patches.at(0).fn, 9000.0, 0.03 * 9000.0);
    EXPECT_FALSE(any_grave(result.remarks)) << bound;
  }
  EXPECT_THAT(kinds_of(solved_one(rolling_patch(2, kTwelveElements))), Contains(RemarkKind::force_differs));
  EXPECT_THAT(kinds_of(solved_one(rolling_patch(0, kTwelveElements))), Not(Contains(RemarkKind::force_differs)));
}

TEST(FalseAlarms, ContactAtTheBorderOfAGivenGrid) {
  const io::CaseFile given = io::parse_contact_input(rolling_patch(0, kCutByGrid), "patch.inp");
  const io::CaseResult result = solved_one(given);
  EXPECT_THAT(kinds_of(result), Contains(RemarkKind::grid_bounds_contact));
  EXPECT_FALSE(any_grave(result.remarks));
  const io::CaseResult open = solved_one(rolling_patch(0, kCutByGrid, " %treadmark patch.grid_border = \"open\"\n"));
  EXPECT_THAT(kinds_of(open), Contains(RemarkKind::grid_cuts_contact));
  EXPECT_TRUE(any_grave(open.remarks));
  // A case file made of it means the same; one that does not say so means bodies that go on.
  std::string text = io::case_file_text(given, "");
  EXPECT_FALSE(any_grave(solved_one(io::parse_case_text(text, "patch.toml")).remarks));
  const std::size_t key = text.find("grid_border");
  ASSERT_NE(key, std::string::npos);
  text.erase(key, text.find('\n', key) - key);
  EXPECT_TRUE(any_grave(solved_one(io::parse_case_text(text, "patch.toml")).remarks));
}

}  // namespace
}  // namespace treadmark::app
