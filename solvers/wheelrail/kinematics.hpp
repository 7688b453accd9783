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

}  // namespace treadmark::wheelrail
