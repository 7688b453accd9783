// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/tangential/friction_newton.hpp"

namespace treadmark::kalker {

struct FrictionSolveResult {
  bool converged = false;
  int steps = 0;   ///< Newton steps
  int sweeps = 0;  ///< of the fall-back
};

/// Newton's method, and Gauss-Seidel sweeps to get on where it makes no progress.
class FrictionSolve {
 public:
  /// max_iterations: Newton steps at a time, and sweeps in total, before giving up. updated: as in NewtonSettings.
  FrictionSolveResult run(const FrictionProblem& problem, FrictionState& state, double eps, int max_iterations,
                          bool updated = false);
  /// Sweeps alone, for comparison.
  FrictionSolveResult run_sweeps(const FrictionProblem& problem, FrictionState& state, double eps, int max_iterations);

  FrictionNewton& newton() { return newton_; }

 private:
  FrictionNewton newton_;
};

}  // namespace treadmark::kalker
