// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>

#include "treadmark/backends/spline/section_raster.hpp"
#include "treadmark/core/grid.hpp"

namespace treadmark::spline {

/// A plane grid as lines of points: "along" a line and "across" from line to line.
struct GridLines {
  bool along_is_y = true;
  Vec3 along, across, normal;  ///< unit vectors in the surface frame
  Vec3 origin;                 ///< of the plane, in the surface frame [m]
  Samples samples;             ///< along
  double across_first = 0.0, across_step = 0.0;
  int lines = 0;
  std::size_t along_stride = 1, across_stride = 1;

  GridLines(const PlaneGrid& plane_grid, bool lines_along_y);

  double across_at(int line) const { return across_first + line * across_step; }
};

inline GridLines::GridLines(const PlaneGrid& plane_grid, bool lines_along_y) : along_is_y(lines_along_y) {
  const Grid2& g = plane_grid.grid;
  const Mat3& axes = plane_grid.X_SP.rotation;
  origin = plane_grid.X_SP.origin;
  normal = axes.col(2);
  const auto row = static_cast<std::size_t>(g.nx);
  if (along_is_y) {
    along = axes.col(1), across = axes.col(0);
    samples = {g.y0, g.dy, g.ny};
    across_first = g.x0, across_step = g.dx, lines = g.nx;
    along_stride = row, across_stride = 1;
  } else {
    along = axes.col(0), across = axes.col(1);
    samples = {g.x0, g.dx, g.nx};
    across_first = g.y0, across_step = g.dy, lines = g.ny;
    along_stride = 1, across_stride = row;
  }
}

}  // namespace treadmark::spline
