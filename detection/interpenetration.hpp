// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/detection/gap_field.hpp"

namespace treadmark::detection {

/// Weight of a penetration g in the weighted contact reference.
enum class PenetrationWeight { linear, squared };

/// A connected interpenetration region of a gap field, or a near miss (positive least gap).
struct Region {
  int ix_min = 0, ix_max = 0, iy_min = 0,
      iy_max = 0;  ///< bounding box with one guard row and column where the grid has them
  int ix_deepest = 0, iy_deepest = 0;
  double least_gap = 0.0;            ///< [m]
  double weight = 0.0;               ///< integral of the weight over the region; 0 for a near miss
  double x = 0.0, y = 0.0, z = 0.0;  ///< weighted centre, z on the rail [m]; of a near miss: the grid point
  double inclination = 0.0;          ///< weighted rail inclination [rad]
  bool near_miss() const { return !(least_gap < 0.0); }
};

/// All interpenetration regions, deepest first, followed by at most two near misses with a gap below near_miss_gap
/// (Figure 3 a-e of Vollebregt's paper on 3D wheel and rail surfaces). wheel_dz: the wheel has moved by this along z of
/// T since the field was made, so that every gap is less by it [m]. Without a weight x, y, z, inclination and weight of
/// regions are not found out, only of near misses.
std::vector<Region> find_regions(const GapField& field, double wheel_dz, std::optional<PenetrationWeight> weight,
                                 double near_miss_gap);

}  // namespace treadmark::detection
