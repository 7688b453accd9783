// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/friction.hpp"
#include "treadmark/core/material.hpp"

namespace treadmark::io {

/// What the head of a `.mat` text file says beyond the patch itself. The digits are those of CONTACT's control words;
/// SI units.
struct MatFileHead {
  double time = 0.0;                                   ///< [s]
  double s_ws = 0.0, pitch_ws = 0.0;                   ///< wheelset along the track [m], pitch angle [rad]
  double rail_y = 0.0, rail_z = 0.0, rail_roll = 0.0;  ///< rail marker in track axes [m], [rad]
  double roller_radius = 0.0;                          ///< [m], 0 = track
  double wheel_x = 0.0, wheel_y = 0.0, wheel_z = 0.0;  ///< wheel marker in track axes [m]
  double wheel_roll = 0.0, wheel_yaw = 0.0;            ///< [rad]
  double wheel_radius = 0.0;                           ///< nominal [m]
  double spin_x = 0.0, spin_y = 0.0;                   ///< spin centre in the grid's axes [m]
  int configuration = 0, discretisation = 0;           ///< C1, D
  int tangential = 0, material_model = 0;              ///< T, M
  int friction_law = 0, heat = 0;                      ///< L, H
  int case_number = 1, patches = 1, patch = 1;         ///< number of the case, of its patches, and of this one
  Material material;
  double layer_shear_modulus = 0.0, layer_thickness = 0.0;  ///< M = 4: G3 [Pa], h3 [m]
  FrictionLaw friction;
  int format = 2510;  ///< version of the layout, as year and release: 25.10
};

}  // namespace treadmark::io
