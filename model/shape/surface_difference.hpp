// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>

namespace treadmark {

/// How far one surface lies from another: sampled normal distance, angle between normals, mean curvature.
struct SurfaceDifference {
  std::size_t points = 0;                           ///< compared
  std::size_t missing = 0;                          ///< the reference has a surface there, the candidate has none
  double height_max = 0.0, height_rms = 0.0;        ///< normal distance [m]
  double slope_max = 0.0, slope_rms = 0.0;          ///< [rad]
  double curvature_max = 0.0, curvature_rms = 0.0;  ///< mean curvature [1/m], on a coarser set of the points
  double worst_u = 0.0, worst_y = 0.0;              ///< where height_max was found: u [m] or [rad], y [m]
};

}  // namespace treadmark
