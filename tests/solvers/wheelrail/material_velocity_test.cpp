// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/kinematics.hpp"

#include <gtest/gtest.h>

namespace treadmark::wheelrail {
namespace {

Placement somewhere() {
  Placement placed;
  placed.X_TR = {{0.0, 0.76, 1e-3}, rotation_x(-0.025)};
  placed.X_TWs = {{0.0, 2e-3, -0.46}, rotation_x(1e-3) * rotation_z(8e-3)};
  placed.X_TW = placed.X_TWs * Pose{{1e-4, 0.75, 0.46}, rotation_x(2e-3) * rotation_z(-1e-3)};
  return placed;
}

Problem everything_moves() {
  Problem p;
  p.track.curvature = 2e-3;
  p.track.vy = 0.01;
  p.track.vz = -0.02;
  p.track.vroll = 0.03;
  p.state.velocity = {20.0, 0.05, 0.02, 0.1, 0.2, -43.0};
  p.state.wheel_velocity = {0.03, -0.04, 0.01, 0.02, -0.05, 0.3};
  return p;
}

TEST(MaterialVelocity, GivesTheCreepagesOfAPoint) {
  const Problem p = everything_moves();
  const Placement placed = somewhere();
  const Pose X_TC{{3e-3, 0.74, 2e-3}, rotation_x(-0.2)};
  const double approach = 40e-6;
  const ContactKinematics k = contact_kinematics(p, placed, X_TC, approach);
  const MaterialVelocity m = material_velocity(p, placed);
  const Vec3 slip = X_TC.rotation.transpose() * (m.rail.at(X_TC.origin) - m.wheel.at(X_TC.apply({0.0, 0.0, approach})));
  EXPECT_NEAR(slip.x() / k.velocity, k.xi, 1e-14);
  EXPECT_NEAR(slip.y() / k.velocity, k.eta, 1e-14);
  EXPECT_NEAR(X_TC.rotation.col(2).dot(m.rotation_difference()) / k.velocity, k.phi, 1e-12);
}

TEST(MaterialVelocity, ARollerMovesBackwardBelowAStandingWheelset) {
  Problem p;
  p.roller = Roller{0.5, 4.0};
  p.state.velocity.pitch = -4.0 * 0.5 / 0.46;
  const Placement placed = somewhere();
  const Vec3 top(0.0, placed.X_TR.origin.y(), placed.X_TR.origin.z());
  const MaterialVelocity m = material_velocity(p, placed);
  EXPECT_NEAR(m.rail.at(top).x(), -2.0, 1e-12);
  EXPECT_NEAR(m.rail.at(top + 1e-3 * placed.X_TR.rotation.col(2)).x(), -2.0 + 4e-3, 1e-12) << "nearer to its own axle";
}

TEST(MaterialVelocity, ACurveTurnsRailAndRollerAlike) {
  Problem rail = everything_moves(), roller = rail;
  roller.roller = Roller{0.5, rail.state.velocity.x / 0.5};
  const Placement placed = somewhere();
  const Vec3 top = placed.X_TR.origin;
  const Vec3 travel(rail.state.velocity.x, 0.0, 0.0);
  const Vec3 of_rail = material_velocity(rail, placed).rail.at(top),
             of_roller = material_velocity(roller, placed).rail.at(top);
  EXPECT_NEAR(of_roller.x() + travel.x(), of_rail.x(), 1e-12);
}

}  // namespace
}  // namespace treadmark::wheelrail
