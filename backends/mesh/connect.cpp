// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "treadmark/backends/mesh/buckets.hpp"
#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::mesh {

namespace {

/// An edge of a triangle, in the bucket of its lower vertex.
struct Side {
  std::uint32_t higher;  ///< vertex
  std::uint32_t corner;  ///< 3 triangle + the corner opposite to the edge
  bool operator<(const Side& o) const { return higher != o.higher ? higher < o.higher : corner < o.corner; }
};

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

void connect(PreparedMesh& mesh) {
  const Buckets<Side> sides(mesh.vertices.size(), [&](const auto& put) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.triangles[t][(k + 1) % 3], b = mesh.triangles[t][(k + 2) % 3];
        put(std::min(a, b), Side{std::max(a, b), 3 * t + k});
      }
  });
  mesh.neighbours.assign(mesh.triangles.size(), {kNone, kNone, kNone});
  CheckPoint check;
  for (std::uint32_t lower = 0; lower < sides.size(); ++lower) {
    const std::span<const Side> own = sides[lower];
    for (std::size_t i = 0; i < own.size();) {
      check.pass();
      std::size_t end = i + 1;
      while (end < own.size() && own[end].higher == own[i].higher) ++end;
      if (end - i > 2) {
        const Vec3 a = mesh.vertices[lower] + mesh.centre, b = mesh.vertices[own[i].higher] + mesh.centre;
        throw Error(
            ErrorKind::input_data,
            fmt::format("the mesh '{}' has an edge of {} triangles, from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, "
                        "{:.6g}) m",
                        mesh.name, end - i, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()),
            {}, "a surface has at most two triangles on each edge: remove inner walls and doubled sheets");
      }
      if (end - i == 2) {
        const std::uint32_t one = own[i].corner, other = own[i + 1].corner;
        mesh.neighbours[one / 3][one % 3] = other / 3;
        mesh.neighbours[other / 3][other % 3] = one / 3;
      }
      i = end;
    }
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

namespace {

using Cell = std::array<std::int64_t, 3>;

std::size_t hash(const Cell& cell) {
  std::uint64_t h = 0;
  for (const std::int64_t k : cell) {
    h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 29;
  }
  return static_cast<std::size_t>(h);
}

}  // namespace

std::vector<std::uint32_t> merge_close(const std::vector<Vec3>& points, double tolerance) {
  // cells far larger than the tolerance, so that a point seldom lies near the border of its cell
  tolerance = std::max(tolerance, 1e-300);
  const double per_cell = 1.0 / (16.0 * tolerance);
  std::size_t size = 16;
  while (size < 2 * points.size()) size *= 2;
  std::vector<std::uint32_t> first(size, kNone), next(points.size(), kNone), same(points.size());
  const Vec3 origin = points.empty() ? Vec3(Vec3::Zero()) : points.front();
  constexpr double kFar = 4e18;  // cells beyond are one; distances are compared anyway
  const auto cell_of = [&](const Vec3& p, double shift) {
    Cell cell;
    for (int k = 0; k < 3; ++k)
      cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(
          std::fmax(-kFar, std::fmin(kFar, std::floor((p[k] - origin[k] + shift) * per_cell))));
    return cell;
  };
  CheckPoint check;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    check.pass();
    const Vec3& p = points[i];
    same[i] = i;
    const Cell low = cell_of(p, -tolerance), high = cell_of(p, tolerance);
    for (int corner = 0; corner < 8; ++corner) {
      Cell cell = low;
      bool repeated = false;
      for (std::size_t k = 0; k < 3; ++k)
        if (corner >> k & 1) {
          repeated = repeated || high[k] == low[k];
          cell[k] = high[k];
        }
      if (repeated) continue;
      for (std::uint32_t j = first[hash(cell) & (size - 1)]; j != kNone; j = next[j])
        if ((points[j] - p).squaredNorm() <= tolerance * tolerance) same[i] = std::min(same[i], j);
    }
    if (same[i] != i) continue;
    const std::size_t slot = hash(cell_of(p, 0.0)) & (size - 1);
    next[i] = first[slot];
    first[slot] = i;
  }
  return same;
}

}  // namespace treadmark::mesh
