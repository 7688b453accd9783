// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>

#include <fmt/format.h>

#include "treadmark/tests/app/measured/told.hpp"
#include "treadmark/tests/support/shared_data.hpp"

/// The wheels of somebody who begins, with the right values beside them in ../shared/found/first-use/README.md.
namespace treadmark::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

using Pressures = std::array<double, 4>;                      // [MPa] at y = -2, 0, 2, 4 mm
constexpr Pressures kHollow{1588.0, 1265.0, 2263.0, 3320.0};  // noise_0.csv
constexpr Pressures kNew{1697.0, 1777.0, 1305.0, 1711.0};     // s1002c.csv
constexpr double kClean = 0.002, kNoisy = 0.05;

Told run_on_chosen_elements(const fs::path& shared, const char* name) {
  const fs::path folder = shared / "found/first-use";
  return told_by_run(folder / "my.toml", {"wheel.shape.file=" + (folder / name).string()});
}

Told run_with(const fs::path& shared, const char* name) {
  const fs::path folder = shared / "found/first-use";
  // the numbers are those of elements of 0.5 mm
  return told_by_run(folder / "my.toml", {"wheel.shape.file=" + (folder / name).string(), "discretisation.dx_mm=0.5",
                                          "discretisation.ds_mm=0.5"});
}

void expect_pressures(const Told& told, const Pressures& right, double relative) {
  ASSERT_EQ(told.cases.size(), right.size()) << told.err;
  for (std::size_t k = 0; k < right.size(); ++k)
    EXPECT_NEAR(told.cases[k].pmax_MPa, right[k], std::max(relative * right[k], 2.0 * told.cases[k].noise_MPa)) << k;
}

TEST(FirstUseProfiles, CleanPointsStayAsTheyAre) {
  TREADMARK_REQUIRE_SHARED();
  for (const auto& [name, right] : {std::pair{"noise_0.csv", kHollow}, {"s1002c.csv", kNew}}) {
    const Told told = run_with(*shared, name);
    EXPECT_EQ(told.status, 0) << told.err;
    expect_pressures(told, right, kClean);
  }
}

// Where contact ends at a sharp bend, elements of 0.5 mm are 20 % off, noise or not.
TEST(FirstUseProfiles, NoiseChangesLittleOrIsDoubted) {
  TREADMARK_REQUIRE_SHARED();
  struct Files {
    const char *noisy, *clean;
    double allowed;
  };
  // the clean points have waves of 0.8 um and 7 mm, worth 7 % of the pressure, which nobody sees under 10 um
  for (const auto& [noisy, clean, allowed] : {Files{"noise_0.003.csv", "noise_0.csv", kNoisy},
                                              {"s1002n1.csv", "s1002c.csv", kNoisy},
                                              {"noise_0.01.csv", "noise_0.csv", 2.0 * kNoisy}}) {
    const Told told = run_on_chosen_elements(*shared, noisy), right = run_on_chosen_elements(*shared, clean);
    ASSERT_EQ(told.cases.size(), right.cases.size()) << told.err;
    for (std::size_t k = 0; k < right.cases.size(); ++k) {
      if (told.cases[k].status == "doubtful") continue;
      EXPECT_NEAR(told.cases[k].pmax_MPa, right.cases[k].pmax_MPa, allowed * right.cases[k].pmax_MPa) << noisy << k;
    }
  }
}

// Against elements of 0.1 mm.
TEST(FirstUseProfiles, ChosenElementsHoldWhereContactEndsAtABend) {
  TREADMARK_REQUIRE_SHARED();
  const Told told = run_on_chosen_elements(*shared, "s1002c.csv");
  ASSERT_EQ(told.cases.size(), 4u) << told.err;
  EXPECT_NEAR(told.cases[3].pmax_MPa, 2077.0, 0.02 * 2077.0);
}

TEST(FirstUseProfiles, AWheelMeasuredFromItsBackStandsOnItsTread) {
  TREADMARK_REQUIRE_SHARED();
  const Told told = run_with(*shared, "wheel_back0.csv");
  if (!told.refused()) expect_pressures(told, kHollow, kNoisy);
}

TEST(FirstUseProfiles, AMiniProfWheelStandsOnItsTread) {
  TREADMARK_REQUIRE_SHARED();
  const fs::path wheel = *shared / "data/real/profiles/Car7422_0001r.whl";
  const Told told = told_by_run(*shared / "found/first-use/my.toml", {"wheel.shape.file=" + wheel.string()});
  EXPECT_LE(told.status, 1) << told.err;
  expect_pressures(told, {1680.0, 1626.0, 2000.0, 2157.0},
                   0.08);  // unsmoothed; its noise of 0.4 um moves them by 2 to 7 %
}

TEST(FirstUseProfiles, AWheelOfTheOtherSideIsMirroredOrRefused) {
  TREADMARK_REQUIRE_SHARED();
  const Told told = run_with(*shared, "wheel_mirror.csv");
  if (!told.refused() && !told.doubted("flange_side")) expect_pressures(told, kHollow, kNoisy);
}

TEST(FirstUseProfiles, WearOfARailIsNotFittedAway) {
  TREADMARK_REQUIRE_SHARED();
  const fs::path rail = *shared / "found/first-use/rail_worn.csv";
  const Told check = told_by({"check", rail.string(), "--body", "rail"});
  ASSERT_LE(check.status, 1) << check.err;
  EXPECT_THAT(check.out, ContainsRegex("standard +[^\n]*60E1")) << check.out;
  EXPECT_THAT(check.out, ::testing::Not(ContainsRegex("standard +[^\n]*UIC519")));
}

TEST(FirstUseProfiles, WearOfAWheelIsNotFittedAway) {
  TREADMARK_REQUIRE_SHARED();
  const fs::path wheel = *shared / "found/first-use/noise_0.csv";
  const Told check = told_by({"check", wheel.string(), "--body", "wheel"});
  ASSERT_LE(check.status, 1) << check.err;
  EXPECT_THAT(check.out, ContainsRegex("0\\.(7[789]|8[01])[0-9]* mm")) << check.out;  // `measure` finds 0.793 mm
}

}  // namespace
}  // namespace treadmark::testing
