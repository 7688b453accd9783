// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/driving.hpp"

#include <gtest/gtest.h>

namespace treadmark {
namespace {

/// Bogies 9 m apart with wheelbases of 1.8 m, at 3 and 5 per mille: 13.5 mm and 4.5 mm more or less.
TEST(TwistTest, LaysCrossLevelsBelowWheelsets) {
  const TwistTest test{3e-3, 5e-3, 2, 40.0};
  const double places[] = {5.4, 3.6, -3.6, -5.4}, levels[] = {18e-3, 9e-3, -9e-3, -18e-3};
  const std::vector<RailShift> shifts = twist_shifts(test, places);
  ASSERT_EQ(shifts.size(), 8u);
  for (const RailShift& shift : shifts) {
    const double level = levels[static_cast<std::size_t>(shift.wheelset.value())];
    const double most = (shift.left.value() ? -0.5 : 0.5) * level;  // z down: the left rail rises
    EXPECT_EQ(shift.direction, Freedom::z);
    EXPECT_EQ(shift.time, (std::vector<double>{-10.0, 0.0, 10.0, 30.0, 40.0, 50.0}));
    ASSERT_EQ(shift.displacement.size(), 6u);
    EXPECT_NEAR(shift.displacement[2], most, 1e-15);
    EXPECT_NEAR(shift.displacement[3], -most, 1e-15);
    for (const std::size_t rest : {0, 1, 4, 5}) EXPECT_EQ(shift.displacement[rest], 0.0);
  }
}

/// In any order, and about the middle of the axles wherever the vehicle's x = 0 is.
TEST(TwistTest, TakesSingleAxles) {
  const TwistTest test{4e-3, 9e-3, 1, 20.0};
  const double places[] = {1.0, 7.0};
  const std::vector<RailShift> shifts = twist_shifts(test, places);
  ASSERT_EQ(shifts.size(), 4u);
  for (const RailShift& shift : shifts)
    EXPECT_NEAR(shift.displacement[2], (*shift.left ? -1.0 : 1.0) * (*shift.wheelset == 0 ? -6e-3 : 6e-3), 1e-15);
}

}  // namespace
}  // namespace treadmark
