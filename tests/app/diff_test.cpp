// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "treadmark/app/compare/result_difference.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

io::RunResult two_cases() {
  io::RunResult run;
  for (const int number : {1, 2}) {
    io::CaseResult one;
    one.number = number;
    io::PatchResult patch;
    patch.fn = 1000.0 * number;
    patch.fx = 100.0;
    patch.pmax = 1e9;
    one.patches = {patch};
    run.cases.push_back(one);
  }
  return run;
}

TEST(ResultDifference, AResultAgreesWithItself) {
  const app::ResultDifference same = app::compare_results(two_cases(), two_cases());
  EXPECT_TRUE(app::agree(same, 0.0));
  EXPECT_GT(same.quantities.size(), 10u);
}

TEST(ResultDifference, LargestDifferenceOfEachQuantityIsNamed) {
  const io::RunResult a = two_cases();
  io::RunResult b = a;
  b.cases[0].patches[0].fn *= 1.01;
  b.cases[1].patches[0].fn *= 1.05;
  b.cases[0].patches[0].fx += 1e-4;
  const app::ResultDifference difference = app::compare_results(a, b);
  const app::QuantityDifference& worst = difference.quantities.front();
  EXPECT_EQ(worst.case_number, 2);
  EXPECT_EQ(worst.patch, 1);
  EXPECT_NEAR(worst.relative, 0.05 / 1.05, 1e-12);
  EXPECT_DOUBLE_EQ(worst.a, 2000.0);
  EXPECT_NEAR(difference.quantities[1].relative, 1e-6, 1e-9);
  EXPECT_FALSE(app::agree(difference, 0.01));
  EXPECT_TRUE(app::agree(difference, 0.05));
}

TEST(ResultDifference, IsCountedInItsDeviations) {
  io::RunResult a = two_cases(), b = a;
  b.cases[1].patches[0].fn += 50.0;
  for (io::RunResult* run : {&a, &b}) {
    io::CaseUncertainty& known = run->cases[1].uncertainty.emplace();
    known.sources = {{"wheelset.z_mm", 0.1}};
    known.numbers = {{"patch_1.fn_N", 2000.0, run == &a ? 30.0 : 40.0, false, {1.0}}};
  }
  const app::QuantityDifference worst = app::compare_results(a, b).quantities.front();
  EXPECT_EQ(worst.key, "fn_N");
  EXPECT_DOUBLE_EQ(worst.sigmas, 1.0) << "both are uncertain";
  b.cases[1].uncertainty.reset();
  EXPECT_NEAR(app::compare_results(a, b).quantities.front().sigmas, 50.0 / 30.0, 1e-12);
  a.cases[1].uncertainty.reset();
  EXPECT_TRUE(std::isnan(app::compare_results(a, b).quantities.front().sigmas));
}

TEST(ResultDifference, NumbersAreInTheUnitsOfTheFileAndInSi) {
  io::RunResult a = two_cases();
  a.cases[0].patches[0].shift = true;
  a.cases[0].patches[0].xi = 2e-3;
  io::RunResult b = a;
  b.cases[0].patches[0].xi = 3e-3;
  const app::QuantityDifference worst = app::compare_results(a, b).quantities.front();
  EXPECT_EQ(worst.key, "kinematics.xi");
  EXPECT_DOUBLE_EQ(worst.a, 2.0);  // mm, as result.json has shifts
  EXPECT_DOUBLE_EQ(worst.si_b, 3e-3);
  EXPECT_EQ(worst.unit.shown, "mm");
  EXPECT_THAT(std::string(worst.meaning), HasSubstr("longitudinal creepage"));
}

TEST(ResultDifference, RoundingAboutZeroAndTimesDoNotCount) {
  io::RunResult a = two_cases(), b = a;
  a.cases[0].patches[0].fx = 1e-9;
  b.cases[0].patches[0].fx = -1e-9;
  b.cases[0].normal_s = 3.0;
  EXPECT_TRUE(app::agree(app::compare_results(a, b), 1e-7));
}

TEST(ResultDifference, WhatOneLacksIsSaid) {
  const io::RunResult a = two_cases();
  io::RunResult b = a;
  b.cases.pop_back();
  b.cases[0].patches.clear();
  b.cases.push_back(a.cases[0]);
  b.cases.back().number = 5;
  EXPECT_THAT(app::compare_results(a, b).unmatched,
              ElementsAre("case 1: 1 and 0 patches", "case 2: only the first result has it",
                          "case 5: only the second result has it"));
  b = a;
  b.cases[1].status = Status::not_converged;
  EXPECT_THAT(app::compare_results(a, b).unmatched, ElementsAre("case 2: ok and not_converged"));
  b = a;
  b.cases[0].patches[0].max_temperature_1 = 20.0;
  EXPECT_FALSE(app::agree(app::compare_results(a, b), 1.0));
  b = a;
  b.cases[0].patches[0].fn = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(app::agree(app::compare_results(a, b), 1e9));
}

TEST(DiffCommand, TwoRunsOfACase) {
  TREADMARK_NEEDS("hdf5");
  const SampleInput input;
  const std::string a = (input.folder() / "a").string(), b = (input.folder() / "b").string();
  ASSERT_EQ(run_program({"run", input.inp().string(), "-o", a}).status, 0);
  ASSERT_EQ(run_program({"run", input.inp().string(), "-o", b, "--threads", "1"}).status, 0);
  const ProgramResult same = run_program({"diff", a, b + "/fields.h5", "--tolerance", "0"});
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_THAT(same.out, HasSubstr("0 of "));
  const ProgramResult missing = run_program({"diff", a, b + "/none.h5"});
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.err, HasSubstr("none.h5"));
}

}  // namespace
}  // namespace treadmark::testing
