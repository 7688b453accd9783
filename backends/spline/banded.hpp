// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
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

/// powers[b][k]: coefficient of t^k, t = x - knots[span], of the b-th of the four cubic B-splines that do not vanish on
/// [knots[span], knots[span + 1]); these are the B-splines span - 3 .. span (de Boor 1978).
using BasisPowers = std::array<std::array<double, 4>, 4>;

/// knots: non-decreasing, knots[span] < knots[span + 1], three knots on both sides of the span.
BasisPowers basis_powers(std::span<const double> knots, int span);

/// Index of the span that holds x, clamped to [first, last].
int find_span(std::span<const double> knots, double x, int first, int last);

/// The positions as single knots, continued at both ends by three knots with the spacing of the first and last
/// interval.
std::vector<double> extended_knots(std::span<const double> positions);

/// Value of a polynomial basis row at t.
double power_value(const std::array<double, 4>& powers, double t);

}  // namespace treadmark::spline
