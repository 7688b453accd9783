// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/grid.hpp"

namespace treadmark::pictures {

/// A set of cells of a regular grid, row-major.
struct CellMask {
  int nx = 0, ny = 0;
  std::vector<char> inside;

  bool at(int ix, int iy) const {
    return ix >= 0 && iy >= 0 && ix < nx && iy < ny &&
           inside[static_cast<std::size_t>(ix) + static_cast<std::size_t>(nx) * static_cast<std::size_t>(iy)] != 0;
  }
};

/// Closed loop of corners in cell units (cell ix, iy spans [ix, ix+1] x [iy, iy+1]).
using Loop = std::vector<std::array<int, 2>>;

/// Boundary of the set; holes run the other way round, so that both fill rules agree. Thread-safe.
std::vector<Loop> outline(const CellMask& mask);

/// SVG path data of loops in cell units.
std::string path_in_cells(const std::vector<Loop>& loops);

/// SVG path data with the corners at (x0 + ix * step_x, y0 + iy * step_y).
std::string path_at(const std::vector<Loop>& loops, double x0, double y0, double step_x, double step_y);

/// A line of equal value; closed when its first point is its last.
using ContourLine = std::vector<std::array<double, 2>>;

/// Lines where values at the points of a grid, linear along the sides of its cells, reach a level. A saddle is parted
/// by the mean of its corners. Cells with a corner that is not finite have none. Points in the units of the grid.
/// Thread-safe. Errors: Error(configuration) unless there is a value a point.
std::vector<ContourLine> contour_lines(const Grid2& grid, std::span<const double> values, double level);

}  // namespace treadmark::pictures
