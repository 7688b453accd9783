// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/sampling/point_grid.hpp"
#include "treadmark/backends/spline/nurbs_net.hpp"
#include "treadmark/core/surface_spec.hpp"

namespace treadmark::spline {

/// The cubic tensor B-spline through all points, twice continuously differentiable: in u with knots at the stations
/// (periodic if closed, else not-a-knot ends), in v with knots at the mean chord length along the stations [m] (de Boor
/// 1978). Errors: Error(input_data) for gaps, fewer than 4 x 4 points, stations or nodes that do not increase, radii
/// that are not positive.
NurbsNet fit_point_grid(const sampling::PointGrid& grid);

/// A chain as rational arcs (Piegl and Tiller 1997), swept from x_min to x_max or revolved all round. v is the arc
/// length at the ends of patches, u is x or, at the ends of patches, the angle. Errors: Error(configuration) for a
/// chain without segments, with bad numbers or longer than a circle, a bad range, a chain that reaches the axle.
NurbsNet sweep_chain(const ArcChain& chain, double x_min, double x_max);
NurbsNet revolve_chain(const ArcChain& chain, double nominal_radius);

}  // namespace treadmark::spline
