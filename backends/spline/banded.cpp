// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/spline/banded.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"

namespace treadmark::spline {

namespace {

std::size_t index(std::ptrdiff_t row, std::ptrdiff_t offset, std::ptrdiff_t width) {
  return static_cast<std::size_t>(row * width + offset);
}

}  // namespace

BandedCholesky::BandedCholesky(int size, int half_bandwidth)
    : size_(size), band_(half_bandwidth), entries_(index(size, 0, half_bandwidth + 1), 0.0) {}

double& BandedCholesky::at(int i, int j) { return entries_[index(i, j - i + band_, band_ + 1)]; }

void BandedCholesky::factor() {
  for (int i = 0; i < size_; ++i)
    for (int j = std::max(0, i - band_); j <= i; ++j) {
      double sum = at(i, j);
      for (int k = std::max(0, i - band_); k < j; ++k) sum -= at(i, k) * at(j, k);
      if (i > j)
        at(i, j) = sum / at(j, j);
      else if (sum > 0.0)
        at(i, i) = std::sqrt(sum);
      else
        throw Error(ErrorKind::numerical, "the equations of a spline fit are not positive definite", {},
                    "check the data for coinciding points, or change the smoothing");
    }
}

void BandedCholesky::solve(std::span<double> rhs) const {
  const auto l = [this](int i, int j) { return entries_[index(i, j - i + band_, band_ + 1)]; };
  const auto x = [rhs](int i) -> double& { return rhs[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < size_; ++i) {
    for (int k = std::max(0, i - band_); k < i; ++k) x(i) -= l(i, k) * x(k);
    x(i) /= l(i, i);
  }
  for (int i = size_ - 1; i >= 0; --i) {
    for (int k = i + 1; k <= std::min(size_ - 1, i + band_); ++k) x(i) -= l(k, i) * x(k);
    x(i) /= l(i, i);
  }
}

BandedLu::BandedLu(int size, int bandwidth)
    : size_(size),
      band_(bandwidth),
      entries_(index(size, 0, 3 * bandwidth + 1), 0.0),
      pivots_(static_cast<std::size_t>(size), 0) {}

double& BandedLu::entry(int i, int j) { return entries_[index(i, j - i + band_, 3 * band_ + 1)]; }
double BandedLu::entry(int i, int j) const { return entries_[index(i, j - i + band_, 3 * band_ + 1)]; }
double& BandedLu::at(int i, int j) { return entry(i, j); }

void BandedLu::factor() {
  for (int k = 0; k < size_; ++k) {
    const int last_row = std::min(size_ - 1, k + band_);
    const int last_column = std::min(size_ - 1, k + 2 * band_);
    int pivot = k;
    for (int i = k + 1; i <= last_row; ++i)
      if (std::abs(entry(i, k)) > std::abs(entry(pivot, k))) pivot = i;
    if (entry(pivot, k) == 0.0)
      throw Error(ErrorKind::numerical, "the equations of a spline interpolation are singular");
    pivots_[static_cast<std::size_t>(k)] = pivot;
    // Multipliers stay where they are (as in LAPACK), only the remaining columns of the two rows are exchanged.
    if (pivot != k)
      for (int j = k; j <= last_column; ++j) std::swap(entry(pivot, j), entry(k, j));
    for (int i = k + 1; i <= last_row; ++i) {
      const double factor = entry(i, k) /= entry(k, k);
      if (factor != 0.0)
        for (int j = k + 1; j <= last_column; ++j) entry(i, j) -= factor * entry(k, j);
    }
  }
}

void BandedLu::solve(std::span<double> rhs) const {
  const auto x = [rhs](int i) -> double& { return rhs[static_cast<std::size_t>(i)]; };
  for (int k = 0; k < size_; ++k) {
    std::swap(x(k), x(pivots_[static_cast<std::size_t>(k)]));
    for (int i = k + 1; i <= std::min(size_ - 1, k + band_); ++i) x(i) -= entry(i, k) * x(k);
  }
  for (int i = size_ - 1; i >= 0; --i) {
    for (int j = i + 1; j <= std::min(size_ - 1, i + 2 * band_); ++j) x(i) -= entry(i, j) * x(j);
    x(i) /= entry(i, i);
  }
}

BasisPowers basis_powers(std::span<const double> knots, int span) {
  const auto knot = [knots](int i) { return knots[static_cast<std::size_t>(i)]; };
  const double origin = knot(span);
  // Cox-de Boor recursion on polynomials in t instead of values: row b of degree p is the B-spline span - p + b.
  BasisPowers rows{};
  rows[0][0] = 1.0;
  for (int p = 1; p <= 3; ++p) {
    BasisPowers next{};
    for (int b = 0; b <= p; ++b) {
      const int i = span - p + b;
      auto& row = next[static_cast<std::size_t>(b)];
      if (b > 0) {  // (x - k_i) / (k_(i+p) - k_i) times the B-spline i of degree p - 1
        const double scale = 1.0 / (knot(i + p) - knot(i)), shift = origin - knot(i);
        const auto& lower = rows[static_cast<std::size_t>(b - 1)];
        for (std::size_t k = 0; k < static_cast<std::size_t>(p); ++k) {
          row[k] += scale * shift * lower[k];
          row[k + 1] += scale * lower[k];
        }
      }
      if (b < p) {  // (k_(i+p+1) - x) / (k_(i+p+1) - k_(i+1)) times the B-spline i + 1 of degree p - 1
        const double scale = 1.0 / (knot(i + p + 1) - knot(i + 1)), shift = knot(i + p + 1) - origin;
        const auto& lower = rows[static_cast<std::size_t>(b)];
        for (std::size_t k = 0; k < static_cast<std::size_t>(p); ++k) {
          row[k] += scale * shift * lower[k];
          row[k + 1] -= scale * lower[k];
        }
      }
    }
    rows = next;
  }
  return rows;
}

int find_span(std::span<const double> knots, double x, int first, int last) {
  const auto begin = knots.begin() + first + 1, end = knots.begin() + last + 1;
  return first + static_cast<int>(std::upper_bound(begin, end, x) - begin);
}

std::vector<double> extended_knots(std::span<const double> positions) {
  std::vector<double> knots;
  knots.reserve(positions.size() + 6);
  const double first = positions[0], first_step = positions[1] - first;
  const double last = positions.back(), last_step = last - positions[positions.size() - 2];
  for (int i = 3; i >= 1; --i) knots.push_back(first - i * first_step);
  knots.insert(knots.end(), positions.begin(), positions.end());
  for (int i = 1; i <= 3; ++i) knots.push_back(last + i * last_step);
  return knots;
}

double power_value(const std::array<double, 4>& powers, double t) {
  return powers[0] + t * (powers[1] + t * (powers[2] + t * powers[3]));
}

}  // namespace treadmark::spline
