// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/pair_gradient.hpp"

namespace treadmark::wheelrail {

/// How a right-hand pair is placed by the heights of its surfaces: a rail is held by its gauge point and its top, a
/// wheel by its tape circle. Derivatives [m/m]; empty: not by heights.
struct PlacementChange {
  std::vector<HeightWeights> rail_y, rail_z;  ///< of the rail's origin in T, by heights of the rail
  std::vector<HeightWeights> wheel_z;         ///< of the wheel in its wheelset, by heights of the wheel
  std::string message;                        ///< why it is not known; empty: it is
};
PlacementChange placement_change(const Geometry& geometry, const Problem& right_hand_problem);

}  // namespace treadmark::wheelrail
