// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/slices.hpp"

namespace treadmark::sampling {

/// Steepest part of a rail's section that counts as touchable: flanges of wheels stand at 60 to 75 degrees.
inline constexpr double kSteepestTouchable = 5.6712818196177075;  ///< [-] tan(80 degrees)

/// Sections of a rail at even distances along the track, as slices: each from its first to its last point that is not
/// steeper than kSteepestTouchable, so that they follow a section that moves sideways. spacing_u [m] along the track
/// (smaller, so that it divides the region and gives at least four slices), spacing [m] along the sections. Errors:
/// Error(configuration) for a region without ends along the track or spacings that are not positive; Error(input_data)
/// where a section is missing, or has a gap.
SliceSet touchable_slices(const Surface& rail, const Region& region, double spacing_u, double spacing);

/// Some of the slices, where possible at least apart [m] from each other: those between which a feature begins or ends
/// all stay, and so do the first two and the last two.
SliceSet thinned_slices(const SliceSet& slices, double apart);

}  // namespace treadmark::sampling
