// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "contact_calls.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/io/cases/read_case.hpp"

namespace treadmark::testing {
namespace {

/// The input file of a session that has just ended, run by itself.
io::RunResult run_written(const std::filesystem::path& folder) {
  return app::run_cases(io::read_any_case(folder / "contact_addon.inp", {}));
}

/// Numbers of both ways differ by what starting from another solution leaves.
constexpr double kSame = 1e-4;

void expect_force(const io::PatchResult& patch, const Forces& f) {
  EXPECT_NEAR(patch.fn, f.fn, kSame * f.fn);
  EXPECT_NEAR(patch.fx, f.fx, kSame * f.fn);
  EXPECT_NEAR(patch.fs, f.fy, kSame * f.fn);
}

void set_patch(int ire, int icp) {
  set_flags(ire, icp, {{CNTC_ic_tang, 3}, {CNTC_ic_pvtime, 2}});
  cntc_setmaterialparameters(Int{ire}, Int{icp}, Int{0}, Int{4}, Reals{0.28, 0.28, 82000.0, 82000.0});
  cntc_setfrictionmethod(Int{ire}, Int{icp}, Int{0}, Int{2}, Reals{0.3, 0.3});
  cntc_setpotcontact(Int{ire}, Int{icp}, Int{1}, Int{6}, Reals{21.0, 21.0, -5.25, -5.25, 0.5, 0.5});
  cntc_setundeformeddistc(Int{ire}, Int{icp}, Int{1}, Int{6}, Reals{0.001, 0.0, 0.001, 0.0, 0.0, 0.0});
  cntc_setpenetration(Int{ire}, Int{icp}, Real{0.03});
  cntc_setreferencevelocity(Int{ire}, Int{icp}, Real{10000.0});
}

/// y falls along a wheel and grows along a rail; type: 1 a wheel, 0 a rail.
void give_points(int ire, int type, const Reals& y_and_z) {
  const int count = static_cast<int>(y_and_z.size()) / 2;
  Reals values = y_and_z;
  cntc_setprofileinputvalues(Int{ire}, Int{count}, values, Int{4}, Ints{type, 0, 0, -1}, Int{2}, Reals{1.0, 0.0});
}

void set_wheel_on_rail(int ire) {
  set_flags(ire, -1, {{CNTC_ic_config, 1}, {CNTC_ic_tang, 3}, {CNTC_ic_pvtime, 2}, {CNTC_ic_discns, 2}});
  cntc_setmaterialparameters(Int{ire}, Int{-1}, Int{0}, Int{4}, Reals{0.28, 0.28, 82000.0, 82000.0});
  cntc_setfrictionmethod(Int{ire}, Int{-1}, Int{0}, Int{2}, Reals{0.3, 0.3});
  cntc_setpotcontact(Int{ire}, Int{-1}, Int{-1}, Int{5}, Reals{0.5, 0.5, 1.5, 8.0, 4.0});
  cntc_setrollingstepsize(Int{ire}, Int{-1}, Real{0.0}, Real{1.0});
  cntc_settrackdimensions(Int{ire}, Int{3}, Int{11}, Reals{0.0, 750.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  cntc_setwheelsetdimensions(Int{ire}, Int{3}, Int{3}, Reals{1360.0, -70.0, 460.0});
  cntc_setwheelsetposition(Int{ire}, Int{2}, Int{6}, Reals{0.0, 1.0, 0.0, 0.0, 0.001, 0.0});
  cntc_setwheelsetvelocity(Int{ire}, Int{2}, Int{6}, Reals{2000.0, 0.0, 0.0, 0.0, 0.0, -4.34});
  cntc_setverticalforce(Int{ire}, Real{50000.0});
  Reals wheel, rail;
  for (int i = -60; i <= 60; ++i) {
    const double y = 0.5 * i;
    rail.insert(rail.end(), {y, 300.0 - std::sqrt(300.0 * 300.0 - y * y)});
    wheel.insert(wheel.end(), {-y, 0.025 * y});
  }
  give_points(ire, 1, wheel);
  give_points(ire, 0, rail);
}

TEST(ContactLibraryInput, CasesOfAllElementsAreWrittenAndRun) {
  Forces first, second, rolling;
  TemporaryFolder kept;
  {
    const Library library;
    for (const int icp : {1, 2}) {
      set_patch(1, icp);
      cntc_setcreepages(Int{1}, Int{icp}, Real{0.001 * icp}, Real{0.0005}, Real{1e-4});
      set_flags(1, icp, {{CNTC_if_wrtinp, 1}});
    }
    EXPECT_EQ(calculate(1, 1), 0);
    EXPECT_EQ(calculate(1, 2), 0);
    first = forces_of(1, 1), second = forces_of(1, 2);
    set_wheel_on_rail(2);
    EXPECT_EQ(calculate(2, -1), 0);  // not wanted
    set_flags(2, -1, {{CNTC_if_wrtinp, 1}});
    EXPECT_EQ(calculate(2, -1), 0);
    rolling = forces_of(2, 1);
    EXPECT_THAT(library.log(), ::testing::Not(::testing::HasSubstr(".inp file")));
    cntc_finalizelast();
    std::filesystem::copy(library.folder(), kept.path(), std::filesystem::copy_options::recursive);
  }
  const io::RunResult run = run_written(kept.path());
  ASSERT_EQ(run.cases.size(), 3u);
  for (const io::CaseResult& c : run.cases) ASSERT_EQ(c.patches.size(), 1u) << c.message;
  expect_force(run.cases[0].patches[0], first);
  expect_force(run.cases[1].patches[0], second);
  expect_force(run.cases[2].patches[0], rolling);
  EXPECT_GT(std::abs(rolling.fx), 100.0);
}

TEST(ContactLibraryInput, WhatCannotBeWrittenIsWarnedAbout) {
  const Library library;
  set_patch(1, 1);
  cntc_setcreepages(Int{1}, Int{1}, Real{0.001}, Real{0.0}, Real{0.0});
  std::filesystem::create_directory(library.folder() / "contact_addon.inp");
  set_flags(1, 1, {{CNTC_if_wrtinp, 1}});
  EXPECT_EQ(calculate(1, 1), 0);
  EXPECT_THAT(library.log(), ::testing::HasSubstr("case 1 of result element 1 is not in the .inp file"));
}

}  // namespace
}  // namespace treadmark::testing
