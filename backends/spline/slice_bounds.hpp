// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/spline/slice_geometry.hpp"
#include "treadmark/backends/spline/slice_hulls.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// Conservative range of the heights of a slice surface over a rectangle of a plane, given by its ranges across and along
/// the lines that suit the plane; empty if the surface is nowhere over it. From boxes of control points.
Interval slice_height_bounds(const RailGeometry&, const SliceHulls& hulls, const Pose& X_SP, bool along_y,
                             const Interval& across, const Interval& along);
Interval slice_height_bounds(const WheelGeometry&, const SliceHulls& hulls, const Pose& X_SP, bool along_y,
                             const Interval& across, const Interval& along);

}  // namespace treadmark::spline
