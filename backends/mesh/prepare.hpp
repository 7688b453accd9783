// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/backends/mesh/prepared_mesh.hpp"

namespace treadmark::mesh {

/// Checks and repairs a mesh as make_mesh_surface documents; repair counts what was done.
PreparedMesh prepare(const TriangleMesh& mesh, Body body, MeshRepair& repair);

/// For every vertex the first one within the tolerance of it (itself if there is none before it).
std::vector<std::uint32_t> merge_close(const std::vector<Vec3>& points, double tolerance);

/// Fills mesh.neighbours where no triangle has the corners of another one and no edge has more than two; else false.
bool connect_simply(PreparedMesh& mesh);

/// Fills mesh.neighbours. Error(input_data) for an edge of more than two triangles.
void connect(PreparedMesh& mesh);

/// Turns triangles until neighbours agree and every connected part faces outwards: closed parts enclose a positive
/// volume, open parts of a wheel face away from the axle, of a rail towards -z, by area. Error(input_data) for
/// one-sided parts.
void orient(PreparedMesh& mesh, Body body, MeshRepair& repair);

/// Number of rims and holes.
std::size_t count_boundary_loops(const PreparedMesh& mesh);

}  // namespace treadmark::mesh
