// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/profile.hpp"

namespace treadmark::sampling {

/// As often as the last bits of a number far from 0 allow.
inline constexpr int kMostHalvings = 100;

/// Lateral positions y [m] so that no step along any of the sections at the given stations is longer than spacing [m].
/// They run from the first to the last y in [y_min, y_max] at which a section has a surface (common: all sections).
/// Errors: Error(configuration) if the spacing is not positive, if nothing limits y, or if no section has a surface.
std::vector<double> lateral_nodes(const Surface& surface, Body body, std::span<const double> stations, double spacing,
                                  double y_min, double y_max, bool common = false);

}  // namespace treadmark::sampling
