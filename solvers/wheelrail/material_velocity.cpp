// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/material_velocity.hpp"

namespace treadmark::wheelrail {
namespace {

RigidMotion rail_motion(const Problem& p, const Placement& placed) {
  const Track& t = p.track;
  const Vec3 irregularity(0.0, t.vy, t.vz);
  if (p.roller) {
    // A curve turns the roller like a rail that passes at its surface speed.
    const double yaw_rate = -p.roller->nominal_radius * p.roller->pitch_rate * t.curvature;
    const Vec3 axle(placed.X_TR.origin.x(), 0.0, placed.X_TR.origin.z() + p.roller->nominal_radius);
    return {axle, irregularity, {t.vroll, p.roller->pitch_rate, yaw_rate}};
  }
  const double yaw_rate = -p.state.velocity.x * t.curvature;
  const Vec3& origin = placed.X_TR.origin;
  return {origin, Vec3(-yaw_rate * origin.y(), 0.0, 0.0) + irregularity, {t.vroll, 0.0, yaw_rate}};
}

}  // namespace

MaterialVelocity material_velocity(const Problem& p, const Placement& placed) {
  const SixMotion& v = p.state.velocity;
  const SixMotion& dv = p.state.wheel_velocity;
  const Mat3& R_TWs = placed.X_TWs.rotation;
  const Vec3& axle = placed.X_TWs.origin;
  const Vec3 flexible = R_TWs * Vec3(dv.roll, dv.pitch, dv.yaw);

  MaterialVelocity m;
  m.rail = rail_motion(p, placed);
  m.wheel.point = m.pitch.point = axle;
  m.wheel.angular_velocity = R_TWs * Vec3(v.roll, v.pitch, v.yaw) + flexible;
  m.wheel.velocity = Vec3(v.x, v.y, v.z) + R_TWs * Vec3(dv.x, dv.y, dv.z) + flexible.cross(axle - placed.X_TW.origin);
  m.pitch.angular_velocity = R_TWs * Vec3(0.0, v.pitch, 0.0);
  return m;
}

}  // namespace treadmark::wheelrail
