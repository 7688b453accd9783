// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/check_rail.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hertz_spring.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/vehicle/multibody.hpp"

namespace treadmark::vehicle {
namespace {

using wheelrail::Side;

constexpr double kBack = 0.68, kCheckRadius = 0.46, kSpeed = 20.0;

class CheckRailTest : public ::testing::Test {
 protected:
  CheckRail rail{.from = 1.0,
                 .to = 3.0,
                 .face_y = 0.678,
                 .depth = 0.01,
                 .stiffness = 5e7,
                 .damping = 2e4,
                 .friction = 0.3,
                 .flare_length = 0.5,
                 .flare = 0.03};
  ContactWithCheckRail element(Side side = Side::right) const {
    const double y = side == Side::right ? 0.75 : -0.75;
    return {std::make_shared<HertzSpring>(1e11, y), side, rail, {kBack, kCheckRadius, 0.5}, {0.0, y, 0.1}};
  }
  /// So far to the left that the back of the right flange is 3 mm within the face.
  static PairMotion pushed(double x = 1.5) {
    PairMotion m;
    m.wheelset.x = x;
    m.wheelset.y = -5e-3;
    m.wheelset.z = 1e-4;
    m.wheelset.roll = 2e-4;
    m.rail = {1e-4, 2e-5, 3e-4, 0.02, -0.01, 0.05};
    m.wheelset_velocity = {kSpeed, -0.05, 0.01, 0.02, 0.03, -kSpeed / kCheckRadius};
    return m;
  }
};

double power_of(const ContactReaction& r, const PairMotion& m) {
  const PairVector f = generalised_force(r, m);
  const auto& v = m.wheelset_velocity;
  const PairVector rates{{v.x, v.y, v.z, v.roll, v.pitch, v.yaw, m.rail.vy, m.rail.vz, m.rail.vroll}};
  return f.dot(rates);
}

TEST_F(CheckRailTest, HoldsTheFlangeAlongItsStretchOnly) {
  ContactWithCheckRail held = element();
  HertzSpring free(1e11, 0.75);
  const ContactReaction r = held.evaluate(pushed()), without = free.evaluate(pushed());
  // By hand: 0.678 + 1e-4 + 3e-4 * 0.09 - (0.68 - 5e-3 - 2e-4 * 0.47).
  const double depth = 0.678 + 1e-4 + 3e-4 * 0.09 - (0.68 - 5e-3 - 2e-4 * 0.47);
  rail.damping = rail.friction = 0.0;
  const ContactReaction spring = element().evaluate(pushed());
  EXPECT_NEAR(spring.check_force, 5e7 * depth, 1e-6 * 5e7 * depth);
  EXPECT_NEAR(spring.on_wheelset.force.y(), without.on_wheelset.force.y() + spring.check_force, 1e-6);
  EXPECT_EQ(r.normal_force, without.normal_force);
  for (const double x : {0.49, 2.51, 100.0}) {
    EXPECT_EQ(held.evaluate(pushed(x)).check_force, 0.0) << x;
    EXPECT_EQ(held.evaluate(pushed(x)).on_wheelset.force, free.evaluate(pushed(x)).on_wheelset.force);
  }
  PairMotion right = pushed();
  right.wheelset.y = 0.0;
  EXPECT_EQ(held.evaluate(right).check_force, 0.0);
}

TEST_F(CheckRailTest, SidesAreMirrorImages) {
  PairMotion m = pushed(0.9), mirrored = m;
  for (wheelrail::SixMotion* q : {&mirrored.wheelset, &mirrored.wheelset_velocity})
    q->y = -q->y, q->roll = -q->roll, q->yaw = -q->yaw;
  for (double* value : {&mirrored.rail.y, &mirrored.rail.roll, &mirrored.rail.vy, &mirrored.rail.vroll})
    *value = -*value;
  const ContactReaction r = element().evaluate(m), l = element(Side::left).evaluate(mirrored);
  ASSERT_GT(r.check_force, 1e4);
  EXPECT_DOUBLE_EQ(r.check_force, l.check_force);
  EXPECT_DOUBLE_EQ(r.on_wheelset.force.y(), -l.on_wheelset.force.y());
  EXPECT_DOUBLE_EQ(r.on_wheelset.force.x(), l.on_wheelset.force.x());
  EXPECT_DOUBLE_EQ(r.on_wheelset.moment.x(), -l.on_wheelset.moment.x());
  EXPECT_DOUBLE_EQ(r.on_wheelset.moment.z(), -l.on_wheelset.moment.z());
  EXPECT_DOUBLE_EQ(r.on_rail.moment.x(), -l.on_rail.moment.x());
}

/// What the forces take from the motion is stored or dissipated, in the flare too.
TEST_F(CheckRailTest, PowerIsThatOfEnergyAndDissipation) {
  for (const double x : {0.9, 1.5, 2.1}) {
    SCOPED_TRACE(x);
    ContactWithCheckRail held = element();
    const PairMotion m = pushed(x);
    const ContactReaction r = held.evaluate(m);
    ASSERT_GT(r.check_force, 0.0);
    constexpr double kStep = 1e-7;  // [s]
    const auto energy_after = [&](double t) {
      PairMotion moved = m;
      auto& q = moved.wheelset;
      const auto& v = m.wheelset_velocity;
      q.x += v.x * t, q.y += v.y * t, q.z += v.z * t, q.roll += v.roll * t, q.yaw += v.yaw * t;
      moved.rail.y += m.rail.vy * t, moved.rail.z += m.rail.vz * t, moved.rail.roll += m.rail.vroll * t;
      return held.evaluate(moved).elastic_energy;
    };
    const double stored = (energy_after(kStep) - energy_after(-kStep)) / (2.0 * kStep);
    EXPECT_GT(r.frictional_power, 1.0);
    EXPECT_NEAR(-power_of(r, m), stored + r.frictional_power, 1e-3 * (std::abs(stored) + r.frictional_power));
  }
}

TEST_F(CheckRailTest, WhatMakesNoSenseIsRefused) {
  rail.flare_length = 1.1;
  EXPECT_THROW(element(), Error);
  rail.flare_length = 0.5, rail.stiffness = 0.0;
  EXPECT_THROW(element(), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
