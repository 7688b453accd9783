// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

/// Two surfaces placed in one common frame T (for a wheelset on track: the track frame). The surfaces must outlive this.
struct BodyPair {
  const Surface* rail = nullptr;   ///< body 1, facing up
  const Surface* wheel = nullptr;  ///< body 2, facing down
  Pose X_TR;                       ///< rail frame in T
  Pose X_TW;                       ///< wheel surface frame (origin on the axle, pitched with the wheel) in T
  /// The undeformed distance is found with a mesh of the wheel and sections of the rail as in the reference program.
  bool distance_on_mesh = false;
};

}  // namespace treadmark::detection
