// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <utility>
#include <vector>

#include "treadmark/damage/record.hpp"

namespace treadmark::damage {

/// Cells and shares of them; the shares of one element sum up to one.
using Shares = std::vector<std::pair<int, double>>;

/// Cells of step d, the middle of the first at x0, below a box of half-width a round a middle that moves by b to both
/// sides.
Shares shares_of(double middle, double a, double b, double x0, double d);

/// Number of a column that exists; of a rail it may lie outside.
int wrapped(const SurfaceCells& cells, int i);

/// Whether there is surface in a row.
bool exists(const SurfaceCells& cells, int j);

/// Rows between two places across; what hangs over the border of the surface goes to the rows that are there, none:
/// there is no surface.
Shares rows_between(const SurfaceCells& cells, double y_low, double y_high);

/// Columns under a piece of some length at u that moves along a stretch, on a row of a radius. Columns of a rail may
/// lie outside.
Shares columns_under(const SurfaceCells& cells, double u, double length, const Stretch& stretch, double radius);

}  // namespace treadmark::damage
