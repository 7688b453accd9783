// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <optional>

#include "treadmark/backends/mesh/buckets.hpp"
#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_blocks.hpp"

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

/// Edges of all triangles by their lower vertex.
Buckets<Side> sides_of(const PreparedMesh& mesh) {
  return {mesh.vertices.size(), [&](const auto& put) {
            for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
              for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t a = mesh.triangles[t][(k + 1) % 3], b = mesh.triangles[t][(k + 2) % 3];
                put(std::min(a, b), Side{std::max(a, b), 3 * t + k});
              }
          }};
}

/// Makes neighbours of the triangles at edges of two of them. edge(lower vertex, sides) is called for all edges, those
/// of a vertex by one thread, and says whether to go on with it.
template <class Edge>
void join(PreparedMesh& mesh, const Edge& edge) {
  const Buckets<Side> sides = sides_of(mesh);
  mesh.neighbours.assign(mesh.triangles.size(), {kNone, kNone, kNone});
  constexpr std::size_t kTask = 4096;
  parallel_blocks(sides.size(), kTask, [&](std::size_t from, std::size_t to) {
    CheckPoint check;
    for (std::size_t lower = from; lower < to; ++lower) {
      const std::span<const Side> own = sides[lower];
      for (std::size_t i = 0; i < own.size();) {
        check.pass();
        std::size_t end = i + 1;
        while (end < own.size() && own[end].higher == own[i].higher) ++end;
        if (!edge(lower, own.subspan(i, end - i))) return;
        if (end - i == 2) {
          const std::uint32_t one = own[i].corner, other = own[i + 1].corner;
          mesh.neighbours[one / 3][one % 3] = other / 3;
          mesh.neighbours[other / 3][other % 3] = one / 3;
        }
        i = end;
      }
    }
  });
}

}  // namespace

bool connect_simply(PreparedMesh& mesh) {
  std::atomic<bool> simple = true;
  const auto opposite = [&](const Side& side) { return mesh.triangles[side.corner / 3][side.corner % 3]; };
  join(mesh, [&](std::size_t, std::span<const Side> sides) {
    if (sides.size() > 2 || (sides.size() == 2 && opposite(sides[0]) == opposite(sides[1]))) simple = false;
    return simple.load(std::memory_order_relaxed);
  });
  return simple;
}

void connect(PreparedMesh& mesh) {
  struct Crowded {
    std::size_t lower;
    std::uint32_t higher;
    std::size_t triangles;
  };
  std::optional<Crowded> first;  // the same one whatever thread comes first
  std::mutex mutex;
  join(mesh, [&](std::size_t lower, std::span<const Side> sides) {
    if (sides.size() <= 2) return true;
    const std::scoped_lock lock(mutex);
    if (!first || lower < first->lower) first = Crowded{lower, sides.front().higher, sides.size()};
    return false;
  });
  if (!first) return;
  const Vec3 a = mesh.vertices[first->lower] + mesh.centre, b = mesh.vertices[first->higher] + mesh.centre;
  throw Error(
      ErrorKind::input_data,
      fmt::format("the mesh '{}' has an edge of {} triangles, from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, "
                  "{:.6g}) m",
                  mesh.name, first->triangles, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()),
      {}, "a surface has at most two triangles on each edge: remove inner walls and doubled sheets");
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
  std::vector<std::uint32_t> same(points.size());
  const Vec3 origin = points.empty() ? Vec3(Vec3::Zero()) : points.front();
  constexpr double kFar = 4e18;  // cells beyond are one; distances are compared anyway
  const auto cell_of = [&](const Vec3& p, double shift) {
    Cell cell;
    for (int k = 0; k < 3; ++k)
      cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(
          std::fmax(-kFar, std::fmin(kFar, std::floor((p[k] - origin[k] + shift) * per_cell))));
    return cell;
  };
  // all points by the slot of their cell, each slot ascending
  constexpr std::size_t kTask = 1 << 14;
  std::vector<std::uint32_t> slot(points.size()), begin(size + 1, 0), inside(points.size());
  parallel_blocks(points.size(), kTask, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i)
      slot[i] = static_cast<std::uint32_t>(hash(cell_of(points[i], 0.0)) & (size - 1));
  });
  for (const std::uint32_t s : slot) ++begin[s];
  std::uint32_t sum = 0;
  for (std::uint32_t& b : begin) sum = b += sum;  // the ends, from which they are filled downwards
  for (std::size_t i = points.size(); i-- > 0;) inside[--begin[slot[i]]] = static_cast<std::uint32_t>(i);
  /// Of those before point i within the tolerance and wanted the first one; i if there is none.
  const auto first_near = [&](std::uint32_t i, const auto& wanted) {
    const Vec3& p = points[i];
    std::uint32_t found = i;
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
      const std::size_t at = hash(cell) & (size - 1);
      for (std::uint32_t k = begin[at]; k < begin[at + 1] && inside[k] < found; ++k)
        if (wanted(inside[k]) && (points[inside[k]] - p).squaredNorm() <= tolerance * tolerance) found = inside[k];
    }
    return found;
  };
  parallel_blocks(points.size(), kTask, [&](std::size_t from, std::size_t to) {
    for (auto i = static_cast<std::uint32_t>(from); i < to; ++i)
      same[i] = first_near(i, [](std::uint32_t) { return true; });
  });
  // few have others before them: to those of them that stand for themselves
  CheckPoint check;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    check.pass();
    if (same[i] != i && same[same[i]] != same[i])
      same[i] = first_near(i, [&](std::uint32_t j) { return same[j] == j; });
  }
  return same;
}

}  // namespace treadmark::mesh
