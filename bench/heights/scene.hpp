// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::bench {

/// One damaged surface in one representation, and a plane over the damage.
struct Subject {
  std::string name;                           ///< "wheel/mesh/0.5mm"
  std::shared_ptr<const Surface> surface;
  Pose level, tilted;                         ///< planes over the damage
  Grid2 grid;                                 ///< 200 x 150 points of the contact area's size
};

/// Wheel with a flat of 160 x 60 mm and rail with a squat, in every backend at 1 and 0.25 mm. Built once. Every subject has
/// been compared with the analytic one on the grid: those that differ by more than the representation may are not handed out,
/// and the program says so and fails.
const std::vector<Subject>& subjects();

}  // namespace treadmark::bench
