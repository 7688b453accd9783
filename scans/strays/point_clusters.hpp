// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Groups of points with a way from each to each other in steps of at most gap (single linkage). Returns the group of
/// every point, counted from 0 in the order of their first points.
std::vector<std::uint32_t> cluster_points(std::span<const Vec3> points, double gap);

}  // namespace treadmark::scans
