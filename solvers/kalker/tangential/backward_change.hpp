// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/tangential/friction_state.hpp"

namespace treadmark::kalker {

/// Derivatives of a number by what tractions follow from.
struct BackwardChange {
  Field2 by_rigid_slip;          ///< [unit/m]
  std::vector<double> by_bound;  ///< [unit/Pa]
  int products = 0;
  double residual = 0.0;  ///< size of the last correction, relative
  bool converged = false;
};

/// Of a number of which those by tractions [unit/Pa] and slip distances [unit/m] are given, at a solution of the
/// patch's friction problem; adhesion and slip areas stay. Coefficients that are symmetric.
BackwardChange backward_change(const Patch& patch, Compliance& compliance, std::vector<double> bound,
                               FrictionState state, Field2 by_traction, Field2 by_slip);

}  // namespace treadmark::kalker
