// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>
#include <vector>

#include "treadmark/core/grid.hpp"

namespace treadmark::io {

/// A line of equal value; closed when its first point is its last.
using ContourLine = std::vector<std::array<double, 2>>;

/// Lines where values at the points of a grid, linear along the sides of its cells, reach a level. A saddle is parted
/// by the mean of its corners. Cells with a corner that is not finite have none. Points in the units of the grid.
/// Thread-safe. Errors: Error(configuration) unless there is a value a point.
std::vector<ContourLine> contour_lines(const Grid2& grid, std::span<const double> values, double level);

}  // namespace treadmark::io
