// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::io {

/// Displacement and stress at a point below the surface, in the axes of the patch (x, s, n).
struct SubsurfaceValue {
  Vec3 point = Vec3::Zero();                                ///< [m]; n >= 0: rail, n < 0: wheel
  Vec3 displacement = Vec3::Zero();                         ///< [m]
  Mat3 stress = Mat3::Zero();                               ///< symmetric, tension positive [Pa]
  double hydrostatic = 0.0, von_mises = 0.0, tresca = 0.0;  ///< [Pa]
  Vec3 principal = Vec3::Zero();                            ///< sigma_1 >= sigma_2 >= sigma_3 [Pa]
};

/// Points in nx columns, ny rows and nz layers: values[ix + nx (iy + ny iz)].
struct SubsurfaceBlock {
  int nx = 0, ny = 0, nz = 0;
  std::vector<SubsurfaceValue> values;
};

}  // namespace treadmark::io
