// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/detection/detector.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {

/// The wheel circle is followed up to this angle on both sides [rad]: further out no wheel can touch a rail or roller.
inline constexpr double kHalfAngle = 0.2;

/// A number of points of a search grid. Errors: Error(configuration) for one that elements are too small for.
int checked_count(double n);
inline int odd(int n) { return n % 2 == 0 ? n + 1 : n; }

/// First search grid and patch rules of a right-hand pair: across the whole rail head, and as far before and behind the
/// wheel centre as the wheel can touch the rail.
/// memory: as of place().
detection::SearchSettings search_settings(const Geometry& geometry, const Problem& right_hand_problem,
                                          const Placement& placement, RailMemory* memory = nullptr);

}  // namespace treadmark::wheelrail
