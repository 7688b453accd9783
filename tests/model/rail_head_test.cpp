// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/rail_head.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/core/constants.hpp"

namespace treadmark {
namespace {

/// A head of 70 mm about y = 0, a groove to one side of it, and a keeper or check rail whose top is at z = keeper.
struct Grooved {
  std::vector<double> y, z;
  Grooved(double keeper, double side, double width = 20e-3) {
    for (int k = -1400; k <= 1400; ++k) {
      y.push_back(1e-4 * k);
      const double at = side * y.back(), up = std::fabs(at) < 35e-3 ? at * at / 0.6 : 40e-3;
      z.push_back(at > 70e-3 && at < 70e-3 + width ? keeper : up);
    }
  }
};

TEST(RailHead, IsTheWiderPieceWhereverTheKeeperIs) {
  for (const double side : {1.0, -1.0})
    for (const double keeper : {-25e-3, -15e-3, -12e-3, -2e-3, 0.0, 3e-3, 13e-3, 30e-3}) {
      const Grooved s(keeper, side);
      const auto head = head_of_rail(s.y, s.z, 14e-3);
      ASSERT_TRUE(head);
      EXPECT_NEAR(s.y[head->first], -35e-3, 2e-4) << keeper << ' ' << side;
      EXPECT_NEAR(s.y[head->last], 35e-3, 2e-4);
      EXPECT_NEAR(s.y[head->top], 0.0, 1e-9);
      EXPECT_EQ(head->z_top, s.z[head->top]);
    }
}

TEST(RailHead, AWideCheckRailIsNoHead) {
  for (const double side : {1.0, -1.0})
    for (const double width : {36e-3, 60e-3})
      for (const double keeper : {-25e-3, -20e-3, -15e-3, -5e-3, 0.0, 10e-3}) {
        const Grooved s(keeper, side, width);
        const auto head = head_of_rail(s.y, s.z, 14e-3);
        ASSERT_TRUE(head);
        EXPECT_NEAR(s.y[head->first], -35e-3, 2e-4) << keeper << ' ' << side << ' ' << width;
        EXPECT_NEAR(s.y[head->last], 35e-3, 2e-4);
        EXPECT_NEAR(s.z[head->top], 0.0, 1e-9);
      }
}

TEST(RailHead, TheInnermostPieceIsToldFromTheTopOfAll) {
  const Grooved s(-2e-3, -1.0);
  const auto head = head_of_rail(s.y, s.z, 14e-3, true);
  ASSERT_TRUE(head);
  EXPECT_NEAR(s.y[head->first], -90e-3, 2e-4);
  EXPECT_EQ(head->z_top, -2e-3);
}

TEST(RailHead, HolesEndNothing) {
  Grooved s(0.0, 1.0);
  for (std::size_t i = 1500; i < 1530; ++i) s.z[i] = kNaN;
  s.z.front() = s.z.back() = kNaN;
  const auto head = head_of_rail(s.y, s.z, 14e-3);
  ASSERT_TRUE(head);
  EXPECT_NEAR(s.y[head->first], -35e-3, 2e-4);
  EXPECT_NEAR(s.y[head->last], 35e-3, 2e-4);
  EXPECT_FALSE(head_of_rail({}, {}, 14e-3));
  const std::vector<double> none(3, kNaN), y{0.0, 1.0, 2.0};
  EXPECT_FALSE(head_of_rail(y, none, 14e-3));
}

TEST(RailHead, KnowsItsTopAsWellAsTheCaller) {
  const Grooved s(-5e-3, 1.0);
  const auto head = head_of_rail(s.y, s.z, 1e-3, false, [&](std::size_t i) { return s.z[i] - 1e-6; });
  ASSERT_TRUE(head);
  EXPECT_EQ(head->z_top, s.z[head->top] - 1e-6);
  EXPECT_LE(s.z[head->first] - head->z_top, 1e-3);
  EXPECT_GT(s.z[head->first - 1] - head->z_top, 1e-3);
}

}  // namespace
}  // namespace treadmark
