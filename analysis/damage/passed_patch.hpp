// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <vector>

#include "treadmark/analysis/damage/stress_history.hpp"
#include "treadmark/model/damage/fatigue.hpp"

namespace treadmark::damage {

/// An element in contact, on the own surface of one body.
struct PassedElement {
  double u = 0.0;                    ///< its middle: x of a rail [m], theta of a wheel [rad]
  double y_low = 0.0, y_high = 0.0;  ///< across, profile coordinate [m]
  double pressure = 0.0;             ///< [Pa]
  double traction = 0.0;             ///< its magnitude [Pa]
  double slip = 0.0;                 ///< magnitude, over the rolling speed [-]
  double dissipation = 0.0;          ///< power of friction by area [W/m2]
  double temperature = 0.0;          ///< of the surface, where it is known [deg C]
};

/// What points at a depth below a row of elements endure while the patch passes.
struct PassedStress {
  double y_low = 0.0, y_high = 0.0;  ///< across, profile coordinate [m]
  std::size_t depth = 0;             ///< its number
  StressMeasures stress;
};

/// A patch that rolls over one body.
struct PassedPatch {
  double velocity = 0.0;             ///< rolling speed [m/s], > 0
  double length = 0.0, width = 0.0;  ///< of an element along and across, on the surface [m]
  double power = 0.0;                ///< of friction, as the solver states it [W], >= 0
  double normal_force = 0.0;         ///< [N]
  double traction_force = 0.0;       ///< its magnitude [N]
  std::vector<PassedElement> elements;
  ContactFatigue fatigue;
  std::vector<PassedStress> stresses;
  /// Power of friction over rolling speed [N].
  double t_gamma() const { return power / velocity; }
  double element_area() const { return length * width; }
  /// Of contact [m2].
  double area() const { return element_area() * static_cast<double>(elements.size()); }
};

}  // namespace treadmark::damage
