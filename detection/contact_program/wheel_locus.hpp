// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/detection/gap_field.hpp"

namespace treadmark::detection {

/// Points of a round wheel's circles that are closest to a rail along x of T, as CONTACT has them: a point for every
/// lateral datum of the profile (Li 2002, to first order in the yaw angle; where the rail is not prismatic, both slopes
/// along x are the same there), a natural cubic spline over the profile's arc length between them, broken at kinks.
/// Where the curve folds back over y, seen from its middle, it ends.
class WheelLocus {
 public:
  /// nominal_radius [m]: of the wheel.
  WheelLocus(const BodyPair& bodies, double nominal_radius);

  /// Position (x, z) in T over increasing y [m]; NaN beside the curve.
  std::vector<Vec2> over(const std::vector<double>& y) const;

 private:
  std::vector<Vec3> points_, bends_start_,
      bends_end_;              ///< bends: second derivatives at both ends of the step after a point
  std::vector<double> steps_;  ///< of arc length
};

}  // namespace treadmark::detection
