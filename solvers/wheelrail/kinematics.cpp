// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/kinematics.hpp"

#include <cmath>
#include <numbers>

namespace treadmark::wheelrail {

ContactKinematics contact_kinematics(const Problem& p, const Placement& placed, const Pose& X_TC, double approach) {
  const Track& t = p.track;
  const SixMotion& v = p.state.velocity;
  const SixMotion& dv = p.state.wheel_velocity;

  // Rail material at the contact reference; the rail turns with the track curve that the wheelset runs through.
  const double yaw_rate = -v.x * t.curvature;
  const Vec3 omega_rail(t.vroll, 0.0, yaw_rate);
  const Vec3 origin_velocity_rail(-yaw_rate * placed.X_TR.origin.y(), t.vy, t.vz);
  const Vec3 arm_rail = X_TC.origin - placed.X_TR.origin;
  const Vec3 v_rail = origin_velocity_rail + omega_rail.cross(arm_rail);

  // Wheel material at the depth of the rigid penetration.
  const Mat3& R_ws = placed.X_TWs.rotation;
  const Vec3 q_T = X_TC.apply({0.0, 0.0, approach});
  const Vec3 arm_wheelset = q_T - placed.X_TWs.origin;
  const Vec3 arm_wheel = q_T - placed.X_TW.origin;
  const Vec3 omega_wheelset = R_ws * Vec3(v.roll, v.pitch, v.yaw);
  const Vec3 omega_flexible = R_ws * Vec3(dv.roll, dv.pitch, dv.yaw);
  const Vec3 v_wheel = Vec3(v.x, v.y, v.z) + omega_wheelset.cross(arm_wheelset) + R_ws * Vec3(dv.x, dv.y, dv.z) +
                       omega_flexible.cross(arm_wheel);
  const Vec3 v_pitch = (R_ws * Vec3(0.0, v.pitch, 0.0)).cross(arm_wheelset);

  ContactKinematics k;
  const double travel = v_wheel.x() - v_rail.x() - v_pitch.x();
  const bool travel_decides = std::abs(travel) >= std::abs(v_pitch.x());
  const bool forward = travel_decides ? travel >= 0.0 : v_pitch.x() <= 0.0;
  k.chi = forward ? 0.0 : std::numbers::pi;
  k.velocity = 0.5 * (std::abs(travel) + std::abs(v_pitch.x()));
  constexpr double kStanding = 1e-9;
  if (k.velocity < kStanding) return k;
  const Vec3 slip = X_TC.rotation.transpose() * (v_rail - v_wheel) / k.velocity;
  const Vec3 rotation_difference = omega_rail - omega_wheelset - omega_flexible;
  k.xi = slip.x();
  k.eta = slip.y();
  k.phi = X_TC.rotation.col(2).dot(rotation_difference) / k.velocity;
  return k;
}

}  // namespace treadmark::wheelrail
