// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <vector>

namespace treadmark {

/// How the points of a measured profile scatter, and how well the curve is known that was laid through them.
struct ProfileScatter {
  double white = 0.0;                         ///< standard deviation of a point across the profile [m]
  double rounding_y = 0.0, rounding_z = 0.0;  ///< steps to which the numbers were rounded; 0: none are seen [m]
  double step = 0.0;                          ///< usual distance of neighbouring points [m]
  double removed = 0.0;                       ///< root mean square of what smoothing moved the points by [m]

  /// What follows is there if the points were smoothed, or are exact and so far apart that the curve is not known
  /// between them.
  std::vector<double> s;  ///< arc length of each point along the curve [m]
  /// Of exact points: standard deviation of the curve across itself midway from each but the last to the next [m].
  std::vector<double> between;
  /// Across the curve at each point, from it to the one of each other assumption about where curvature changes [m].
  std::vector<std::vector<double>> others;
  /// The curve's error across itself is a spline of equal knots; the inverse of its coefficients' covariance is L D L'.
  double first_knot = 0.0, knot_step = 0.0;   ///< [m]
  std::vector<std::vector<double>> errors;    ///< that it may have: coefficients [m]
  std::vector<std::array<double, 4>> factor;  ///< rows of D [1/m^2] and of L left of its diagonal, nearest first
};

}  // namespace treadmark
