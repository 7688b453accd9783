// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/sectors.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "treadmark/backends/mesh/vertex_fit.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/parallel_blocks.hpp"

namespace treadmark::mesh {

namespace {

std::uint32_t root_corner(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// The sectors where each vertex has one, which gets its number: the triangles round it follow each other over edges
/// that are smooth, and triangles name the vertices in their order. Nothing otherwise.
template <class Smooth>
std::optional<Sectors> one_a_vertex(const PreparedMesh& mesh, const Smooth& smooth) {
  Sectors out;
  out.begin.assign(mesh.vertices.size() + 1, 0);
  std::uint32_t named = 0;
  CheckPoint check;
  for (const Corners& c : mesh.triangles) {
    check.pass();
    for (const std::uint32_t v : c) {
      if (v > named) return std::nullopt;
      named = std::max(named, v + 1);
      ++out.begin[v + 1];
    }
  }
  if (named != mesh.vertices.size()) return std::nullopt;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) out.begin[v + 1] += out.begin[v];
  out.triangles.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(out.begin.begin(), out.begin.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    check.pass();
    for (const std::uint32_t v : mesh.triangles[t]) out.triangles[next[v]++] = t;
  }
  out.vertex.resize(mesh.vertices.size());
  std::iota(out.vertex.begin(), out.vertex.end(), 0u);

  /// Triangles met from t on round v over one side of each; all of them where the way comes back to t.
  const auto walk = [&](std::uint32_t v, std::uint32_t t, std::size_t side) {
    std::size_t count = 0;
    for (std::uint32_t at = t;;) {
      const Corners& c = mesh.triangles[at];
      const std::size_t corner = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      const std::uint32_t across = mesh.neighbours[at][(corner + side) % 3];
      if (across == kNone || !smooth(at, across)) return count;
      ++count;
      if (across == t) return count;
      at = across;
    }
  };
  constexpr std::size_t kTask = 4096;
  std::atomic<bool> whole = true;
  parallel_blocks(mesh.vertices.size(), kTask, [&](std::size_t from, std::size_t to) {
    for (std::size_t v = from; v < to && whole.load(std::memory_order_relaxed); ++v) {
      const auto own = out.around(static_cast<std::uint32_t>(v));
      const std::size_t one = walk(static_cast<std::uint32_t>(v), own.front(), 1);
      if (one < own.size() && 1 + one + walk(static_cast<std::uint32_t>(v), own.front(), 2) < own.size()) whole = false;
    }
  });
  if (!whole) return std::nullopt;
  out.of_corner = mesh.triangles;
  return out;
}

}  // namespace

bool is_sliver(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  return !(ab.cross(ac).norm() > kSliver * longest);
}

Sectors find_sectors(const PreparedMesh& mesh, double crease_angle) {
  const std::size_t n = mesh.triangles.size();
  constexpr std::size_t kTask = 1 << 14;
  std::vector<Vec3> normals(n);
  parallel_blocks(n, kTask, [&](std::size_t from, std::size_t to) {
    for (std::size_t t = from; t < to; ++t) {
      const Corners& c = mesh.triangles[t];
      const bool sliver = is_sliver(mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]);
      normals[t] = sliver ? Vec3(Vec3::Zero()) : doubled_area(mesh, t).normalized();
    }
  });
  const double least = std::cos(crease_angle);
  // the normal of a sliver is noise: no crease there
  const auto smooth = [&](std::uint32_t t, std::uint32_t o) {
    return normals[t].isZero() || normals[o].isZero() || normals[t].dot(normals[o]) >= least;
  };
  if (std::optional<Sectors> whole = one_a_vertex(mesh, smooth)) return std::move(*whole);

  CheckPoint check;
  std::vector<std::uint32_t> parent(3 * n);
  std::iota(parent.begin(), parent.end(), 0u);
  for (std::uint32_t t = 0; t < n; ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      check.pass();
      const std::uint32_t o = mesh.neighbours[t][k];
      if (o == kNone || o < t) continue;
      if (!smooth(t, o)) continue;
      for (const std::uint32_t corner : {(k + 1) % 3, (k + 2) % 3})
        for (std::uint32_t other = 0; other < 3; ++other)
          if (mesh.triangles[o][other] == mesh.triangles[t][corner])
            parent[root_corner(parent, 3 * o + other)] = root_corner(parent, 3 * t + corner);
    }

  Sectors sectors;
  sectors.of_corner.resize(n);
  std::vector<std::uint32_t> number(3 * n, kNone), count;
  for (std::uint32_t i = 0; i < 3 * n; ++i) {
    check.pass();
    const std::uint32_t root = root_corner(parent, i);
    if (number[root] == kNone) {
      number[root] = static_cast<std::uint32_t>(sectors.vertex.size());
      sectors.vertex.push_back(mesh.triangles[i / 3][i % 3]);
      count.push_back(0);
    }
    sectors.of_corner[i / 3][i % 3] = number[root];
    ++count[number[root]];
  }
  sectors.begin.assign(sectors.size() + 1, 0);
  for (std::size_t s = 0; s < sectors.size(); ++s) sectors.begin[s + 1] = sectors.begin[s] + count[s];
  sectors.triangles.resize(3 * n);
  std::vector<std::uint32_t> fill(sectors.begin.begin(), sectors.begin.end() - 1);
  for (std::uint32_t i = 0; i < 3 * n; ++i) sectors.triangles[fill[sectors.of_corner[i / 3][i % 3]]++] = i / 3;
  return sectors;
}

}  // namespace treadmark::mesh
