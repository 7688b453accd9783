// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A grid at a time, as the contact search asks for it.
#include "treadmark/bench/distance/enter.hpp"
#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::bench {
namespace {

std::vector<double> on_grid(const detection::BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C) {
  return detection::undeformed_distance(bodies, X_TC, grid_C).distance;
}

[[maybe_unused]] const bool entered = enter_distance("grid", on_grid);

}  // namespace
}  // namespace treadmark::bench
