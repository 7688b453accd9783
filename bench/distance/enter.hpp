// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/bench/common/scene.hpp"

namespace treadmark::bench {

/// rail height - wheel height over the elements of a grid in the plane C [m].
using DistanceMethod = std::vector<double> (*)(const detection::BodyPair& bodies, const Pose& X_TC,
                                               const Grid2& grid_C);

/// Enters a way to the undeformed distance, through several backends.
bool enter_distance(const char* name, DistanceMethod method);

}  // namespace treadmark::bench
