// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/core/pose.hpp"

namespace treadmark::damage {

/// What a point endures while a contact passes over it.
struct StressMeasures {
  double von_mises = 0.0;  ///< largest [Pa]
  double shear = 0.0;      ///< amplitude on the plane where it is largest: half of the largest change [Pa]
  /// Largest sum of the shear stress (Tresca) round the middle of the passage and the slope times the hydrostatic
  /// stress [Pa]; the middle is that of the smallest ball round the deviators (Dang Van).
  double dang_van = 0.0;
  /// The least shear yield k for which residual stresses of a layer (xx, yy, xy the same all along x, which need no
  /// others for their balance) keep the passage elastic [Pa]: Melan's theorem with von Mises' condition.
  double shakedown = 0.0;
};

/// Of the stresses at one point, tension positive [Pa], from instant to instant; x is the direction of rolling, z goes
/// into the body. The unloaded state before and after is added. Thread-safe.
StressMeasures stress_measures(std::span<const Mat3> history, double dang_van_slope);

}  // namespace treadmark::damage
