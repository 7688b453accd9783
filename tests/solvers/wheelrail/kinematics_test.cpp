// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {
namespace {

Placement straight(double radius) {
  Placement placed;
  placed.X_TR.origin = {0.0, 0.75, 0.0};
  placed.X_TWs.origin = {0.0, 0.0, -radius};
  placed.X_TW.origin = {0.0, 0.75, 0.0};
  placed.X_TA.origin = {0.0, 0.75, -radius};
  return placed;
}

TEST(Kinematics, PureRollingHasNoCreepage) {
  Problem p;
  p.state.velocity.x = 20.0;
  p.state.velocity.pitch = -20.0 / 0.46;
  const ContactKinematics k = contact_kinematics(p, straight(0.46), {{0.0, 0.75, 0.0}, Mat3::Identity()}, 0.0);
  EXPECT_NEAR(k.xi, 0.0, 1e-15);
  EXPECT_NEAR(k.eta, 0.0, 1e-15);
  EXPECT_NEAR(k.phi, 0.0, 1e-15);
  EXPECT_NEAR(k.velocity, 20.0, 1e-12);
  EXPECT_EQ(k.chi, 0.0);
}

// A wheel that turns too slowly drags the rail forward: creepage rail minus wheel is negative.
TEST(Kinematics, BrakedWheelHasNegativeCreepage) {
  Problem p;
  p.state.velocity.x = 2.0;
  p.state.velocity.pitch = -4.08190679;
  // Rolling radius at the contact: nominal 490 - 0.3448 mm, plus 0.1082 mm of penetration.
  const double radius = 0.49 - 0.3448e-3;
  const ContactKinematics k = contact_kinematics(p, straight(radius), {{0.0, 0.75, 0.0}, Mat3::Identity()}, 0.1082e-3);
  EXPECT_NEAR(k.xi, -4.157e-4, 2e-7);  // radii are given to 0.1 um of 490 mm, the creepage to four digits
  EXPECT_NEAR(k.velocity, 1.99958, 1e-5);
}

TEST(Kinematics, BackwardRollingTurnsTheDirection) {
  Problem p;
  p.state.velocity.x = -3.0;
  p.state.velocity.pitch = 3.0 / 0.46;
  const ContactKinematics k = contact_kinematics(p, straight(0.46), {{0.0, 0.75, 0.0}, Mat3::Identity()}, 0.0);
  EXPECT_NEAR(k.chi, std::numbers::pi, 1e-15);
  EXPECT_NEAR(k.velocity, 3.0, 1e-12);
}

// Yaw to the right (positive) moves the wheel's rolling direction to +y: the wheel slides to -y against it, rail minus
// wheel > 0.
TEST(Kinematics, YawGivesLateralCreepageAndContactAngleGivesSpin) {
  Problem p;
  p.state.velocity.x = 20.0;
  p.state.velocity.pitch = -20.0 / 0.46;
  Placement placed = straight(0.46);
  const double yaw = 4e-3, angle = 0.05;
  placed.X_TWs.rotation = rotation_z(yaw);
  const ContactKinematics flat = contact_kinematics(p, placed, {{0.0, 0.75, 0.0}, Mat3::Identity()}, 0.0);
  EXPECT_NEAR(flat.eta, yaw, 1e-5);
  const ContactKinematics conical = contact_kinematics(p, straight(0.46), {{0.0, 0.75, 0.0}, rotation_x(angle)}, 0.0);
  EXPECT_NEAR(conical.phi, -std::sin(angle) / 0.46, 1e-12) << "n.omega of the wheel is sin(angle) V/r";
}

TEST(Kinematics, CurvedTrackSpinsTheRail) {
  Problem p;
  p.track.curvature = 1.0 / 300.0;
  p.state.velocity.x = 20.0;
  p.state.velocity.pitch = -20.0 / 0.46;
  const ContactKinematics k = contact_kinematics(p, straight(0.46), {{0.0, 0.75, 0.0}, Mat3::Identity()}, 0.0);
  const double rail_x = 20.0 / 300.0 * 0.75;  // rail seen from the turning track frame
  EXPECT_NEAR(k.xi, rail_x / k.velocity, 1e-12);
  EXPECT_NEAR(k.phi, -20.0 / 300.0 / k.velocity, 1e-12);
}

TEST(Kinematics, StandingWheelHasNone) {
  const ContactKinematics k = contact_kinematics({}, straight(0.46), {{0.0, 0.75, 0.0}, Mat3::Identity()}, 0.0);
  EXPECT_EQ(k.velocity, 0.0);
  EXPECT_EQ(k.xi, 0.0);
}

// A wheel that stands has no creepage. One that slides without rolling has none that could be told, and not no force.
TEST(Kinematics, SlidingWithoutRollingIsRefused) {
  const Pose X_TC{{0.0, 0.75, 0.0}, Mat3::Identity()};
  for (const kalker::Regime regime : {kalker::Regime::steady, kalker::Regime::transient}) {
    Problem p;
    p.regime = regime;
    const ContactKinematics standing = contact_kinematics(p, straight(0.46), X_TC, 0.0);
    EXPECT_EQ(std::hypot(standing.xi, standing.eta, standing.phi), 0.0);
    p.state.velocity.z = 0.1;  // normal to the contact: no sliding
    EXPECT_NO_THROW(contact_kinematics(p, straight(0.46), X_TC, 0.0));
    p.state.velocity.y = 1e-6;
    EXPECT_THROW(contact_kinematics(p, straight(0.46), X_TC, 0.0), Error);
    p.state.velocity.x = 1e-3;  // it rolls, however much it slides
    p.state.velocity.pitch = -1e-3 / 0.46;
    EXPECT_NEAR(contact_kinematics(p, straight(0.46), X_TC, 0.0).eta, -1e-3, 1e-12);
    p = {};
    p.state.velocity.y = 0.1;
    p.regime = kalker::Regime::frictionless;
    EXPECT_NO_THROW(contact_kinematics(p, straight(0.46), X_TC, 0.0));
    p.regime = kalker::Regime::shift;
    EXPECT_NEAR(contact_kinematics(p, straight(0.46), X_TC, 0.0).eta, -0.1, 1e-12);
  }
}

}  // namespace
}  // namespace treadmark::wheelrail
