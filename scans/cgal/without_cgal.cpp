// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/scans/cgal/free_mesh.hpp"
#include "treadmark/scans/cgal/plane_triangulation.hpp"

namespace treadmark::scans {

std::vector<Triangle> triangulate_plane(std::span<const Vec2>, double, double) {
  left_out("cgal", "the triangulation of points");
}

std::vector<std::uint32_t> decimate_plane(std::span<const Vec2>, std::span<const double>, double, double) {
  left_out("cgal", "the decimation of points");
}

TriangleMesh mesh_points(std::span<const Vec3>, std::span<const Vec3>, const FreeMeshSettings&, FreeMeshReport*) {
  left_out("cgal", "meshing of points that are no graph");
}

}  // namespace treadmark::scans
