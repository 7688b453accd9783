// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/thb/normal_equations.hpp"

#include <utility>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::spline {

NormalEquations::Matrix NormalEquations::matrix() {
  Matrix out(right_.rows(), right_.rows());
  out.setFromTriplets(entries_.begin(), entries_.end());
  std::vector<Eigen::Triplet<double>>().swap(entries_);
  check_cancelled();
  return out;
}

NormalEquations::Solution NormalEquations::checked(Solution x) const {
  if (x.rows() != right_.rows() || !x.allFinite())
    throw Error(ErrorKind::numerical, "the equations of a hierarchical spline are singular", {},
                "take a larger resolution, or leave out places without points");
  return x;
}

NormalEquations::Solution NormalEquations::solve() {
  const Eigen::SimplicialLDLT<Matrix> method(matrix());
  return checked(method.info() == Eigen::Success ? Solution(method.solve(right_)) : Solution());
}

NormalEquations::Solution NormalEquations::iterate() {
  constexpr double kDigits = 1e-7;
  constexpr int kMostSteps = 500;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower> steps;
  steps.setTolerance(kDigits);
  steps.setMaxIterations(kMostSteps);
  const Matrix m = matrix();
  steps.compute(m);
  return checked(steps.solve(right_));
}

}  // namespace treadmark::spline
