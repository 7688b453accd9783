// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"
#include "treadmark/backends/spline/thb/thb_space.hpp"

namespace treadmark::spline {

/// A surface of truncated hierarchical B-splines: all three coordinates, surface frame [m].
struct ThbSpline {
  ThbSpace space;
  std::vector<Vec3> coefficients;  ///< by the numbers of the functions

  /// By the parameters, clamped to the ends.
  Vec3 point(double u, double v) const;
};

/// Its cells as bicubic patches, exactly: what has degree 1 or 2 is raised.
NurbsNet extracted(const ThbSpline& spline);

}  // namespace treadmark::spline
