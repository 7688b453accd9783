// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>

namespace treadmark::mesh {

// What the kernels see of a mesh, a plane and a grid: plain arrays, because kernels include no header with inline
// functions (core/kernel.hpp).

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

/// A rectangle of the plane by its middle and half its sides [m].
struct BoundsQuery {
  double x, y, half_x, half_y;
};

/// Range of heights; low > high: nothing there.
struct BoundsFound {
  double low, high;
};

struct BoundsKernel {
  /// Range of what shows its outside over the rectangle. Nodes much smaller than the rectangle and thin ones count as a
  /// whole, with the slab that holds them; triangles of leaves by their planes over the common part of their boxes and
  /// the rectangle. Whether anything is there at all is decided by triangles that meet the rectangle, or nodes inside
  /// of it.
  BoundsFound (*find)(const MeshArrays& mesh, const PlaneLines& lines, const BoundsQuery& query);

  static const BoundsKernel generic;
  static const BoundsKernel* const avx2;  ///< nullptr if this build has none
};

/// A triangle that shows its outside over points of a tile, in the plane frame.
struct TileTriangle {
  double q[9];  ///< x, y, z of the three corners
  std::uint32_t index;
};

/// A small piece of a grid with, for every point, the outermost triangle found so far. Rows are kStride apart.
struct Tile {
  static constexpr int kWide = 32, kHigh = 32;
  static constexpr int kPad = 4;  ///< entries behind a row that lanes may touch
  static constexpr int kStride = kWide + kPad;
  static constexpr int kSlots = 2 * kWide * kHigh;
  static constexpr std::int64_t kNobody = -1, kRim = -2,
                                kInside = -3;  ///< kRim: close to an edge, kInside: seen from inside

  double x[kStride], y[kHigh + kPad];  ///< places of the points [m]
  double inverse_dx, inverse_dy;       ///< [1/m]
  int nx, ny;

  double depth[kStride * kHigh];        ///< outwards, of the outermost triangle; -inf without one
  std::int64_t owner[kStride * kHigh];  ///< number in triangles, or one of the above
  bool asked[kStride * kHigh];          ///< too close to call: the hierarchy decides
  bool any_asked;
  TileTriangle triangles[kSlots];
  int used;  ///< of triangles
};

struct TileKernel {
  /// Scan conversion: every triangle over the tile marks the points that it covers and keeps those where it is
  /// outermost. The hierarchy is descended only where its nodes hold points that are not yet hidden, so that coarse
  /// grids cost like lines. Rounds like ProjectedTriangle, bit by bit. False if the tile has too many triangles: take a
  /// smaller one.
  bool (*fill)(const MeshArrays& mesh, const PlaneLines& lines, Tile& tile);

  static const TileKernel generic;
  static const TileKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::mesh
