// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <vector>

#include "treadmark/core/report.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

/// A number of a solution that has derivatives by the gap. The area of contact, counted in elements, has none: it is
/// piecewise constant.
enum class Quantity {
  force_n,           ///< [N]
  approach,          ///< [m]
  max_pressure,      ///< [Pa]
  middle_x,          ///< middle of pressures, in the grid's axes [m]
  middle_y,          ///< likewise [m]
  elastic_energy,    ///< [J]
  force_x,           ///< of tractions [N]
  force_y,           ///< [N]
  moment_n,          ///< about the grid's origin [N m]
  frictional_power,  ///< [W], negative = dissipated (shift: work [J])
};

/// Derivatives of a number by what is given. Elements in contact stay in it and others out of it, so that they hold
/// between two changes of the contact area: at one, and where the largest pressure moves to another element, there is
/// one of each side, and these are those of the elements as the solution has them. Elements that adhere and slip, and
/// what tractions have of the instant before, stay likewise.
struct Gradient {
  std::vector<double> by_gap;           ///< by the undeformed distance h of each element [unit/m], 0 out of contact
  double by_load = 0.0;                 ///< by the force [unit/N] or the approach [unit/m], whichever is prescribed
  std::array<double, 3> by_creepage{};  ///< by xi, eta [unit], phi [unit m]; shift: [unit/m], [unit/m], [unit/rad]
  double by_friction = 0.0;             ///< by the coefficient of friction of all elements [unit]
  Report report;  ///< iterations of two products each; derivatives of another status than ok are none
};

/// How a number changes with the fields of a solution; empty: not at all.
struct FieldWeights {
  std::vector<double> pressure;                ///< [unit/Pa]
  double approach = 0.0;                       ///< [unit/m]
  std::vector<double> traction_x, traction_y;  ///< [unit/Pa]
  std::vector<double> slip_x, slip_y;  ///< by relative slip of elements that do not adhere [unit] (shift: [unit/m])
};

/// Of a solution in contact.
FieldWeights weights_of(const ContactProblem& problem, const ContactSolution& solution, Quantity quantity);

}  // namespace treadmark::kalker
