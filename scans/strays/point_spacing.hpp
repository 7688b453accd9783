// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Neighbours whose mean distance is the spacing at a point: on a square grid 1.14 of its step, for random points that
/// lie as densely 0.98 of it, whereas the nearest one alone would say 1 and 0.5.
inline constexpr int kSpacingNeighbours = 6;

/// The upper median.
double median(std::vector<double> values);

/// Median over the points of the mean distance to the nearest kSpacingNeighbours.
double median_spacing(std::span<const Vec3> points);

}  // namespace treadmark::scans
