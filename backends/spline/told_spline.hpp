// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"
#include "treadmark/backends/spline/thb/thb_spline.hpp"
#include "treadmark/model/shape/spline_surface.hpp"

namespace treadmark::spline {

/// A grid of patches as one spline of degree 3, the same surface to rounding: u first, v second. Knots are as often
/// there as the surface needs them: once where it is twice continuously differentiable to 1e-12 m, else twice; of a
/// rational one three times. Of a closed one the last knot stands for the first. Errors: Error(configuration) for a
/// list of patches.
SplineSurface told_spline(const NurbsNet& net);

/// A hierarchical spline by its levels, boxes and coefficients. Errors: Error(numerical) if a closed one is not the
/// same with ends to 1e-12 m.
SplineSurface told_spline(const ThbSpline& spline);

}  // namespace treadmark::spline
