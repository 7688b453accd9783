// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>

#include "treadmark/backends/spline/thb/knot_line.hpp"

namespace treadmark::spline {

/// Bernstein coefficients of degree 3 of the same polynomial; the first degree + 1 count.
template <class Point>
void raise_to_cubic(std::array<Point, kMostDegree + 1>& b, int degree) {
  for (int p = degree; p < kMostDegree; ++p)
    for (auto k = static_cast<std::size_t>(p) + 1; k > 0; --k) {
      const double before = static_cast<double>(k) / (p + 1);
      if (k <= static_cast<std::size_t>(p))
        b[k] = before * b[k - 1] + (1.0 - before) * b[k];
      else
        b[k] = before * b[k - 1];
    }
}

/// The same for both directions of b[i][j].
template <class Point>
void raise_to_cubic(std::array<std::array<Point, kMostDegree + 1>, kMostDegree + 1>& b, int degree_u, int degree_v) {
  for (auto& row : b) raise_to_cubic(row, degree_v);
  for (std::size_t j = 0; j <= kMostDegree; ++j) {
    std::array<Point, kMostDegree + 1> column{b[0][j], b[1][j], b[2][j], b[3][j]};
    raise_to_cubic(column, degree_u);
    for (std::size_t i = 0; i <= kMostDegree; ++i) b[i][j] = column[i];
  }
}

}  // namespace treadmark::spline
