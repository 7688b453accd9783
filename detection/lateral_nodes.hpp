// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

/// Lateral range [m].
struct LateralInterval {
  double low = 0.0, high = 0.0;
};

/// Lateral positions [m] at which the data of a surface lie on the line x of a plane P, increasing; where the surface
/// can be seen. Empty if the surface was not made from data, or does not tell.
std::vector<double> lateral_nodes(const Surface& surface, const Pose& X_SP, double x_P, const LateralInterval& y_P);

}  // namespace treadmark::detection
