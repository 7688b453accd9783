// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::mesh {

namespace {

struct Side {
  std::uint64_t edge;  ///< both vertices, the lower one first
  std::uint32_t triangle;
  std::uint32_t corner;  ///< opposite to the edge
  bool operator<(const Side& o) const { return edge != o.edge ? edge < o.edge : triangle < o.triangle; }
};

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

void connect(PreparedMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint64_t a = mesh.triangles[t][(k + 1) % 3], b = mesh.triangles[t][(k + 2) % 3];
      sides.push_back({std::min(a, b) << 32 | std::max(a, b), t, k});
    }
  std::sort(sides.begin(), sides.end());
  mesh.neighbours.assign(mesh.triangles.size(), {kNone, kNone, kNone});
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
    if (end - i > 2) {
      const Vec3 a = mesh.vertices[sides[i].edge >> 32] + mesh.centre,
                 b = mesh.vertices[sides[i].edge & kNone] + mesh.centre;
      throw Error(
          ErrorKind::input_data,
          fmt::format("the mesh '{}' has an edge of {} triangles, from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, "
                      "{:.6g}) m",
                      mesh.name, end - i, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()),
          {}, "a surface has at most two triangles on each edge: remove inner walls and doubled sheets");
    }
    if (end - i == 2) {
      mesh.neighbours[sides[i].triangle][sides[i].corner] = sides[i + 1].triangle;
      mesh.neighbours[sides[i + 1].triangle][sides[i + 1].corner] = sides[i].triangle;
    }
    i = end;
  }
}

std::size_t count_boundary_loops(const PreparedMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<char> on_rim(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.neighbours[t][k] != kNone) continue;
      const std::uint32_t a = mesh.triangles[t][(k + 1) % 3], b = mesh.triangles[t][(k + 2) % 3];
      on_rim[a] = on_rim[b] = 1;
      parent[root_of(parent, a)] = root_of(parent, b);
    }
  std::size_t loops = 0;
  for (std::uint32_t v = 0; v < parent.size(); ++v) loops += on_rim[v] && parent[v] == v;
  return loops;
}

}  // namespace treadmark::mesh
