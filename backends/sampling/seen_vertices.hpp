// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::sampling {

/// Those of the vertices of a surface in a region that lines of the natural view meet first, where it is no steeper
/// than 75 degrees in that view, in their order. Parallel.
std::vector<Vec3> seen_vertices(const Surface& surface, Body body, std::span<const Vec3> vertices,
                                const Region& region);

}  // namespace treadmark::sampling
