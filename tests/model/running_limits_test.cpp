// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/running_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace treadmark {
namespace {

LimitInput input(VehicleKind vehicle, double load, double speed) {
  LimitInput in;
  in.vehicle = vehicle;
  in.load = load;
  in.speed = speed;
  return in;
}

TEST(RunningLimits, UsualOnesAreThoseByHand) {
  const LimitInput in = input(VehicleKind::passenger, 120e3, 20.0), wagon = input(VehicleKind::freight, 120e3, 20.0);
  const auto limit = [&](const char* quantity) { return limit_of(usual_limits(), quantity, in); };
  EXPECT_NEAR(limit("Q"), 150e3, 1e-6);
  EXPECT_NEAR(limit("sumY_2m"), 50e3, 1e-6);
  EXPECT_NEAR(limit("sumY_rms"), 25e3, 1e-6);
  EXPECT_NEAR(limit_of(usual_limits(), "sumY_rms", wagon), 0.85 * 25e3, 1e-6);
  EXPECT_DOUBLE_EQ(limit("ay_ride"), 2.5);
  EXPECT_TRUE(std::isnan(limit_of(usual_limits(), "ay_ride", wagon)));
  EXPECT_TRUE(std::isnan(limit("Tgamma")));
  EXPECT_FALSE(usual_limits().verified);
}

TEST(RunningLimits, TheLeastOfThoseThatHoldCounts) {
  RunningLimits limits{"made up", true, {}};
  limits.limits.push_back({.quantity = "Y_qst", .section = SectionKind::curve, .constant = 60e3});
  limits.limits.push_back(
      {.quantity = "Y_qst", .from_radius = 250.0, .to_radius = 1000.0, .constant = 30e3, .by_curvature = 10.5e6});
  LimitInput in;
  in.section = SectionKind::curve;
  const auto at = [&](double radius) {
    in.radius = radius;
    return limit_of(limits, "Y_qst", in);
  };
  EXPECT_DOUBLE_EQ(at(500.0), 51e3);
  EXPECT_DOUBLE_EQ(at(300.0), 60e3);  // 30 + 35 kN
  EXPECT_DOUBLE_EQ(at(250.0), 60e3);
  EXPECT_DOUBLE_EQ(at(999.0), 30e3 + 10.5e6 / 999.0);
  EXPECT_DOUBLE_EQ(at(1000.0), 60e3);
  EXPECT_DOUBLE_EQ(at(kInfinity), 60e3);
  EXPECT_DOUBLE_EQ(at(kNaN), 60e3);  // a radius that is not known is in no range
  in.section = SectionKind::straight;
  EXPECT_TRUE(std::isnan(at(kInfinity)));
  EXPECT_DOUBLE_EQ(at(500.0), 51e3);
}

TEST(RunningLimits, WhatIsNotKnownGivesNone) {
  const RunningLimits limits{"made up",
                             true,
                             {{.quantity = "a", .constant = 1.0, .by_load = 2.0},
                              {.quantity = "a", .constant = 5.0},
                              {.quantity = "b", .above_speed = 10.0, .constant = 3.0}}};
  LimitInput in;
  EXPECT_TRUE(std::isnan(limit_of(limits, "a", in)));
  in.load = 1.0;
  EXPECT_DOUBLE_EQ(limit_of(limits, "a", in), 3.0);
  EXPECT_TRUE(std::isnan(limit_of(limits, "b", in)));
  in.speed = 10.0;
  EXPECT_TRUE(std::isnan(limit_of(limits, "b", in)));
  in.speed = 11.0;
  EXPECT_DOUBLE_EQ(limit_of(limits, "b", in), 3.0);
}

}  // namespace
}  // namespace treadmark
