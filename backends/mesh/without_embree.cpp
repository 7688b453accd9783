// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::mesh {

std::shared_ptr<const Surface> make_mesh_surface(TriangleMesh, Body, const MeshOptions&, MeshRepair*) {
  left_out("embree", "surfaces of triangles");
}

std::shared_ptr<const Surface> make_mesh_oracle(TriangleMesh, Body, const MeshOptions&, MeshRepair*) {
  left_out("embree", "surfaces of triangles");
}

std::size_t surfaces_made() { return 0; }

MeshRepair check_mesh(const TriangleMesh&, Body) { left_out("embree", "surfaces of triangles"); }

}  // namespace treadmark::mesh
