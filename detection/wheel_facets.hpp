// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

/// A wheel as the search of the reference program (CONTACT) sees it: exact cross-sections at equally spaced angles about the
/// lowest point, joined by bilinear facets. Only for agreement with its results; Treadmark's own search needs no mesh.
struct WheelFacets {
  double half_angle = 0.2;  ///< sections from -half_angle to +half_angle about the lowest point [rad]
  int sections = 0;         ///< >= 2
  double lateral_step = 0.5e-3;  ///< the width of the wheel is divided into equal steps not longer than this [m]
};

/// Least and greatest x in T of the sections' points [m], over the whole width of the wheel.
struct LongitudinalRange {
  double x_min = 0.0, x_max = 0.0;
};
LongitudinalRange facet_range(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets);

/// Heights [m] of the facets over a grid seen along z of T; NaN where there are none.
std::vector<double> facet_heights(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets, const Grid2& grid_T);

}  // namespace treadmark::detection
