// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/SparseCore>

namespace treadmark::spline {

/// Symmetric equations of least squares for the coordinates of coefficients. Errors: Error(numerical) if they are
/// singular.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t unknowns) : right_(static_cast<Eigen::Index>(unknowns), 3) { right_.setZero(); }

  void add(std::size_t i, std::size_t j, double value) {
    entries_.emplace_back(static_cast<int>(i > j ? i : j), static_cast<int>(i > j ? j : i), value);
  }
  template <class Row>
  void add_right(std::size_t i, const Row& row) {
    right_.row(static_cast<Eigen::Index>(i)) += row;
  }

  using Solution = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  /// For bands. The entries are gone then, here and below.
  Solution solve();
  /// For many unknowns, as well conditioned as bases of B-splines are: to some digits of the greatest number.
  Solution iterate();

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  Matrix matrix();
  Solution checked(Solution x) const;

  std::vector<Eigen::Triplet<double>> entries_;
  Solution right_;
};

}  // namespace treadmark::spline
