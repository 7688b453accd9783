// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/model/shape/profile.hpp"

namespace treadmark::measured {

/// How the points of a profile scatter [m].
struct PointNoise {
  double across = 0.0;                        ///< standard deviation across the profile, rounding included
  double rounding_y = 0.0, rounding_z = 0.0;  ///< steps to which the numbers were rounded; 0: none are seen
  double step = 0.0;                          ///< usual distance of neighbours
  double flat = 0.0, steep = 0.0;  ///< across where the profile runs nearer to y than to z, and elsewhere: instruments
                                   ///< that tell heights scatter in z
};

/// From differences of third to seventh order of successive points, scaled by their distances: the median of their
/// size, so that corners do not count, of the order that finds least, so that curvature does not. Numbers that all are
/// multiples of a step are rounded, unless they are the equal steps of a gauge or lie on a curve without a deviation.
/// White noise that is finer than rounding leaves no trace: `across` is then what rounding is. Nothing for fewer than 8
/// points.
PointNoise profile_noise(const Profile& profile);

/// Length along the points from the first one [m], measured along the profile's general direction there, so that points
/// which scatter by more than their distance do not make it longer. Never decreases.
std::vector<double> rough_arc_length(const Profile& profile);

}  // namespace treadmark::measured
