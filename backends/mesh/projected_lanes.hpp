// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>

#include "treadmark/backends/mesh/kernel_types.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::mesh {
namespace {

using namespace lanes;

constexpr double kNearEdge = 2e-10;  ///< [m] more than kRimTolerance and rounding
constexpr double kEdgeOn = 1e-12;    ///< twice the area in the plane over the longest side squared: far above rounding

// The operations of PlaneView::to_plane and ProjectedTriangle::edges, in their order.

TREADMARK_LANES void project(const MeshArrays& mesh, const PlaneLines& lines, std::uint32_t vertex, double* q) {
  const double* p = mesh.vertices + 3 * static_cast<std::size_t>(vertex);
  const double dx = p[0] - lines.origin[0], dy = p[1] - lines.origin[1], dz = p[2] - lines.origin[2];
  for (int i = 0; i < 3; ++i)
    q[i] = (lines.rotation[0][i] * dx + lines.rotation[1][i] * dy) + lines.rotation[2][i] * dz;
}

/// Corner k of triangle index[l] to q[3k], q[3k + 1], q[3k + 2] of lane l.
TREADMARK_LANES void project_lanes(const MeshArrays& mesh, const PlaneLines& lines,
                                   const std::uint32_t (&index)[kLanes], V4 (&q)[9]) {
  for (int k = 0; k < 3; ++k) {
    const double* p[kLanes];
    for (int l = 0; l < kLanes; ++l)
      p[l] =
          mesh.vertices + 3 * static_cast<std::size_t>(
                                  mesh.triangles[3 * static_cast<std::size_t>(index[l]) + static_cast<std::size_t>(k)]);
    const V4 dx = V4{p[0][0], p[1][0], p[2][0], p[3][0]} - all(lines.origin[0]);
    const V4 dy = V4{p[0][1], p[1][1], p[2][1], p[3][1]} - all(lines.origin[1]);
    const V4 dz = V4{p[0][2], p[1][2], p[2][2], p[3][2]} - all(lines.origin[2]);
    for (int i = 0; i < 3; ++i)
      q[3 * k + i] = (all(lines.rotation[0][i]) * dx + all(lines.rotation[1][i]) * dy) + all(lines.rotation[2][i]) * dz;
  }
}

TREADMARK_LANES void edge_functions(const double* q, double x, double y, double side, double* e) {
  const double ax = q[0] - x, ay = q[1] - y, bx = q[3] - x, by = q[4] - y, cx = q[6] - x, cy = q[7] - y;
  e[0] = side * (bx * cy - by * cx);
  e[1] = side * (cx * ay - cy * ax);
  e[2] = side * (ax * by - ay * bx);
}

}  // namespace

}  // namespace treadmark::mesh
