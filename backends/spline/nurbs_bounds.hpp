// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/nurbs_net.hpp"

namespace treadmark::spline {

/// Range that holds all heights over a rectangle, from control points of parts of patches about as large as the rectangle;
/// empty if there is no surface over it.
Interval nurbs_heights_over(const NurbsNet& net, const Pose& X_SP, const Rectangle& rectangle_P, Facing facing);

}  // namespace treadmark::spline
