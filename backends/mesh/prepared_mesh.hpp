// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::mesh {

inline constexpr std::uint32_t kNone = 0xffffffffu;

using Corners = std::array<std::uint32_t, 3>;

/// A mesh fit for queries: no coincident vertices, no triangles without area, at most two triangles an edge, all of
/// them counter-clockwise seen from outside. Local coordinates: the centre of the mesh is subtracted, so that single
/// precision does for finding triangles.
struct PreparedMesh {
  std::string name;
  Vec3 centre = Vec3::Zero();                    ///< in the surface frame [m]
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box, local [m]
  std::vector<Vec3> vertices;                    ///< local [m]
  std::vector<Corners> triangles;
  std::vector<Corners> neighbours;  ///< triangle across the edge opposite to corner k; kNone at a rim

  std::size_t memory_bytes() const {
    return vertices.capacity() * sizeof(Vec3) + (triangles.capacity() + neighbours.capacity()) * sizeof(Corners);
  }
};

/// Twice the area times the unit normal.
inline Vec3 doubled_area(const PreparedMesh& mesh, std::size_t t) {
  const Corners& c = mesh.triangles[t];
  const Vec3& a = mesh.vertices[c[0]];
  return (mesh.vertices[c[1]] - a).cross(mesh.vertices[c[2]] - a);
}

}  // namespace treadmark::mesh
