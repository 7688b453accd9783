// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/detection/interpenetration.hpp"

namespace treadmark::detection {

/// Extent of a region by linear interpolation of the gap's zero crossings between the guard rows and their inner
/// neighbours. wheel_dz as in find_regions().
Rectangle crossing_extent(const GapField& field, double wheel_dz, const Region& region);

/// Rail height [m] at column ix, interpolated at lateral position y; the nearest existing height where there is none.
double rail_height_near(const GapField& field, int ix, double y);

}  // namespace treadmark::detection
