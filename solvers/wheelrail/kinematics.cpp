// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/kinematics.hpp"

#include <cmath>
#include <numbers>

namespace treadmark::wheelrail {

MaterialMotion::MaterialMotion(const Problem& p, const Placement& placed) {
  const Track& t = p.track;
  const SixMotion& v = p.state.velocity;
  const SixMotion& dv = p.state.wheel_velocity;

  rail_.origin = placed.X_TR.origin;
  if (p.roller) {
    roller_ = true;
    roller_axle_ = placed.X_TR.apply({0.0, 0.0, p.roller->nominal_radius});
    roller_rate_ = p.roller->pitch_rate;
    track_curvature_ = t.curvature;
    rail_.velocity = {0.0, t.vy, t.vz};
    rail_.rotation = {t.vroll, 0.0, 0.0};
  } else {
    // The rail turns with the track curve that the wheelset runs through.
    const double yaw_rate = -v.x * t.curvature;
    rail_.velocity = {-yaw_rate * placed.X_TR.origin.y(), t.vy, t.vz};
    rail_.rotation = {t.vroll, 0.0, yaw_rate};
  }

  const Mat3& R_ws = placed.X_TWs.rotation;
  wheelset_.origin = placed.X_TWs.origin;
  wheelset_.velocity = {p.roller ? 0.0 : v.x, v.y, v.z};
  wheelset_.rotation = R_ws * Vec3(v.roll, v.pitch, v.yaw);
  flexible_.origin = placed.X_TW.origin;
  flexible_.velocity = R_ws * Vec3(dv.x, dv.y, dv.z);
  flexible_.rotation = R_ws * Vec3(dv.roll, dv.pitch, dv.yaw);
  pitch_ = R_ws * Vec3(0.0, v.pitch, 0.0);
}

/// A roller rig stands for a curved track by turning under the wheel as well.
Vec3 MaterialMotion::roller_rotation(const Vec3& point_T) const {
  const double radius = roller_axle_.z() - point_T.z();
  return {0.0, roller_rate_, -radius * roller_rate_ * track_curvature_};
}

Vec3 MaterialMotion::rail_velocity(const Vec3& point_T) const {
  const Vec3 v = rail_.at(point_T);
  return roller_ ? Vec3(v + roller_rotation(point_T).cross(point_T - roller_axle_)) : v;
}

Vec3 MaterialMotion::wheel_velocity(const Vec3& point_T) const { return wheelset_.at(point_T) + flexible_.at(point_T); }

Vec3 MaterialMotion::wheel_velocity_by_pitch(const Vec3& point_T) const { return pitch_.cross(point_T - wheelset_.origin); }

Vec3 MaterialMotion::relative_rotation(const Vec3& point_T) const {
  const Vec3 rail = roller_ ? Vec3(rail_.rotation + roller_rotation(point_T)) : rail_.rotation;
  return rail - wheelset_.rotation - flexible_.rotation;
}

ContactKinematics contact_kinematics(const Problem& p, const Placement& placed, const Pose& X_TC, double approach) {
  const MaterialMotion motion(p, placed);
  // Wheel material at the depth of the rigid penetration.
  const Vec3 point_rail = X_TC.origin, point_wheel = X_TC.apply({0.0, 0.0, approach});
  const Vec3 v_rail = motion.rail_velocity(point_rail), v_wheel = motion.wheel_velocity(point_wheel);
  const Mat3 R_CT = X_TC.rotation.transpose();

  ContactKinematics k;
  if (p.regime == kalker::Regime::shift) {
    k.velocity = 1.0;
  } else if (motion.on_roller()) {
    // Both surfaces run backwards below a wheel that rolls forward.
    const double running = 0.5 * (R_CT * (v_rail + v_wheel)).x();
    k.velocity = std::abs(running);
    k.chi = running <= 0.0 ? 0.0 : std::numbers::pi;
  } else {
    const double by_pitch = motion.wheel_velocity_by_pitch(point_wheel).x();
    const double travel = v_wheel.x() - v_rail.x() - by_pitch;
    const bool forward = std::abs(travel) >= std::abs(by_pitch) ? travel >= 0.0 : by_pitch <= 0.0;
    k.chi = forward ? 0.0 : std::numbers::pi;
    k.velocity = 0.5 * (std::abs(travel) + std::abs(by_pitch));
  }
  constexpr double kStanding = 1e-9;
  if (k.velocity < kStanding) return k;
  const Vec3 slip = R_CT * (v_rail - v_wheel) / k.velocity;
  k.xi = slip.x();
  k.eta = slip.y();
  k.phi = X_TC.rotation.col(2).dot(motion.relative_rotation(point_rail)) / k.velocity;
  return k;
}

}  // namespace treadmark::wheelrail
