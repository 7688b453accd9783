// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/pose.hpp"

#include <cmath>
#include <numbers>

namespace treadmark {

Mat3 rotation_x(double roll) {
  const double c = std::cos(roll), s = std::sin(roll);
  Mat3 R;
  R << 1, 0, 0, 0, c, -s, 0, s, c;
  return R;
}

Mat3 rotation_y(double pitch) {
  const double c = std::cos(pitch), s = std::sin(pitch);
  Mat3 R;
  R << c, 0, s, 0, 1, 0, -s, 0, c;
  return R;
}

Mat3 rotation_z(double yaw) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  Mat3 R;
  R << c, -s, 0, s, c, 0, 0, 0, 1;
  return R;
}

Mat3 rotation(const RollYawPitch& a) { return rotation_x(a.roll) * rotation_z(a.yaw) * rotation_y(a.pitch); }

RollYawPitch roll_yaw_pitch(const Mat3& R) {
  RollYawPitch a;
  a.yaw = std::asin(std::fmin(1.0, std::fmax(-1.0, -R(0, 1))));
  a.roll = std::atan2(R(2, 1), R(1, 1));
  a.pitch = std::atan2(R(0, 2), R(0, 0));
  return a;
}

double wrap_angle(double angle) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  double wrapped = std::fmod(angle + std::numbers::pi, two_pi);
  if (wrapped < 0.0) wrapped += two_pi;
  return wrapped - std::numbers::pi;
}

}  // namespace treadmark
