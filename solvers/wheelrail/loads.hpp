// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {

/// A force on the rail and its moment.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< [N m]
  Wrench& operator+=(const Wrench& other) {
    force += other.force;
    moment += other.moment;
    return *this;
  }
};

/// One load on the rail in four systems of axes. That on the wheel is the opposite.
struct Wrenches {
  Wrench track;     ///< track axes, moment about the rail marker
  Wrench rail;      ///< rail axes, moment about the rail marker
  Wrench wheelset;  ///< wheelset axes, moment about the wheel marker
  Wrench wheel;     ///< wheel axes, moment about the wheel marker
  Wrenches& operator+=(const Wrenches& other) {
    track += other.track;
    rail += other.rail;
    wheelset += other.wheelset;
    wheel += other.wheel;
    return *this;
  }
};

/// A load at a contact reference, given in contact axes with its moment about that point [N], [N m].
Wrenches loads(const Placement& placement, const Pose& X_TC, const Wrench& load_C);
/// The same of a load that rail and wheel take at different places: by_wheel_C is the opposite of the wheel's.
Wrenches loads(const Placement& placement, const Pose& X_TC, const Wrench& by_rail_C, const Wrench& by_wheel_C);

/// The load seen in the mirror y -> -y.
Wrenches mirrored(Wrenches load);

}  // namespace treadmark::wheelrail
