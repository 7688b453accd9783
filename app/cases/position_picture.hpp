// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::app {

/// Wheel over rail at the position of a case, without mechanics: across the track below the wheel's centre.
struct PositionSection {
  std::vector<Vec2> rail,
      wheel;               ///< (y, z) in track axes [m], y increasing; z is NaN where a surface is not seen along z
  double least_gap = 0.0;  ///< along z [m], negative: they lie in each other; NaN: no wheel lies over the rail. 0 where
                           ///< z follows from a force: the wheel is shown where it touches
};

/// Errors: Error(configuration) as Pair::solve.
PositionSection position_section(const io::WheelRailCase& input, const wheelrail::Geometry& geometry);

}  // namespace treadmark::app
