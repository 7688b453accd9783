// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark::io {

/// A lumped track as a track file, numbers exact. source: where its numbers come from; comments: lines at its
/// beginning, without their signs. Thread-safe.
std::string track_text(const TrackModel& track, const std::string& source, const std::vector<std::string>& comments);

}  // namespace treadmark::io
