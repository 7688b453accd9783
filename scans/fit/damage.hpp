// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/scans/cleaning/band_points.hpp"
#include "treadmark/scans/fit/spline_field.hpp"

namespace treadmark::scans {

/// A connected part of the band that lies off its section.
struct Damage {
  double a = 0.0, s = 0.0;           ///< its middle, weighted by depth; a counts from the band's a_min [m]
  double length = 0.0, width = 0.0;  ///< extent along a and s [m]
  double depth = 0.0;   ///< greatest distance below the section [m]; negative where material stands out only
  double volume = 0.0;  ///< of what is missing (outstanding: negative) [m^3]
};

/// Parts deeper or higher than threshold [m], the largest volume first; parts smaller than kSmallest across are left
/// out. Looks at s_min..s_max only. Deterministic.
std::vector<Damage> find_damage(const Band& band, const SplineField& field, double s_min, double s_max,
                                double threshold);

}  // namespace treadmark::scans
