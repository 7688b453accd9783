// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/bspline_basis.hpp"

#include <algorithm>

namespace treadmark::spline {

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
