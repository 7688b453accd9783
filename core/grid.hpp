// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>

#include "treadmark/core/pose.hpp"

namespace treadmark {

/// Regular grid of points in a plane. Fields on it are row-major: index = ix + nx * iy.
struct Grid2 {
  double x0 = 0.0, y0 = 0.0;  ///< first point (for contact grids: centre of the first element) [m]
  double dx = 0.0, dy = 0.0;  ///< steps [m], > 0
  int nx = 0, ny = 0;         ///< points along x and y

  /// Of the points of a column [m].
  double x(int ix) const { return x0 + ix * dx; }
  /// Of the points of a row [m].
  double y(int iy) const { return y0 + iy * dy; }
  /// Number of points.
  std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  /// Where the value of a point stands in a field.
  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(ix) + static_cast<std::size_t>(nx) * static_cast<std::size_t>(iy);
  }
  /// Of one element [m^2].
  double cell_area() const { return dx * dy; }
  friend bool operator==(const Grid2&, const Grid2&) = default;
};

/// A grid lying in a plane frame P that has pose X_SP in a surface's frame S. Heights are measured along P's z axis.
struct PlaneGrid {
  Pose X_SP;
  Grid2 grid;
};

}  // namespace treadmark
