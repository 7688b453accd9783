// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/thb/fit_points.hpp"

namespace treadmark::spline {

/// Breaks of the coarsest level of a hierarchy: numbers of places.
struct CoarsestBreaks {
  std::vector<int> u, v;
};

/// Those that more than half of some lines of points along u and across need, of each direction by itself: what is
/// curved all along is resolved here, damage is left to finer levels. Of scattered points lines are narrow strips.
CoarsestBreaks coarsest_breaks(const FitPoints& points, Body body, int degree, const FitTolerance& tolerance);

}  // namespace treadmark::spline
