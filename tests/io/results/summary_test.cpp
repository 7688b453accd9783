// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/tests/io/results/sample_run.hpp"

namespace treadmark {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Summary, NamesQuantitiesWithUnitsAndOneColumnAPatch) {
  const std::string text = io::summary(testing::sample_run().cases[0]);
  EXPECT_THAT(text, HasSubstr("case 1: ok, 2 patches, 0.500 s\n"));
  EXPECT_THAT(text, ContainsRegex("wheelset s, y, z +\\[mm\\] +160.0000 +-2.0000 +0.3729\n"));
  EXPECT_THAT(text, ContainsRegex("force on rail x, y, z +\\[N\\] +7499.0 +322.10 +125000\n"));
  EXPECT_THAT(text, ContainsRegex("position y_tr +\\[mm\\] +759.3304 +770.3304\n"));
  EXPECT_THAT(text, ContainsRegex("creepage xi +\\[-\\] +-0.0004157 +-0.0004157\n"));
  EXPECT_THAT(text, ContainsRegex("dissipated by friction +\\[W\\] +4.846 +4.846\n"));
}

TEST(Summary, ShiftCasesSpeakOfLengthsAndWork) {
  const std::string text = io::summary(testing::sample_run().cases[1]);
  EXPECT_THAT(text, HasSubstr("case 2: not_converged (the outer loop stopped after 100 rounds), 1 warning, "));
  EXPECT_THAT(text, ContainsRegex("shift x +\\[mm\\] +0.008155\n"));
  EXPECT_THAT(text, ContainsRegex("dissipated by friction +\\[J\\] +2.75e-06\n"));
  EXPECT_THAT(text, Not(HasSubstr("wheelset")));
}

TEST(Summary, ARoundedZeroHasNoSign) {
  io::RunResult run = testing::sample_run();
  run.cases[0].patches[0].x_tr = -1e-12;
  run.cases[0].y = -0.0;
  EXPECT_THAT(io::summary(run.cases[0]), Not(HasSubstr("-0.0000 ")));
  run.cases[0].patches.at(0).eta = -8.81e-19;  // rounding
  EXPECT_THAT(io::summary(run.cases[0]), Not(HasSubstr("e-19")));
}

TEST(Summary, RowsWithoutANumberAreLeftOut) {
  io::RunResult run = testing::sample_run();
  std::vector<io::PatchResult>& patches = run.cases[0].patches;
  for (io::PatchResult& patch : patches) patch.noise.reset();
  EXPECT_THAT(io::summary(run.cases[0]), Not(HasSubstr("its error by noise")));
  patches.at(1).noise.emplace();
  patches[1].noise->pmax = 3e6;
  EXPECT_THAT(io::summary(run.cases[0]), ContainsRegex("its error by noise +\\[MPa\\] +3\n"));
  for (io::PatchResult& patch : patches) patch.xi = std::nan("");
  EXPECT_THAT(io::summary(run.cases[0]), Not(HasSubstr("creepage xi")));
}

TEST(Summary, ManyCasesHaveALineEach) {
  const io::RunResult run = testing::sample_run();
  std::istringstream lines(io::summary_list(run.cases));
  std::vector<std::string> text;
  for (std::string line; std::getline(lines, line);) text.push_back(line);
  ASSERT_GT(text.size(), run.cases.size() + 1);
  EXPECT_THAT(text[1], HasSubstr("MPa"));
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    const io::CaseResult& c = run.cases[i];
    std::istringstream cells(text[i + 2]);
    EXPECT_LE(text[i + 2].size(), 83u) << text[i + 2];
    int number = 0;
    std::string status;
    cells >> number >> status;
    EXPECT_EQ(number, c.number);
    EXPECT_EQ(status, to_string(c.status));
    if (c.patches.empty() || !c.has_wheelset || std::isnan(c.z)) continue;
    double y = 0, z = 0, pitch = 0, patches = 0, fx = 0, fy = 0, fz = 0, pmax = 0, most = 0;
    cells >> y >> z >> pitch >> patches >> fx >> fy >> fz >> pmax;
    for (const io::PatchResult& p : c.patches) most = std::max(most, p.pmax);
    EXPECT_NEAR(y, 1e3 * c.y, 1e-4) << text[i + 2];
    EXPECT_EQ(patches, static_cast<double>(c.patches.size())) << text[i + 2];
    EXPECT_NEAR(fz, c.force_tr.z(), 1e-4 * std::abs(c.force_tr.z()));
    EXPECT_NEAR(pmax, 1e-6 * most, 1e-10 * most);
  }
  std::size_t said = 0;
  for (const io::CaseResult& c : run.cases) said += c.remarks.size() + (c.message.empty() ? 0 : 1);
  EXPECT_EQ(text.size(), 2 + run.cases.size() + said);
}

TEST(Summary, ColumnsAreAligned) {
  std::istringstream lines(io::summary(testing::sample_run().cases[0]));
  std::string line;
  std::getline(lines, line);
  std::size_t end_of_patch_rows = 0;
  bool in_patches = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("  patch ")) {
      in_patches = true;
      end_of_patch_rows = line.size();
    }
    if (in_patches) {
      EXPECT_EQ(line.size(), end_of_patch_rows) << line;
    }
  }
  EXPECT_TRUE(in_patches);
}

TEST(Summary, ACaseWithoutContactIsShort) {
  const std::string text = io::summary(testing::sample_run().cases[2]);
  EXPECT_THAT(text, HasSubstr("case 3: no_contact"));
  EXPECT_THAT(text, Not(HasSubstr("patch")));
}

}  // namespace
}  // namespace treadmark
