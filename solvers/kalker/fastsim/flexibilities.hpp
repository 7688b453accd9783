// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"

namespace treadmark::kalker {

/// Ellipse with the area and the ratio of length to width of the contact area.
struct EquivalentEllipse {
  double a = 0.0, b = 0.0;  ///< [m]
};
EquivalentEllipse equivalent_ellipse(const Grid2& grid, std::span<const double> pressure);

/// Displacement by traction u = L p / slope of the simplified theory, and what scales the spin in the rigid slip.
struct Flexibilities {
  double lx = 0.0, ly = 0.0;          ///< [m/Pa]
  double spin_x = 0.0, spin_y = 0.0;  ///< L1/L3, L2/L3
  double slope = 1.0;                 ///< reduction k of the initial slope
};

/// Flexibilities for longitudinal and lateral creepage and spin by which small ones give the forces of the linear
/// theory on an ellipse (Kalker 1990).
struct LinearFlexibilities {
  double l1 = 0.0, l2 = 0.0, l3 = 0.0;  ///< [m/Pa]
};
LinearFlexibilities linear_flexibilities(const KalkerCoefficients& c, double shear_modulus, double a, double b);

/// blended: creepages are given, so that the three flexibilities pass to one when they are large.
Flexibilities flexibilities(const ContactProblem& problem, const Creepage& creepage, double mu, double normal_force,
                            const EquivalentEllipse& equivalent, bool blended);

}  // namespace treadmark::kalker
