// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace treadmark::vehicle {

/// A symmetric matrix (complex: not conjugate) whose elements vanish further than band from the diagonal, and its
/// factors L D L' without exchange of rows: for what is positive definite, or whose imaginary part damping makes so.
template <class Scalar>
class BandedSymmetric {
 public:
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  BandedSymmetric() = default;
  BandedSymmetric(int size, int band)
      : size_(size), band_(band), values_(static_cast<std::size_t>(size) * static_cast<std::size_t>(band + 1)) {}

  int size() const { return size_; }
  int band() const { return band_; }

  /// Element (row, column), 0 <= row - column <= band.
  Scalar& at(int row, int column) { return values_[index(row, column)]; }
  const Scalar& at(int row, int column) const { return values_[index(row, column)]; }
  /// Adds to (i, j) and (j, i).
  void add(int i, int j, const Scalar& value) { at(std::max(i, j), std::min(i, j)) += value; }

  /// All stored values; those of equal size and band correspond.
  std::vector<Scalar>& values() { return values_; }
  const std::vector<Scalar>& values() const { return values_; }

  Column times(const Column& x) const {
    Column y = Column::Zero(size_);
    for (int i = 0; i < size_; ++i) {
      y[i] += at(i, i) * x[i];
      for (int j = std::max(0, i - band_); j < i; ++j) {
        y[i] += at(i, j) * x[j];
        y[j] += at(i, j) * x[i];
      }
    }
    return y;
  }

  /// Replaces the matrix by its factors, after which solve may be called and times may not. False: a pivot vanishes.
  bool factorise() {
    for (int j = 0; j < size_; ++j) {
      const Scalar pivot = at(j, j);
      if (!(std::abs(pivot) > 0.0)) return false;
      const int last = std::min(size_ - 1, j + band_);
      for (int i = j + 1; i <= last; ++i) {
        const Scalar part = at(i, j) / pivot;
        for (int k = i; k <= last; ++k) at(k, i) -= part * at(k, j);
      }
      for (int i = j + 1; i <= last; ++i) at(i, j) /= pivot;
    }
    return true;
  }

  /// Replaces b by the solution.
  void solve(Column& b) const {
    for (int i = 0; i < size_; ++i)
      for (int j = std::max(0, i - band_); j < i; ++j) b[i] -= at(i, j) * b[j];
    for (int i = 0; i < size_; ++i) b[i] /= at(i, i);
    for (int i = size_ - 1; i >= 0; --i)
      for (int j = std::max(0, i - band_); j < i; ++j) b[j] -= at(i, j) * b[i];
  }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(band_ + 1) + static_cast<std::size_t>(row - column);
  }

  int size_ = 0, band_ = 0;
  std::vector<Scalar> values_;
};

}  // namespace treadmark::vehicle
