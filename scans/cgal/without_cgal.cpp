// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/error.hpp"
#include "treadmark/scans/cgal/free_mesh.hpp"
#include "treadmark/scans/cgal/plane_triangulation.hpp"
#include "treadmark/scans/cgal/stray_points.hpp"

namespace treadmark::scans {

namespace {

[[noreturn]] void throw_without(const char* what) {
  throw Error(ErrorKind::configuration, std::string(what) + " needs CGAL, which this build leaves out", {},
              "configure with -DTREADMARK_WITH_CGAL=ON and install libcgal-dev");
}

}  // namespace

bool have_cgal() { return false; }

StrayResult find_strays(std::span<const Vec3>, const StraySettings&) { throw_without("finding stray points"); }

std::vector<Triangle> triangulate_plane(std::span<const Vec2>, double, double) {
  throw_without("triangulating points");
}

std::vector<std::uint32_t> decimate_plane(std::span<const Vec2>, std::span<const double>, double, double) {
  throw_without("decimating points");
}

TriangleMesh mesh_points(std::span<const Vec3>, std::span<const Vec3>, const FreeMeshSettings&, FreeMeshReport*) {
  throw_without("meshing points that are no graph");
}

}  // namespace treadmark::scans
