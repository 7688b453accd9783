// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/model/vehicle/flexible_track.hpp"
#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark::vehicle {

/// What moves sideways and in roll below a wheelset on a flexible track, as masses and springs that do not move
/// vertically: the rails bend there. Pads resist the rail's rolling over its foot, as many as carry a force upon an
/// infinite beam on them. None without LateralSupport.
std::optional<TrackModel> lateral_track(const FlexibleTrack& track);

}  // namespace treadmark::vehicle
