// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/backends/spline/thb/thb_spline.hpp"

namespace treadmark::spline {

struct ThbFitSettings {
  int degree = 3;  ///< 2 or 3
  /// What remains between points and surface counts where it is more [m], and more than noise. The same for all cells:
  /// small ones at the border of large ones are no better than those.
  double tolerance = 1e-9;
};

struct ThbFit {
  ThbSpline spline;
  double noise = 0.0;          ///< estimated standard deviation of the points' heights [m]
  double most_left = 0.0;      ///< greatest distance between a point and the surface at its parameters [m]
  std::size_t unresolved = 0;  ///< cells as small as the points allow that still are too far off
};

/// Least squares through the points of a grid: u as it is, v by mean chord lengths [m]. Level 0 follows the median
/// section and the median line along u as closely as they need; cells are divided where more than noise remains, down
/// to one point a cell. Where points are too few for the coefficients, what a level adds to the one before is smooth.
/// Errors: those of check_points; Error(configuration) for another degree; Error(numerical) if the equations are
/// singular. Does not depend on the number of threads.
ThbFit fit_thb(const sampling::PointGrid& points, const ThbFitSettings& settings = {});

}  // namespace treadmark::spline
