// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/kinematics.hpp"

#include <cmath>
#include <numbers>

#include "treadmark/solvers/wheelrail/material_velocity.hpp"

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
  if (k.velocity < kStanding) return k;
  const Vec3 slip = R_CT * (v_rail - v_wheel) / k.velocity;
  k.xi = slip.x();
  k.eta = slip.y();
  k.phi = X_TC.rotation.col(2).dot(material.rotation_difference()) / k.velocity;
  return k;
}

}  // namespace treadmark::wheelrail
