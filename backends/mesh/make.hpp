// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::mesh {

/// What is evaluated over the triangle that a line hits.
enum class Refinement {
  facets,  ///< the flat triangle: exact on the mesh as it is
  smooth,  ///< local polynomials fitted at the vertices, blended over the triangle
};

struct MeshOptions {
  Refinement refinement = Refinement::smooth;
  double crease_angle = 0.5235987755982988;  ///< edges that turn more are kept sharp by the smooth refinement [rad]
  std::string backend = "mesh";              ///< what Surface::backend() says
};

/// What was found wrong with a mesh and put right, in numbers of triangles (vertices where it says so).
struct MeshRepair {
  std::size_t merged_vertices = 0;  ///< closer than the tolerance: one vertex
  std::size_t degenerate = 0;       ///< without area: removed
  std::size_t duplicates = 0;       ///< removed
  std::size_t flipped = 0;          ///< turned to agree with their neighbours
  std::size_t unused_vertices = 0;  ///< removed
  std::size_t boundary_loops = 0;   ///< rims and holes that the mesh has (they stay)
  std::size_t parts = 0;            ///< connected parts
  bool turned_inside_out = false;   ///< all triangles faced the material and were turned
};

/// A wheel or rail of triangles and its smooth refinement. Grids: triangles laid over tiles of lines, in double
/// precision; lists of lines: Embree with every hit recomputed in double precision, in builds without it a hierarchy of
/// our own. repair: filled in if not null.
/// Errors: Error(input_data) for an empty mesh, indices out of range, vertices that are not finite, edges of more than
/// two triangles, coordinates that cannot be metres (with a hint on units), a mesh that cannot be oriented. Messages
/// name mesh.name.
std::shared_ptr<const Surface> make_mesh_surface(TriangleMesh mesh, Body body, const MeshOptions& options = {},
                                                 MeshRepair* repair = nullptr);

/// The same by that hierarchy alone, line by line and all in double precision: slower, independent of Embree and of
/// kernels; for checking.
std::shared_ptr<const Surface> make_mesh_oracle(TriangleMesh mesh, Body body, const MeshOptions& options = {},
                                                MeshRepair* repair = nullptr);

/// What make_mesh_surface would repair, and its errors.
MeshRepair check_mesh(const TriangleMesh& mesh, Body body);

}  // namespace treadmark::mesh
