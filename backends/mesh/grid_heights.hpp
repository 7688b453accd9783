// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/backends/mesh/point_heights.hpp"
#include "treadmark/backends/mesh/smooth_patches.hpp"

namespace treadmark::mesh {

/// Heights over a grid, tile by tile, by scan conversion. smooth may be null.
void grid_heights(const PreparedMesh& mesh, const Bvh& bvh, const SmoothPatches* smooth, const PlaneView& view,
                  const Grid2& grid, const Results& results);

}  // namespace treadmark::mesh
