// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/profile.hpp"

namespace treadmark::spline {

/// Chord length along the points [m], shifted so that s = 0 where y = 0 if y is strictly monotonic (by linear
/// interpolation; the nearest point if 0 lies outside its range), else at the point nearest to (0, 0).
/// Errors: Error(input_data) for fewer than two points, sizes that differ, non-finite or coinciding neighbours.
std::vector<double> arc_length(const Profile& profile);

/// Indices of the points where the curve has a corner, always with the first and last point. A corner turns by more
/// than kink_high while all other points within kink_width along the curve turn by at most kink_low; a single point
/// between two corners counts as one too.
std::vector<int> find_kinks(const Profile& profile, const std::vector<double>& s);

}  // namespace treadmark::spline
