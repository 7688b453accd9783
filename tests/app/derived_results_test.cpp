// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/wheelrail_result.hpp"

#include <gtest/gtest.h>

namespace treadmark::app {
namespace {

/// Exterior, adhesion and slip; values by hand.
io::PatchResult three_elements() {
  io::PatchResult patch;
  patch.velocity = 20.0;
  patch.fields.grid = {0.0, 0.0, 1e-3, 1e-3, 3, 1};
  patch.fields.state = {0, 1, 2};
  patch.fields.traction_x = {0.0, 1e8, 3e8};
  patch.fields.traction_s = {0.0, 1e8, -1e8};
  patch.fields.slip_x = {1e-3, 0.0, -2e-3};
  patch.fields.slip_s = {1e-3, 0.0, 1e-3};
  return patch;
}

TEST(Dissipation, IsTractionTimesSpeedOfSlip) {
  io::PatchResult patch = three_elements();
  add_dissipation(patch);
  // 20 m/s (3e8 Pa 2e-3 + 1e8 Pa 1e-3) = 1.4e7 W/m^2
  EXPECT_EQ(patch.fields.dissipation.size(), 3u);
  EXPECT_EQ(patch.fields.dissipation[0], 0.0);
  EXPECT_EQ(patch.fields.dissipation[1], 0.0);
  EXPECT_NEAR(patch.fields.dissipation[2], 1.4e7, 1e-6);
}

TEST(Dissipation, OfAShiftIsWork) {
  io::PatchResult patch = three_elements();
  patch.shift = true;
  add_dissipation(patch);
  EXPECT_NEAR(patch.fields.dissipation[2], 7e5, 1e-7);
}

TEST(Dissipation, NeedsTractionsAndNoPlasticLayer) {
  io::PatchResult none, plastic = three_elements();
  plastic.fields.yield_stress = {1e8, 1e8, 1e8};
  add_dissipation(none);
  add_dissipation(plastic);
  EXPECT_TRUE(none.fields.dissipation.empty());
  EXPECT_TRUE(plastic.fields.dissipation.empty());
}

}  // namespace
}  // namespace treadmark::app
