// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/pose.hpp"
#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/wheelrail/kinematics.hpp"

namespace treadmark::vehicle {

/// What a Hertzian contact transmits: semi-axes a (rolling direction), b [m]; mu F_n [N].
struct CreepContact {
  double a = 0.0, b = 0.0, friction_bound = 0.0;
};

/// On the rail, contact axes.
struct CreepForce {
  Vec2 force = Vec2::Zero();    ///< F_x, F_s [N]
  double moment = 0.0;          ///< about n [N m]
  double power = 0.0;           ///< dissipated, never negative [W]
  Vec2 damping = Vec2::Zero();  ///< -dF_x/dv_x, -dF_s/dv_s, never negative [N s/m]
};

/// Kalker's linear theory (1967), its force limited as Shen, Hedrick and Elkins (1983) propose; what spin contributes
/// fades out in sliding (empirical: their law alone lets spin turn the force of a sliding flange). The moment is that
/// of lateral creepage alone, limited like the lateral force of spin, so that their powers cancel out and no creepage
/// and spin can gain energy. The damping takes the fading of spin as it is. A wheel that stands still transmits
/// nothing. Thread-safe. Errors: Error(configuration) unless a, b > 0.
CreepForce creep_force(const CreepContact& contact, const CombinedMaterial& material,
                       const wheelrail::ContactKinematics& creepage);

}  // namespace treadmark::vehicle
