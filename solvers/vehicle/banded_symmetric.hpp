// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace treadmark::vehicle {

/// A symmetric matrix (complex: not conjugate) whose elements vanish further than kBand from the diagonal, and its
/// factors L D L' without exchange of rows: for what is positive definite, or whose imaginary part damping makes so.
template <class Scalar, int kBand = 4>
class BandedSymmetric {
 public:
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  BandedSymmetric() = default;
  explicit BandedSymmetric(int size)
      : size_(size), values_(static_cast<std::size_t>(size) * (kBand + 1) + kBand, Scalar(0)) {}

  int size() const { return size_; }

  /// Element (row, column), 0 <= row - column <= kBand.
  Scalar& at(int row, int column) { return values_[index(row, column)]; }
  const Scalar& at(int row, int column) const { return values_[index(row, column)]; }
  /// Adds to (i, j) and (j, i).
  void add(int i, int j, const Scalar& value) { at(std::max(i, j), std::min(i, j)) += value; }

  /// All stored values; those of equal size correspond.
  std::vector<Scalar>& values() { return values_; }
  const std::vector<Scalar>& values() const { return values_; }

  Column times(const Column& x) const {
    Column y = diagonal(0).cwiseProduct(x);
    for (int k = 1; k <= kBand; ++k) {
      const Eigen::Index rest = size_ - k;
      y.tail(rest) += diagonal(k).cwiseProduct(x.head(rest));
      y.head(rest) += diagonal(k).cwiseProduct(x.tail(rest));
    }
    return y;
  }

  /// x' A x
  Scalar form(const Column& x) const {
    Scalar sum = (diagonal(0).array() * x.array().square()).sum();
    for (int k = 1; k <= kBand; ++k) {
      const Eigen::Index rest = size_ - k;
      sum += Scalar(2) * (diagonal(k).array() * x.head(rest).array() * x.tail(rest).array()).sum();
    }
    return sum;
  }

  /// Replaces the matrix by its factors, after which solve may be called and times may not. False: a pivot vanishes.
  bool factorise() {
    for (int j = 0; j < size_; ++j) {
      const Scalar pivot = at(j, j);
      if (!(std::abs(pivot) > 0.0)) return false;
      const int last = std::min(size_ - 1, j + kBand);
      for (int i = j + 1; i <= last; ++i) {
        const Scalar part = at(i, j) / pivot;
        for (int k = i; k <= last; ++k) at(k, i) -= part * at(k, j);
      }
      for (int i = j + 1; i <= last; ++i) at(i, j) /= pivot;
    }
    for (int j = 0; j < size_; ++j) at(j, j) = Scalar(1) / at(j, j);  // what solve multiplies by
    return true;
  }

  /// Replaces b by the solution.
  void solve(Column& b) const {
    // What the next row needs does not pass through memory.
    std::array<Scalar, kBand> last{};
    const auto keep = [&last](Scalar value) {
      for (std::size_t k = kBand - 1; k > 0; --k) last[k] = last[k - 1];
      return last[0] = value;
    };
    for (int i = 0; i < size_; ++i) {
      Scalar value = b[i];
      for (int k = kBand; k > 0; --k) value -= at(i, i - k) * last[static_cast<std::size_t>(k - 1)];
      b[i] = keep(value);
    }
    b.array() *= diagonal(0).array();
    last.fill(Scalar(0));
    for (int i = size_ - 1; i >= 0; --i) {
      Scalar value = b[i];
      for (int k = kBand; k > 0; --k) value -= at(i + k, i) * last[static_cast<std::size_t>(k - 1)];
      b[i] = keep(value);
    }
  }

 private:
  /// Diagonal after diagonal. Before each of those below the main one, and at the end, are as many zeros as it is away.
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row - column) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(row);
  }
  /// Elements (k, 0), (k + 1, 1) and so on.
  Eigen::Map<const Column> diagonal(int k) const { return {values_.data() + index(k, 0), size_ - k}; }

  int size_ = 0;
  std::vector<Scalar> values_;
};

}  // namespace treadmark::vehicle
