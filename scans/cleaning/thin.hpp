// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/scans/cleaning/band_points.hpp"
#include "treadmark/scans/placement/voxels.hpp"

namespace treadmark::scans {

/// One representative point per voxel, for algorithms that are expensive per point. Results for a voxel apply to all of
/// its points.
struct ThinnedPoints {
  Voxels voxels;
  std::vector<Vec3> position;  ///< mean of the cube's points
};

ThinnedPoints thin(std::span<const Vec3> points, const Vec3& origin, double size);

/// Points of a band at the very place of another one (same numbers in the cloud), all but the first: marked off_band.
/// Returns their number.
std::size_t drop_duplicates(BandPoints& points, std::span<const Vec3> cloud);

}  // namespace treadmark::scans
