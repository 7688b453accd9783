// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/make.hpp"

#include <cmath>

#include "treadmark/backends/mesh/mesh_surface.hpp"
#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::mesh {

namespace {

std::shared_ptr<const Surface> make(TriangleMesh mesh, Body body, const MeshOptions& options, MeshRepair* repair,
                                    bool one_by_one) {
  if (!(options.crease_angle >= 0.0 && std::isfinite(options.crease_angle)))
    throw Error(ErrorKind::configuration, "the crease angle of a mesh must be a number that is not negative");
  MeshRepair found;
  PreparedMesh prepared = prepare(mesh, body, found);
  mesh = {};
  if (repair) *repair = found;
  return std::make_shared<MeshSurface>(std::move(prepared), body, options, one_by_one);
}

}  // namespace

std::shared_ptr<const Surface> make_mesh_surface(TriangleMesh mesh, Body body, const MeshOptions& options,
                                                 MeshRepair* repair) {
  return make(std::move(mesh), body, options, repair, false);
}

std::shared_ptr<const Surface> make_mesh_oracle(TriangleMesh mesh, Body body, const MeshOptions& options,
                                                MeshRepair* repair) {
  return make(std::move(mesh), body, options, repair, true);
}

MeshRepair check_mesh(const TriangleMesh& mesh, Body body) {
  MeshRepair found;
  prepare(mesh, body, found);
  return found;
}

}  // namespace treadmark::mesh
