// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::scans {

struct HoleReport {
  std::size_t holes = 0, filled = 0;
  double largest_left = 0.0;  ///< diameter of the largest hole that stays
};

/// Makes a mesh an oriented manifold (vertices where parts only touch are doubled, vertices without triangles dropped),
/// turns each connected part to the side of outward (a vector a vertex), and fills holes up to a diameter of hole_limit
/// with triangles that continue the surface (Liepa 2003), their size and curvature those of the rim. The diameter of a
/// border is the largest distance of two of its vertices. Those up to `gap` are filled without being counted as holes.
/// The longest border of each part is its outer rim, and so is any other at least half as wide (a tube has two rims):
/// none is filled.
HoleReport close_holes(TriangleMesh& mesh, std::span<const Vec3> outward, double gap, double hole_limit);

}  // namespace treadmark::scans
