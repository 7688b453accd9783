// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/scans/cleaning/band_points.hpp"

namespace treadmark::scans {

/// What most points of a band say of its section: the section that they were projected on, moved along its normals by
/// splines from coarse to fine, of which only those stand that come out of the noise. Damage does not pull (Tukey's
/// biweight about medians of narrow strips). With a nominal profile to begin with, what agrees with it stays exactly
/// nominal. moved: the largest move [m], if not null. finest: smallest distance of knots [m]. Deterministic.
Section refine_section(const BandPoints& points, const Band& band, double finest, double* moved = nullptr);

}  // namespace treadmark::scans
