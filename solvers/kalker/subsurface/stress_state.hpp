// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/pose.hpp"

namespace treadmark::kalker {

/// Displacements and stresses at a point of one body, in the axes of the patch (x, y, z into body 1).
struct SubsurfacePoint {
  Vec3 point = Vec3::Zero();         ///< [m]; z >= 0: body 1, z < 0: body 2
  Vec3 displacement = Vec3::Zero();  ///< [m]
  Mat3 gradient = Mat3::Zero();      ///< gradient(i, j) = d u_i / d x_j [-]
  Mat3 stress = Mat3::Zero();        ///< symmetric, tension positive [Pa]
  double hydrostatic = 0.0;          ///< mean of the normal stresses [Pa]
  double von_mises = 0.0;            ///< sqrt(3 J2) [Pa]
  double tresca = 0.0;               ///< greatest minus least principal stress [Pa]
  Vec3 principal = Vec3::Zero();     ///< sigma_1 >= sigma_2 >= sigma_3 [Pa]
};

/// Fills hydrostatic, von_mises, tresca and principal from the stress.
void set_invariants(SubsurfacePoint& point);

}  // namespace treadmark::kalker
