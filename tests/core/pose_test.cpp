// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/core/pose.hpp"

namespace treadmark {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-15;

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT((a - b).norm(), kRounding) << a.transpose() << " and " << b.transpose();
}

TEST(Rotations, TurnByTheRightHandRule) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  expect_near(rotation_x(kPi / 2) * y, z);
  expect_near(rotation_y(kPi / 2) * z, x);
  expect_near(rotation_z(kPi / 2) * x, y);
}

TEST(Rotations, PositivePitchBringsTheNegativeMaterialAngleDown) {
  const double theta = 0.649, r = 0.49;
  const Vec3 flat(r * std::sin(theta), 0.0, r * std::cos(theta));
  expect_near(rotation_y(-theta) * flat, Vec3(0, 0, r));
}

TEST(Rotations, ForwardRollingHasNegativePitchRate) {
  // the material at the lowest point of a wheel moving at V must rest: V + w x r = 0 with w = (0, pitch rate, 0)
  const double V = 2.0, R = 0.46;
  const Vec3 w(0.0, -V / R, 0.0), lowest(0.0, 0.0, R);
  expect_near(Vec3(V, 0, 0) + w.cross(lowest), Vec3::Zero());
  // and the rotation by a small negative pitch moves the lowest material backwards
  EXPECT_LT((rotation_y(-1e-3) * lowest).x(), 0.0);
}

TEST(EulerAngles, AreAppliedPitchFirstThenYawThenRoll) {
  const RollYawPitch a{0.3, -0.4, 1.1};
  const Mat3 expected = rotation_x(a.roll) * rotation_z(a.yaw) * rotation_y(a.pitch);
  EXPECT_LT((rotation(a) - expected).norm(), kRounding);
  // the order matters, and the elements that give the angles back are these
  EXPECT_NEAR(rotation(a)(0, 1), -std::sin(a.yaw), kRounding);
  EXPECT_NEAR(rotation(a)(2, 1), std::sin(a.roll) * std::cos(a.yaw), kRounding);
  EXPECT_NEAR(rotation(a)(0, 2), std::cos(a.yaw) * std::sin(a.pitch), kRounding);
}

TEST(EulerAngles, ComeBackOverTheWholeRange) {
  for (const double roll : {-3.0, -0.2, 0.0, 1.0, 2.9})
    for (const double yaw : {-1.5, -0.3, 0.0, 1.2})
      for (const double pitch : {-3.1, -1.0, 0.0, 0.4, 3.0}) {
        const RollYawPitch back = roll_yaw_pitch(rotation({roll, yaw, pitch}));
        constexpr double kNearQuarter = 1e-13;  // the sine of a yaw of 1.5 is flat
        EXPECT_NEAR(back.roll, roll, kNearQuarter);
        EXPECT_NEAR(back.yaw, yaw, kNearQuarter);
        EXPECT_NEAR(back.pitch, pitch, kNearQuarter);
      }
}

TEST(WrapAngle, GivesTheHalfOpenInterval) {
  EXPECT_EQ(wrap_angle(0.0), 0.0);
  EXPECT_EQ(wrap_angle(kPi), -kPi);
  EXPECT_EQ(wrap_angle(-kPi), -kPi);
  EXPECT_NEAR(wrap_angle(3.0 * kPi / 2.0), -kPi / 2.0, kRounding);
  EXPECT_NEAR(wrap_angle(-3.0 * kPi / 2.0), kPi / 2.0, kRounding);
  EXPECT_NEAR(wrap_angle(0.3 + 20.0 * kPi), 0.3, 1e-13);
  for (double a = -40.0; a < 40.0; a += 0.37) {
    EXPECT_GE(wrap_angle(a), -kPi);
    EXPECT_LT(wrap_angle(a), kPi);
    EXPECT_NEAR(std::sin(wrap_angle(a)), std::sin(a), 1e-13);
    EXPECT_NEAR(std::cos(wrap_angle(a)), std::cos(a), 1e-13);
  }
}

TEST(Poses, TakePointsFromTheSecondFrameToTheFirst) {
  const Pose X_AB{{1.0, 2.0, 3.0}, rotation_x(kPi / 2)};
  expect_near(X_AB.apply({0.0, 1.0, 0.0}), Vec3(1.0, 2.0, 4.0));
  expect_near(X_AB.apply_inverse({1.0, 2.0, 4.0}), Vec3(0.0, 1.0, 0.0));
}

TEST(Poses, ComposeLeftToRight) {
  const Pose X_AB{{0.4, -1.0, 0.2}, rotation({0.3, 0.2, 0.1})}, X_BC{{-0.1, 0.7, 0.9}, rotation({-1.0, 0.4, 2.0})};
  const Vec3 p_C(0.3, -0.6, 0.5);
  expect_near((X_AB * X_BC).apply(p_C), X_AB.apply(X_BC.apply(p_C)));
}

TEST(Poses, InvertOnBothSides) {
  const Pose X{{0.4, -1.0, 0.2}, rotation({0.3, 0.2, 0.1})};
  for (const Pose& identity : {X * X.inverse(), X.inverse() * X}) {
    EXPECT_LT(identity.origin.norm(), kRounding);
    EXPECT_LT((identity.rotation - Mat3::Identity()).norm(), kRounding);
  }
}

}  // namespace
}  // namespace treadmark
