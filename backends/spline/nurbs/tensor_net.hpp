// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"
#include "treadmark/model/tensor_spline.hpp"

namespace treadmark::spline {

/// The same surface as patches, u scaled to about the station along the body, v to metres: exactly for degrees up to 3,
/// rational or not. Of higher degrees polynomial patches that lie within deviation [m], which is set to what was
/// measured of that between their corners (0 where they are exact). Errors: those of check(TensorSpline), and
/// Error(input_data) where kMostPatches do not suffice.
NurbsNet net_of(const TensorSpline& spline, double& deviation);
inline constexpr std::size_t kMostPatches = 4'000'000;

/// The same surface as a bicubic B-spline with single knots. Only for what fit_point_grid makes.
TensorSpline tensor_spline_of(const NurbsNet& net, Body body);

}  // namespace treadmark::spline
