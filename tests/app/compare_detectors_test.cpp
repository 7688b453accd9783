// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// One case by several detectors, one of which comes from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/detection/detector.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/consumer/project/fine_grid.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTwoDetectors = R"(
rail.shape.standard = "60E1"
wheel.shape.standard = "S1002"
track.cant = "1:40"
wheelset.vertical_force_N = 80e3
discretisation.dx_mm = 1
discretisation.ds_mm = 0.5
[[cases]]
wheelset.y_mm = [0, 4]
)";

io::CaseFile read(const std::string& more = "") {
  const treadmark::testing::TemporaryFolder folder;
  return io::read_any_case(folder.write("case.toml", more + kTwoDetectors), {});
}

TEST(CompareDetectors, AgreeOnTheSameCaseAlsoWithOneFromOutside) {
  register_fine_grid();
  CompareSettings settings;
  settings.detectors = {"grid", "full_grid", "locus", "fine-grid"};
  const io::Comparison found = compare_cases(read(), settings);
  ASSERT_EQ(found.candidates.size(), 5u) << "and the truth";
  for (const io::ComparisonCandidate& c : found.candidates) {
    EXPECT_EQ(c.failure, "") << c.name;
    ASSERT_EQ(c.rows.size(), 2u);
    for (const io::ComparisonRow& row : c.rows) {
      EXPECT_TRUE(row.comparable) << c.name;
      EXPECT_LT(std::abs(row.pmax_error), 0.01) << c.name;
      EXPECT_LT(row.position_error, 0.1e-3) << c.name;
    }
  }
}

TEST(CompareDetectors, WhatIsNotForACaseIsAFailureOfThatDetector) {
  CompareSettings settings;
  settings.detectors = {"grid", "locus"};
  const io::Comparison found =
      compare_cases(read("rail.squats = [{ length_mm = 30, width_mm = 20, depth_mm = 0.2 }]\n"), settings);
  ASSERT_EQ(found.candidates.size(), 3u);
  EXPECT_EQ(found.candidates[1].failure, "");
  EXPECT_THAT(found.candidates[2].failure, HasSubstr("prismatic"));
}

TEST(CompareDetectors, UnknownNamesAreRefusedWithTheListOfAll) {
  CompareSettings settings;
  settings.detectors = {"radar"};
  try {
    compare_cases(read(), settings);
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("no detector 'radar'"));
    EXPECT_THAT(e.advice(), HasSubstr("grid, full_grid, locus"));
  }
  EXPECT_THROW(detection::register_detector({"grid", "again", [](const auto&, const auto&) { return nullptr; }}),
               Error);
  EXPECT_THROW(detection::register_detector({"Own", "a capital", [](const auto&, const auto&) { return nullptr; }}),
               Error);
  EXPECT_THROW(detection::register_detector({"nothing", "makes nothing", nullptr}), Error);
}

}  // namespace
}  // namespace treadmark::app
