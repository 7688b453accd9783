// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/core/grid.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::wheelrail {

/// Errors: Error(configuration) for numbers that are not finite or have no meaning, and for settings that exclude each
/// other.
void validate(const Problem& problem);

/// Elements without an undeformed distance (no surface there) that lie beside elements in contact.
struct MissingSurface {
  int hole = 0;  ///< elements of holes: parts without surface that end within the grid
  int edge = 0;  ///< elements of parts that reach the border of the grid, as beyond the end of a profile
};

/// distance: NaN = no surface; pressure > 0 = contact; both of grid.size(). Only parts that touch contact count, with
/// all their elements (holes) or those beside contact (edges). Thread-safe.
MissingSurface missing_beside_contact(const Grid2& grid, std::span<const double> distance,
                                      std::span<const double> pressure);

}  // namespace treadmark::wheelrail
