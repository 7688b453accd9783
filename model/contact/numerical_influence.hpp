// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <vector>

namespace treadmark {

/// Coefficients of influence computed elsewhere (finite elements) for one loaded element in the middle of a grid: u =
/// (1/G) C p. values[iy * nx + ix] holds C [m] at the offset (ix - (nx - 1)/2) dx, (iy - (ny - 1)/2) dy of observation
/// minus load, rows n, x, y by columns n, x, y: nn, nx, ny, xn, xx, xy, yn, yx, yy.
struct NumericalInfluence {
  int nx = 0, ny = 0;         ///< odd
  double dx = 0.0, dy = 0.0;  ///< [m]
  std::vector<std::array<double, 9>> values;
};

}  // namespace treadmark
