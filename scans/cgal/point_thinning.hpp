// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// A subset of points about `spacing` apart: in every cube of that side the point nearest to the mean of the points in
/// it, less those closer than 0.6 spacing to one that is in already. Indices in the order of the cubes; the result
/// depends on the order of the points only through the rounding of the means.
std::vector<std::uint32_t> thin_points(std::span<const Vec3> points, double spacing);

}  // namespace treadmark::scans
