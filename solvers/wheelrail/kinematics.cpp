// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/wheelrail/kinematics.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {

ContactKinematics contact_kinematics(const Problem& p, const Placement& placed, const Pose& X_TC, double approach) {
  const MaterialVelocity material = material_velocity(p, placed);
  // Wheel material at the depth of the rigid penetration.
  const Vec3 point_rail = X_TC.origin, point_wheel = X_TC.apply({0.0, 0.0, approach});
  const Vec3 v_rail = material.rail.at(point_rail), v_wheel = material.wheel.at(point_wheel);
  const Mat3 R_CT = X_TC.rotation.transpose();

  ContactKinematics k;
  if (p.regime == kalker::Regime::shift) {
    k.velocity = 1.0;
  } else if (p.roller) {
    // Both surfaces run backwards below a wheel that rolls forward.
    const double running = 0.5 * (R_CT * (v_rail + v_wheel)).x();
    k.velocity = std::abs(running);
    k.chi = running <= 0.0 ? 0.0 : std::numbers::pi;
  } else {
    const double by_pitch = material.pitch.at(point_wheel).x();
    const double travel = v_wheel.x() - v_rail.x() - by_pitch;
    const bool forward = std::abs(travel) >= std::abs(by_pitch) ? travel >= 0.0 : by_pitch <= 0.0;
    k.chi = forward ? 0.0 : std::numbers::pi;
    k.velocity = 0.5 * (std::abs(travel) + std::abs(by_pitch));
  }
  constexpr double kStanding = 1e-9;
  const Vec3 sliding = R_CT * (v_rail - v_wheel);
  if (k.velocity < kStanding) {
    // Without rolling there is no creepage, and friction would vanish.
    const double speed = std::hypot(sliding.x(), sliding.y());
    if (speed >= kStanding && p.regime != kalker::Regime::frictionless)
      throw Error(
          ErrorKind::numerical,
          fmt::format("the wheel slides at {:.3g} mm/s and does not roll: there are no creepages without rolling",
                      kMilli * speed),
          {}, "give a velocity, or take a shift");
    return k;
  }
  const Vec3 slip = sliding / k.velocity;
  k.xi = slip.x();
  k.eta = slip.y();
  k.phi = X_TC.rotation.col(2).dot(material.rotation_difference()) / k.velocity;
  return k;
}

namespace {

RigidMotion rail_motion(const Problem& p, const Placement& placed) {
  const Track& t = p.track;
  const auto& [origin, rotation] = placed.X_TR;
  const Vec3 irregularity(0.0, t.vy, t.vz), rolling(t.vroll, 0.0, 0.0);
  if (p.roller) {
    // It turns about its own axle, which moves and tilts with it; a curve turns it like a rail that passes at its
    // speed.
    const double yaw_rate = -p.roller->nominal_radius * p.roller->pitch_rate * t.curvature;
    const Vec3 axle = origin + p.roller->nominal_radius * rotation.col(2);
    return {axle, Vec3(-yaw_rate * axle.y(), 0.0, 0.0) + irregularity + rolling.cross(axle - origin),
            rolling + p.roller->pitch_rate * rotation.col(1) + Vec3(0.0, 0.0, yaw_rate)};
  }
  const double yaw_rate = -p.state.velocity.x * t.curvature;
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
