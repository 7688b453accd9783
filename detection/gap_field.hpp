// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/detection/body_pair.hpp"
#include "treadmark/detection/wheel_facets.hpp"

namespace treadmark::detection {

/// Heights of both bodies and the gap between them on a grid seen along z of the common frame T.
/// gap = z_rail - z_wheel [m]; negative = interpenetration; NaN where one of the surfaces is missing.
struct GapField {
  Grid2 grid;
  std::vector<double> rail_z, wheel_z, gap;  ///< [m]
  std::vector<double> inclination;           ///< of the rail, atan(dz/dy) in T [rad]; empty unless asked for
};

/// Evaluation of both surfaces on the grid: exact, or the wheel by its facets if these are given.
GapField gap_field(const BodyPair& bodies, const Grid2& grid_T, bool with_inclination,
                   const std::optional<WheelFacets>& facets = std::nullopt);

}  // namespace treadmark::detection
