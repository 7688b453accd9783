// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

/// A symmetric matrix (complex: not conjugate) whose elements vanish further than a band from the diagonal, and its
/// factors L D L' without exchange of rows: for what is positive definite, or whose imaginary part damping makes so.
template <class Scalar>
class BandedSymmetric {
 public:
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  BandedSymmetric() = default;
  /// band: 4 or 6. Errors: Error(configuration).
  BandedSymmetric(int size, int band)
      : size_(size),
        band_(band),
        values_(static_cast<std::size_t>(size) * (static_cast<std::size_t>(band) + 1) + static_cast<std::size_t>(band),
                Scalar(0)) {
    if (band != 4 && band != 6) throw Error(ErrorKind::configuration, "the band of a matrix must be 4 or 6");
  }

  int size() const { return size_; }
  int band() const { return band_; }

  /// Element (row, column), 0 <= row - column <= band.
  Scalar& at(int row, int column) { return values_[index(row, column)]; }
  const Scalar& at(int row, int column) const { return values_[index(row, column)]; }
  /// Adds to (i, j) and (j, i).
  void add(int i, int j, const Scalar& value) { at(std::max(i, j), std::min(i, j)) += value; }

  /// All stored values; those of equal size correspond.
  std::vector<Scalar>& values() { return values_; }
  const std::vector<Scalar>& values() const { return values_; }

  Column times(const Column& x) const {
    Column y = diagonal(0).cwiseProduct(x);
    for (int k = 1; k <= band_; ++k) {
      const Eigen::Index rest = size_ - k;
      y.tail(rest) += diagonal(k).cwiseProduct(x.head(rest));
      y.head(rest) += diagonal(k).cwiseProduct(x.tail(rest));
    }
    return y;
  }

  /// x' A x
  Scalar form(const Column& x) const {
    Scalar sum = (diagonal(0).array() * x.array().square()).sum();
    for (int k = 1; k <= band_; ++k) {
      const Eigen::Index rest = size_ - k;
      sum += Scalar(2) * (diagonal(k).array() * x.head(rest).array() * x.tail(rest).array()).sum();
    }
    return sum;
  }

  /// Replaces the matrix by its factors, after which solve may be called and times may not. False: a pivot vanishes.
  bool factorise() {
    return for_band([this](auto band) { return factorise_in<decltype(band)::value>(); });
  }

  /// Replaces b by the solution.
  void solve(Column& b) const {
    for_band([&](auto band) { solve_in<decltype(band)::value>(b); });
  }

 private:
  /// Loops over a band are known when compiling.
  template <class Do>
  auto for_band(Do&& what) const {
    return band_ == 4 ? what(std::integral_constant<int, 4>{}) : what(std::integral_constant<int, 6>{});
  }

  template <int kBand>
  bool factorise_in() {
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

  template <int kBand>
  void solve_in(Column& b) const {
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

  /// Diagonal after diagonal. Before each of those below the main one, and at the end, are as many zeros as it is away.
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row - column) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(row);
  }
  /// Elements (k, 0), (k + 1, 1) and so on.
  Eigen::Map<const Column> diagonal(int k) const { return {values_.data() + index(k, 0), size_ - k}; }

  int size_ = 0, band_ = 0;
  std::vector<Scalar> values_;
};

}  // namespace treadmark::vehicle
