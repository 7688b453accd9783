// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/solvers/kalker/tangential/patch.hpp"

namespace treadmark::kalker {

/// The friction problem of a patch: find tractions p with slip distance S = W + A p such that in every element either
/// S = 0 and |p| <= g, or |p| = g and p is directed against S.
struct FrictionProblem {
  PatchOperator* matrix = nullptr;
  Field2 rigid_slip;          ///< W [m]
  std::vector<double> bound;  ///< g = mu p_n [Pa]
};

/// Tractions, their slip, and how far they are from a solution. With z = p - r S and r = 1/diagonal of A the conditions
/// read p = z where |z| <= g (adhesion), else p = g z/|z| (slip), up to a difference that vanishes (Alart and Curnier
/// 1991).
struct FrictionState {
  Field2 traction;             ///< [Pa]
  Field2 slip;                 ///< S [m]
  std::vector<char> slipping;  ///< by the trial traction z
  Field2 direction;            ///< z/|z| in slipping elements
  std::vector<double> excess;  ///< |z| - g in slipping elements [Pa]
  double violation = 0.0;      ///< rms of the difference [Pa]

  /// Slip and residual of the present tractions. One product.
  void update(const FrictionProblem& problem);
};

/// Tractions within the bound: scales down where necessary.
void limit_to_bound(std::span<double> traction, std::span<const double> bound);

double rms(std::span<const double> values);

}  // namespace treadmark::kalker
