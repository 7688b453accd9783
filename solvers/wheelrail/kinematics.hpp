// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {

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

/// Motion of a rigid body: velocity of one of its points and its rate of turning.
struct RigidMotion {
  Vec3 point = Vec3::Zero();             ///< [m]
  Vec3 velocity = Vec3::Zero();          ///< of the body at that point [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< [rad/s]

  /// Velocity of the body's material at a point [m/s].
  Vec3 at(const Vec3& place) const { return velocity + angular_velocity.cross(place - point); }
};

/// How the material of rail (or roller) and wheel moves, in track axes, which move along with the wheelset.
struct MaterialVelocity {
  RigidMotion rail, wheel;
  RigidMotion pitch;  ///< the part of the wheel's motion by the wheelset's pitch rate

  /// rail - wheel at one place [m/s].
  Vec3 difference(const Vec3& place_T) const { return rail.at(place_T) - wheel.at(place_T); }
  /// rail - wheel [rad/s].
  Vec3 rotation_difference() const { return rail.angular_velocity - wheel.angular_velocity; }
};

/// Of a right-hand pair. Shifts: displacements of the step. The rail turns with the track curve that the wheelset runs
/// through; a roller turns about its own axle, which deviations of the rail move and tilt.
MaterialVelocity material_velocity(const Problem& right_hand_problem, const Placement& placement);

}  // namespace treadmark::wheelrail
