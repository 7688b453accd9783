// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <mutex>
#include <numeric>
#include <optional>

#include "treadmark/backends/mesh/buckets.hpp"
#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/parallel_sort.hpp"
#include "treadmark/core/to_whole.hpp"

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

/// Cells far larger than the tolerance, so that a point seldom lies near the border of its cell.
class MergeCells {
 public:
  MergeCells(const std::vector<Vec3>& points, double tolerance)
      : points_(points), tolerance_(tolerance), per_cell_(1.0 / (16.0 * tolerance)) {}

  bool close(std::uint32_t i, std::uint32_t j) const {
    return (points_[i] - points_[j]).squaredNorm() <= tolerance_ * tolerance_;
  }

  bool equal(std::uint32_t i, std::uint32_t j) const { return points_[i] == points_[j]; }

  std::size_t hash_of(std::uint32_t i) const { return hash(cell_of(points_[i], 0.0)); }

  /// Calls visit(hash) for the cells, eight at most, in which points close to this one may lie.
  template <class Visit>
  void around(std::uint32_t i, const Visit& visit) const {
    const Cell low = cell_of(points_[i], -tolerance_), high = cell_of(points_[i], tolerance_);
    for (int corner = 0; corner < 8; ++corner) {
      Cell cell = low;
      bool repeated = false;
      for (std::size_t k = 0; k < 3; ++k)
        if (corner >> k & 1) {
          repeated = repeated || high[k] == low[k];
          cell[k] = high[k];
        }
      if (!repeated) visit(hash(cell));
    }
  }

 private:
  Cell cell_of(const Vec3& p, double shift) const {
    constexpr double kFar = 4e18;  // cells beyond are one; distances are compared anyway
    Cell cell;
    for (int k = 0; k < 3; ++k)
      cell[static_cast<std::size_t>(k)] = to_whole<std::int64_t>(
          std::fmax(-kFar, std::fmin(kFar, std::floor((p[k] - points_.front()[k] + shift) * per_cell_))));
    return cell;
  }

  const std::vector<Vec3>& points_;
  double tolerance_, per_cell_;
};

/// Ascending, the points that have others close to them. They are sorted by their cells, which meets memory in order
/// where a table of all points would miss the caches at every step.
std::vector<std::uint32_t> not_alone(const MergeCells& cells, std::size_t count) {
  constexpr std::size_t kTask = 1 << 14;
  std::vector<std::vector<std::uint64_t>> parts((count + kTask - 1) / kTask);
  parallel_blocks(count, kTask, [&](std::size_t from, std::size_t to) {
    std::vector<std::uint64_t>& own = parts[from / kTask];
    own.reserve(2 * kTask);
    for (auto i = static_cast<std::uint32_t>(from); i < to; ++i)
      cells.around(i, [&](std::size_t hash) { own.push_back(static_cast<std::uint64_t>(hash) << 32 | i); });
  });
  std::vector<std::uint64_t> places;  // hash of a cell, point
  for (std::vector<std::uint64_t>& part : parts) {
    places.insert(places.end(), part.begin(), part.end());
    part = {};
  }
  parallel_sort(places, std::less<>());
  const auto point = [&](std::size_t k) { return static_cast<std::uint32_t>(places[k]); };
  const auto same_cell = [&](std::size_t k, std::size_t l) { return places[k] >> 32 == places[l] >> 32; };
  std::vector<char> found(count, 0);
  const auto mark = [&](std::uint32_t i) { __atomic_store_n(&found[i], char{1}, __ATOMIC_RELAXED); };
  parallel_blocks(places.size(), kTask, [&](std::size_t from, std::size_t to) {
    CheckPoint check;
    for (std::size_t first = from; first < to; ++first) {
      if (first > 0 && same_cell(first - 1, first)) continue;
      for (std::size_t k = first + 1; k < places.size() && same_cell(first, k); ++k)
        for (std::size_t before = first; before < k; ++before) {
          check.pass();
          if (!cells.close(point(k), point(before))) continue;
          mark(point(k));
          mark(point(before));
          if (cells.equal(point(k), point(before)))
            break;  // what is close to one is close to the other, and marked there
        }
    }
  });
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < count; ++i)
    if (found[i] != 0) out.push_back(i);
  return out;
}

}  // namespace

std::vector<std::uint32_t> merge_close(const std::vector<Vec3>& points, double tolerance) {
  const MergeCells cells(points, std::max(tolerance, 1e-300));
  std::vector<std::uint32_t> same(points.size());
  std::iota(same.begin(), same.end(), 0u);
  const std::vector<std::uint32_t> candidates = not_alone(cells, points.size());
  if (candidates.empty()) return same;
  std::size_t size = 16;
  while (size < 2 * candidates.size()) size *= 2;
  std::vector<std::uint32_t> first(size, kNone), next(points.size(), kNone);
  CheckPoint check;
  for (const std::uint32_t i : candidates) {
    check.pass();
    cells.around(i, [&](std::size_t hash) {
      for (std::uint32_t j = first[hash & (size - 1)]; j != kNone; j = next[j])
        if (cells.close(i, j)) same[i] = std::min(same[i], j);
    });
    if (same[i] != i) continue;
    const std::size_t slot = cells.hash_of(i) & (size - 1);
    next[i] = first[slot];
    first[slot] = i;
  }
  return same;
}

}  // namespace treadmark::mesh
