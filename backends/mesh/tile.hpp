// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/kernel_types.hpp"

namespace treadmark::mesh {

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

/// Scan conversion: every triangle over the tile marks the points that it covers and keeps those where it is outermost.
/// The hierarchy is descended only where its nodes hold points that are not yet hidden, so that coarse grids cost like
/// lines. Rounds like ProjectedTriangle, bit by bit. False if the tile has too many triangles: take a smaller one.
bool fill_tile_generic(const MeshArrays& mesh, const PlaneLines& lines, Tile& tile);
bool fill_tile_avx2(const MeshArrays& mesh, const PlaneLines& lines, Tile& tile);

}  // namespace treadmark::mesh
