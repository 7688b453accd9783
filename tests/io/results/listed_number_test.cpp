// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/io/results/listed_number.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::error_of;

CaseResult two_patches() {
  CaseResult c;
  c.has_wheelset = true;
  c.z = 2e-3;
  c.force_tr = {1.0, 2.0, 3e4};
  c.patches.resize(2);
  c.patches[0].fn = 1e4, c.patches[0].pmax = 8e8, c.patches[0].xi = 1e-3;
  c.patches[1].fn = 2e4, c.patches[1].pmax = 6e8, c.patches[1].xi = 2e-3;
  return c;
}

TEST(ListedNumber, IsOfTheCaseOfThePatchWithMostLoadOrOfOne) {
  const CaseResult c = two_patches();
  EXPECT_EQ(listed_number("wheelset.z_mm").si(c), 2e-3);
  EXPECT_EQ(listed_number("force_on_rail.fz_tr_N").si(c), 3e4);
  EXPECT_EQ(listed_number("npatch").si(c), 2.0);
  EXPECT_EQ(listed_number("pmax_MPa").si(c), 6e8);
  EXPECT_EQ(listed_number("patch_1.pmax_MPa").si(c), 8e8);
  EXPECT_EQ(listed_number("patch_2.pmax_MPa").si(c), 6e8);
  EXPECT_TRUE(std::isnan(listed_number("patch_3.pmax_MPa").si(c)));
  EXPECT_TRUE(std::isnan(listed_number("pmax_MPa").si(CaseResult{})));
  EXPECT_TRUE(std::isnan(listed_number("wheelset.z_mm").si(CaseResult{})));
  EXPECT_TRUE(std::isnan(listed_number("roller.pitch_rate_rad_s").si(c)));
}

TEST(ListedNumber, CountsPatchesWhereTheyAreKnown) {
  CaseResult c;
  c.status = Status::no_contact;
  EXPECT_EQ(listed_number("npatch").si(c), 0.0);
  c.status = Status::failed;
  EXPECT_TRUE(std::isnan(listed_number("npatch").si(c)));
  c.patches.resize(2);
  EXPECT_EQ(listed_number("npatch").si(c), 2.0);
  c = {};
  c.shown = false;
  EXPECT_TRUE(std::isnan(listed_number("npatch").si(c)));
}

TEST(ListedNumber, HasTheUnitOfItsName) {
  const ListedNumber pressure = listed_number("patch_2.pmax_MPa");
  EXPECT_EQ(pressure.name, "patch_2.pmax_MPa");
  EXPECT_EQ(pressure.si_name, "patch_2.pmax");
  EXPECT_EQ(pressure.unit(), "Pa");
  EXPECT_DOUBLE_EQ(pressure.in_file(6e8, false), 600.0);
  EXPECT_EQ(listed_number("patch_2.pmax", Names::si).name, pressure.name);
  EXPECT_EQ(listed_number("npatch", Names::si).unit(), "1");
  const ListedNumber creepage = listed_number("kinematics.xi");
  EXPECT_DOUBLE_EQ(creepage.in_file(1e-3, false), 1e-3);
  EXPECT_DOUBLE_EQ(creepage.in_file(1e-3, true), 1.0);  // a shift [mm]
}

TEST(ListedNumber, RefusesOtherNames) {
  EXPECT_THAT(error_of([] { listed_number("pmax"); }), HasSubstr("'pmax'"));
  EXPECT_THAT(error_of([] { listed_number("pmax_MPa", Names::si); }), HasSubstr("'pmax_MPa'"));
  EXPECT_THAT(error_of([] { listed_number("patch_0.pmax_MPa"); }), HasSubstr("patch_0"));
  EXPECT_THAT(error_of([] { listed_number("patch_x.pmax_MPa"); }), HasSubstr("patch_x"));
  EXPECT_THAT(error_of([] { listed_number("patch_2.wheelset.z_mm"); }), HasSubstr("wheelset.z_mm"));
}

TEST(ListedNumber, UsualOnesAreThereForBothKinds) {
  EXPECT_GT(usual_numbers(true).size(), usual_numbers(false).size());
  for (const ListedNumber& one : usual_numbers(false)) {
    EXPECT_FALSE(one.name.starts_with("wheelset.")) << one.name;
    EXPECT_FALSE(one.name.starts_with("reference.")) << one.name;
  }
}

}  // namespace
}  // namespace treadmark::io
