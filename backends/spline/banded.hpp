// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

namespace treadmark::spline {

/// Cholesky factorisation of a symmetric positive definite band matrix: fill at(i, j) for j <= i, factor(), then
/// solve().
class BandedCholesky {
 public:
  BandedCholesky(int size, int half_bandwidth);

  /// Entry of the lower triangle, 0 <= i - j <= half bandwidth.
  double& at(int i, int j);
  /// Errors: Error(numerical) if the matrix is not positive definite.
  void factor();
  /// Replaces the right-hand side by the solution.
  void solve(std::span<double> rhs) const;

 private:
  int size_, band_;
  std::vector<double> entries_;
};

/// LU factorisation with row pivoting of a band matrix with equal lower and upper bandwidth.
class BandedLu {
 public:
  BandedLu(int size, int bandwidth);

  /// Entry with |i - j| <= bandwidth.
  double& at(int i, int j);
  /// Errors: Error(numerical) if the matrix is singular.
  void factor();
  /// Replaces the right-hand side by the solution.
  void solve(std::span<double> rhs) const;

 private:
  double& entry(int i, int j);
  double entry(int i, int j) const;

  int size_, band_;
  std::vector<double> entries_;  // row i holds columns i - band .. i + 2 band, the room that pivoting needs
  std::vector<int> pivots_;
};

}  // namespace treadmark::spline
