// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/detection/body_pair.hpp"

namespace treadmark::detection {

/// Heights of both bodies and the gap between them on a grid seen along z of the common frame T.
/// gap = z_rail - z_wheel [m]; negative = interpenetration; NaN where one of the surfaces is missing.
struct GapField {
  Grid2 grid;
  std::vector<double> rail_z, wheel_z, gap;  ///< [m]
  std::vector<double> inclination;           ///< of the rail, atan(dz/dy) in T [rad]; empty unless asked for
};

/// Exact evaluation of both surfaces on the grid.
GapField gap_field(const BodyPair& bodies, const Grid2& grid_T, bool with_inclination);

}  // namespace treadmark::detection
