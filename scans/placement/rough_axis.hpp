// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/scans/placement/elements.hpp"

namespace treadmark::scans {

/// A line: of the axle of a wheel, or a direction along which a rail is swept (point unused).
struct Axis {
  Vec3 point = Vec3::Zero();
  Vec3 direction = Vec3::UnitY();  ///< unit, either way
};

struct RoughAxis {
  Axis axis;
  double inliers = 0.0;  ///< part of the elements that agree
  double residual =
      0.0;  ///< rms of those: distance of normals from the axis [unit], or angle to its normal plane [rad]
};

/// Axis of revolution that most normals meet: robust version of Pottmann and Randrup (1998), random samples first, then
/// reweighted least squares in line coordinates. Deterministic.
/// Errors: Error(input_data) if the elements are no surface of revolution.
RoughAxis rough_revolution(const SurfaceElements& elements);

/// Direction to which most normals are perpendicular. Errors: Error(input_data) if there is none.
RoughAxis rough_sweep(const SurfaceElements& elements);

}  // namespace treadmark::scans
