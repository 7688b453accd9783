// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>

namespace treadmark::mesh {

// What the kernels see of a mesh, a plane and a grid: plain arrays, because kernels include no header with inline
// functions (core/cpu.hpp).

/// A node of the hierarchy (bvh.hpp).
struct BvhNode {
  double middle[3], half[3];            ///< box, local [m]
  float normal_low[3], normal_high[3];  ///< range of the unit normals of facets and surface, rounded outwards
  float slab_normal[3];                 ///< slab that holds the triangles: slab_low <= n.(p - middle) <= slab_high [m];
  float slab_low, slab_high;            ///< n = 0: none
  float margin;                         ///< of the surface about the triangles, along the normals [m]
  std::uint32_t begin, count;           ///< triangles; the left child of an inner node follows it
  std::uint32_t right;                  ///< right child, 0 for leaves
};

struct MeshArrays {
  const double* vertices;           ///< x, y, z, local [m]
  const std::uint32_t* triangles;   ///< three vertices each
  const std::uint32_t* neighbours;  ///< across the edge opposite to each corner
  const BvhNode* nodes;
  const float* about;  ///< margin [m] and mean normal of the surface about each triangle; null without one
};

/// Lines along the z axis of a plane (plane_view.hpp).
struct PlaneLines {
  double origin[3];       ///< local [m]
  double rotation[3][3];  ///< row: local component, column: axis of the plane
  double side;            ///< outwards along z: +1 wheel, -1 rail
};

constexpr double kBoxRounding = 1e-11;  ///< [m] for comparisons of heights and boxes at coordinates up to 100 m
constexpr double kSameHeight = 1e-11;   ///< [m] the two sides of a fold meet at one height: its outside is seen

}  // namespace treadmark::mesh
