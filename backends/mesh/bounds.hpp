// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/kernel_types.hpp"

namespace treadmark::mesh {

/// A rectangle of the plane by its middle and half its sides [m].
struct BoundsQuery {
  double x, y, half_x, half_y;
};

/// Range of heights; low > high: nothing there.
struct BoundsFound {
  double low, high;
};

/// Range of what shows its outside over the rectangle. Nodes much smaller than the rectangle and thin ones count as a
/// whole, with the slab that holds them; triangles of leaves by their planes over the common part of their boxes and
/// the rectangle. Whether anything is there at all is decided by triangles that meet the rectangle, or nodes inside of
/// it.
BoundsFound find_bounds_generic(const MeshArrays& mesh, const PlaneLines& lines, const BoundsQuery& query);
BoundsFound find_bounds_avx2(const MeshArrays& mesh, const PlaneLines& lines, const BoundsQuery& query);

}  // namespace treadmark::mesh
