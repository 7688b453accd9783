// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/tangential/friction_state.hpp"
#include "treadmark/solvers/kalker/tangential/gmres.hpp"

namespace treadmark::kalker {

struct NewtonSettings {
  double eps = 1e-5;  ///< accuracy of tractions relative to their rms
  int max_steps = 40;
  int max_inner = 60;    ///< GMRES iterations a step
  bool updated = false;  ///< the state is within its bound and up to date
};

struct NewtonResult {
  bool converged = false;
  int steps = 0;
  int products = 0;  ///< products with A
};

/// Semismooth Newton method on the friction conditions. Unknowns of a step are both components in adhesion elements and
/// the component along the circle of slip elements; the linear systems are solved by GMRES, as exactly as is
/// worthwhile.
class FrictionNewton {
 public:
  /// state: start tractions in, solution out (updated).
  NewtonResult solve(const FrictionProblem& problem, FrictionState& state, const NewtonSettings& settings);

  /// Change of tractions due to a small change of the rigid slip and of the bound (empty: none), with adhesion and slip
  /// areas as in the state.
  Field2 sensitivity(const FrictionProblem& problem, const FrictionState& state, const Field2& rigid_slip_change,
                     std::span<const double> bound_change, double tolerance, int max_inner);
  /// Products with A of all sensitivities so far.
  int sensitivity_products() const { return sensitivity_products_; }

 private:
  /// The linear system of a step, for the present state.
  void linearise(const FrictionProblem& problem, const FrictionState& state);
  /// rhs is used up.
  GmresResult solve_linear(const FrictionProblem& problem, std::span<double> rhs, std::span<double> x,
                           const GmresTarget& target, int max_inner);

  /// Free directions: (1,0),(0,1) in adhesion; the tangent in slip (y part zero); nothing where the bound is zero.
  std::vector<char> kind_;
  Field2 tangent_;
  std::vector<double> stiffness_;  ///< of the circle: excess / (g r) [m/Pa]
  std::vector<double> damping_;    ///< stiffness relative to the diagonal
  Field2 field_, image_;
  Gmres gmres_;
  int sensitivity_products_ = 0;
};

}  // namespace treadmark::kalker
