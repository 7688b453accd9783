// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {

/// Velocities of the material of both bodies, track axes [m/s], [rad/s]. The rail's frame travels with the wheelset, so that a rail
/// on the track stands still but for its irregularity and, in a curve, turns. A right-hand pair.
class MaterialMotion {
 public:
  MaterialMotion(const Problem& right_hand_problem, const Placement& placement);

  Vec3 rail_velocity(const Vec3& point_T) const;
  Vec3 wheel_velocity(const Vec3& point_T) const;
  /// Share of the wheel's velocity that comes from its rotation about the axle.
  Vec3 wheel_velocity_by_pitch(const Vec3& point_T) const;
  /// Angular velocity of the rail less that of the wheel.
  Vec3 relative_rotation(const Vec3& point_T) const;

  bool on_roller() const { return roller_; }

 private:
  struct Body {
    Vec3 origin = Vec3::Zero(), velocity = Vec3::Zero(), rotation = Vec3::Zero();
    Vec3 at(const Vec3& point) const { return velocity + rotation.cross(point - origin); }
  };
  Vec3 roller_rotation(const Vec3& point_T) const;

  Body rail_, wheelset_, flexible_;
  Vec3 pitch_;
  bool roller_ = false;
  Vec3 roller_axle_ = Vec3::Zero();
  double roller_rate_ = 0.0, track_curvature_ = 0.0;
};

/// Relative motion of rail and wheel material at a contact: (rail - wheel) / V in contact axes.
/// Of a shift: its displacements themselves, [m] and [rad], with velocity 1 and chi 0.
struct ContactKinematics {
  double xi = 0.0, eta = 0.0;  ///< creepage [-]
  double phi = 0.0;            ///< spin [rad/m]
  double velocity = 0.0;       ///< rolling velocity V [m/s]
  double chi = 0.0;            ///< rolling direction, 0 forward or pi backward [rad]
};

/// Creepage of a right-hand pair at the contact frame X_TC with rigid penetration 'approach' [m].
/// A standing wheel (V < 1e-9 m/s) has no creepage.
ContactKinematics contact_kinematics(const Problem& right_hand_problem, const Placement& placement, const Pose& X_TC,
                                     double approach);

}  // namespace treadmark::wheelrail
