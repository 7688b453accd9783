// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/backends/spline/thb/thb_spline.hpp"

namespace treadmark::spline {

struct ThbFitSettings {
  int degree = 3;  ///< 2 or 3
  /// What remains between points and surface counts where it is more [m], and more than noise.
  double tolerance = 2e-9;
  /// Standard deviation of the points along the normal [m]; without it it is estimated.
  std::optional<double> noise;
};

struct ThbFit {
  ThbSpline spline;
  double noise = 0.0;          ///< of the points, as given or estimated [m]
  double most_left = 0.0;      ///< greatest distance between a point and the surface at its parameters [m]
  double rms_left = 0.0;       ///< along the normal [m]
  std::size_t unresolved = 0;  ///< cells as small as the points allow that still are too far off
};

/// Least squares through the points of a grid: u as it is, v by mean chord lengths [m]. The breaks of level 0 are those
/// that most lines of points need; then cells are divided where more than noise remains, down to one point a cell,
/// where the spline goes through the points (degree 2: two points). Errors: those of check_points; Error(configuration)
/// for another degree or a tolerance or noise that is not a number >= 0; Error(numerical) if the equations are
/// singular. Does not depend on the number of threads.
ThbFit fit_thb(const sampling::PointGrid& points, const ThbFitSettings& settings = {});

/// The same through scattered points, as of a scanner, free of outliers, in the surface frame: u is x [m] or the angle,
/// v is y [m]. Points beside the region are left out. A wheel is closed unless the region ends. Cells become as small
/// as four points. Errors: those above; Error(input_data) for points that are not finite, too few of them, and holes
/// where 64 would lie if all were spread evenly; over smaller ones a smooth surface goes on.
ThbFit fit_thb(std::span<const Vec3> points, Body body, const sampling::Region& region,
               const ThbFitSettings& settings = {});

}  // namespace treadmark::spline
