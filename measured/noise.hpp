// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/model/profile.hpp"

namespace treadmark::measured {

/// Standard deviation of the points across the profile [m], from third differences over four successive points, scaled
/// by their distances: the median of their size, so that edges do not count. 0 for fewer than 8 points.
double profile_noise(const Profile& profile);

}  // namespace treadmark::measured
