// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

/// Rigid slip of the elements of a patch of several parts beyond its creepages and spin, per element [-] (shift: [m]).
struct PartSlip {
  std::vector<double> x, y;  ///< empty for a patch of one part
};

/// Every part creeps as about its own contact reference where it feels little of the others, and with the patch where
/// it feels all of them: patches that join or part do not change their slip at once. With one reference alone parts
/// that lie off its tangent plane would. rail: the surface placed by placement.X_TS. Thread-safe.
PartSlip part_slip(const Problem& right_hand_problem, const Placement& placement, const Surface& rail,
                   const PatchSolution& patch, const kalker::SubPatches& parts);

}  // namespace treadmark::wheelrail
