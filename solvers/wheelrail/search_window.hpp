// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/detection/detector.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {

/// First search grid and patch rules of a right-hand pair: across the whole rail head, and as far before and behind the
/// wheel centre as the wheel can touch the rail.
detection::SearchSettings search_settings(const Geometry& geometry, const Problem& right_hand_problem,
                                          const Placement& placement);

/// The mesh of the reference program for undeformed distances, where that is asked for.
std::optional<detection::DistanceMesh> distance_mesh(const Problem& problem);

}  // namespace treadmark::wheelrail
