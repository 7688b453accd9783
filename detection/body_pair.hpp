// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>

#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

struct SampledProfile;

/// Undeformed distances are to be found with a mesh of the wheel and sections of the rail, as in the reference program
/// (CONTACT).
struct DistanceMesh {
  double nominal_radius = 0.0;  ///< of the wheel [m]
  bool rail_sections = true;    ///< false for rollers, whose one profile that program only bends
};

/// Two surfaces placed in one common frame T (for a wheelset on track: the track frame). The surfaces must outlive
/// this.
struct BodyPair {
  const Surface* rail = nullptr;   ///< body 1, facing up
  const Surface* wheel = nullptr;  ///< body 2, facing down
  Pose X_TR;                       ///< rail frame in T
  Pose X_TW;                       ///< wheel surface frame (origin on the axle, pitched with the wheel) in T
  std::optional<DistanceMesh> distance_mesh = std::nullopt;  ///< empty: distances between the surfaces themselves
  std::shared_ptr<const SampledProfile> wheel_profile =
      nullptr;  ///< whole_profile() of the wheel, made once for many searches; null: made when needed
};

}  // namespace treadmark::detection
