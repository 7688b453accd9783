// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/scans/line/find_line.hpp"

namespace treadmark::scans {

enum class TrackRail : std::uint8_t { none, left, right };

/// Which points of a scan belong to which rail of a track.
struct TrackRails {
  std::vector<TrackRail> of_point;
  TrackRail other = TrackRail::none;  ///< the one that is not on the line
  Vec3 forward = Vec3::Zero();  ///< from the beginning of the line to its end, in the cloud's frame; left and right so
};

/// Finds the other rail of a track beside one whose line is known: 0.5 to 1.9 m beside it, and up to 0.45 m higher or
/// lower, for the line may be rolled against the track, most points that are as wide and as deep as a head and stand
/// free to both sides; where none does, to one or none. What lies within 0.25 m of a rail belongs to it. points: [m] in
/// the cloud's frame. Deterministic.
/// Errors: Error(input_data) where there is no other rail.
TrackRails separate_rails(std::span<const Vec3> points, const RailLine& line);

}  // namespace treadmark::scans
