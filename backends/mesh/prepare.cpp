// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "treadmark/backends/mesh/buckets.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::mesh {

namespace {

constexpr double kMergeShare = 1e-9;  ///< of the size of the mesh: closer vertices are one
constexpr double kMergeDistance =
    1e-7;                        ///< [m] likewise: far below what scanners resolve, and slivers spoil local fits
constexpr double kFlat = 1e-12;  ///< height over longest side of a triangle that counts as without area
constexpr double kLargestRadius = 5.0, kSmallestRadius = 0.02;  ///< [m] of wheels
constexpr double kWidestRail = 2.0, kSmallestRail = 1e-3;       ///< [m] section, whole patch

[[noreturn]] void refuse(const TriangleMesh& mesh, const std::string& what, const std::string& advice) {
  throw Error(ErrorKind::input_data, fmt::format("the mesh '{}' {}", mesh.name, what), {}, advice);
}

constexpr std::size_t kChecked = 1 << 14;  ///< vertices or triangles that one thread looks at

/// The first number below count for which bad holds; count if there is none.
template <class Bad>
std::size_t first_of(std::size_t count, const Bad& bad) {
  std::vector<std::size_t> found((count + kChecked - 1) / kChecked, count);
  parallel_blocks(count, kChecked, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i)
      if (bad(i)) {
        found[from / kChecked] = i;
        return;
      }
  });
  return found.empty() ? count : *ranges::min_element(found);
}

void check_input(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) refuse(mesh, "has no triangles", "is it a point cloud? make triangles of it first");
  if (mesh.vertices.size() >= kNone || mesh.triangles.size() >= kNone / 3)
    refuse(mesh, "is too large for 32-bit indices", "thin it out or cut it into pieces");
  if (const std::size_t i =
          first_of(mesh.vertices.size(), [&](std::size_t v) { return !mesh.vertices[v].allFinite(); });
      i < mesh.vertices.size())
    refuse(mesh, fmt::format("has a coordinate that is not finite at vertex {} (counted from 0)", i),
           "remove or repair the vertex");
  const auto is_outside = [&](std::uint32_t v) { return v >= mesh.vertices.size(); };
  if (const std::size_t t =
          first_of(mesh.triangles.size(), [&](std::size_t i) { return ranges::any_of(mesh.triangles[i], is_outside); });
      t < mesh.triangles.size())
    refuse(mesh,
           fmt::format("names vertex {} in triangle {} (counted from 0), but has {} vertices only",
                       *ranges::find_if(mesh.triangles[t], is_outside), t, mesh.vertices.size()),
           "is the file complete?");
}

/// What the corners of all triangles reach.
struct Extent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double radius2 = 0.0;  ///< squared distance from the axis of a wheel

  void widen(const Extent& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
    radius2 = std::max(radius2, other.radius2);
  }
};

Extent extent_of(const TriangleMesh& mesh) {
  std::vector<Extent> parts((mesh.triangles.size() + kChecked - 1) / kChecked);
  parallel_blocks(mesh.triangles.size(), kChecked, [&](std::size_t from, std::size_t to) {
    Extent own;
    for (std::size_t t = from; t < to; ++t)
      for (const std::uint32_t v : mesh.triangles[t]) {
        const Vec3& p = mesh.vertices[v];
        own.widen({p, p, p.x() * p.x() + p.z() * p.z()});
      }
    parts[from / kChecked] = own;
  });
  Extent all;
  for (const Extent& part : parts) all.widen(part);
  return all;
}

/// Coordinates in mm or in inches taken for metres show in the size of wheels and rail sections.
void check_units(const TriangleMesh& mesh, Body body, const Extent& found) {
  const Vec3 extent = found.high - found.low;
  const auto advise = [](bool large) {
    return std::string(large ? "is the factor from the units of the file to mm right? (scale_to_mm, --scale)"
                             : "is the file in metres? then the factor to mm is 1000 (scale_to_mm, --scale)");
  };
  if (body == Body::wheel) {
    const double radius = std::sqrt(found.radius2);
    if (radius > kLargestRadius || radius < kSmallestRadius)
      refuse(mesh,
             fmt::format("reaches {:.4g} m from the axle, which no wheel does (between {:g} and {:g} m)", radius,
                         kSmallestRadius, kLargestRadius),
             advise(radius > kLargestRadius));
  } else if (extent.y() > kWidestRail || extent.z() > kWidestRail) {
    refuse(mesh,
           fmt::format("is {:.4g} m wide and {:.4g} m high, which no rail is (at most {:g} m)", extent.y(), extent.z(),
                       kWidestRail),
           advise(true));
  } else if (extent.maxCoeff() < kSmallestRail) {
    refuse(mesh, fmt::format("is only {:.4g} m large", extent.maxCoeff()), advise(false));
  }
}

bool without_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  return !(ab.cross(ac).norm() > kFlat * longest);
}

/// Removes the triangles that are marked, and tells how many.
std::size_t drop(std::vector<Corners>& triangles, const std::vector<char>& marked) {
  const std::size_t before = triangles.size();
  if (ranges::find(marked, 1) == marked.end()) return 0;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < before; ++t)
    if (!marked[t]) triangles[kept++] = triangles[t];
  triangles.resize(kept);
  return before - kept;
}

/// Removes all but the first of triangles with the same corners in any order.
std::size_t drop_duplicates(std::vector<Corners>& triangles, std::size_t vertices) {
  using Rest = std::array<std::uint32_t, 3>;  // the two higher corners and the triangle, in the bucket of the lowest
  const Buckets<Rest> same(vertices, [&](const auto& put) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      Corners sorted = triangles[t];
      std::sort(sorted.begin(), sorted.end());
      put(sorted[0], Rest{sorted[1], sorted[2], t});
    }
  });
  std::vector<char> repeated(triangles.size(), 0);
  for (std::size_t v = 0; v < same.size(); ++v) {
    const std::span<const Rest> own = same[v];
    for (std::size_t i = 1; i < own.size(); ++i)
      if (own[i][0] == own[i - 1][0] && own[i][1] == own[i - 1][1]) repeated[own[i][2]] = 1;
  }
  return drop(triangles, repeated);
}

}  // namespace

PreparedMesh prepare(const TriangleMesh& mesh, Body body, MeshRepair& repair) {
  repair = {};
  check_input(mesh);
  PreparedMesh result;
  result.name = mesh.name;

  const Extent extent = extent_of(mesh);
  check_units(mesh, body, extent);
  result.centre = 0.5 * (extent.low + extent.high);

  const std::vector<std::uint32_t> same =
      merge_close(mesh.vertices, std::max(kMergeDistance, kMergeShare * (extent.high - extent.low).norm()));
  for (std::size_t v = 0; v < same.size(); ++v) repair.merged_vertices += same[v] != v;

  result.triangles.resize(mesh.triangles.size());
  std::vector<char> flat(mesh.triangles.size());
  parallel_blocks(mesh.triangles.size(), kChecked, [&](std::size_t from, std::size_t to) {
    for (std::size_t t = from; t < to; ++t) {
      const auto& corners = mesh.triangles[t];
      const Corners& c = result.triangles[t] = {same[corners[0]], same[corners[1]], same[corners[2]]};
      flat[t] = c[0] == c[1] || c[1] == c[2] || c[2] == c[0] ||
                without_area(mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]);
    }
  });
  repair.degenerate = drop(result.triangles, flat);
  if (result.triangles.empty()) refuse(mesh, "has only triangles without area", "check the file and the scale");

  // keep the vertices that are used, in their order
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kNone);
  for (const Corners& c : result.triangles)
    for (const std::uint32_t v : c) renumbered[v] = 0;
  check_cancelled();
  result.vertices.reserve(mesh.vertices.size());
  result.low = Vec3::Constant(std::numeric_limits<double>::infinity());
  result.high = -result.low;
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] == kNone) {
      repair.unused_vertices += same[v] == v;
      continue;
    }
    renumbered[v] = static_cast<std::uint32_t>(result.vertices.size());
    const Vec3& local = result.vertices.emplace_back(mesh.vertices[v] - result.centre);
    result.low = result.low.cwiseMin(local);
    result.high = result.high.cwiseMax(local);
  }
  result.vertices.shrink_to_fit();
  parallel_blocks(result.triangles.size(), kChecked, [&](std::size_t from, std::size_t to) {
    for (std::size_t t = from; t < to; ++t)
      for (std::uint32_t& v : result.triangles[t]) v = renumbered[v];
  });

  if (!connect_simply(result)) {
    repair.duplicates = drop_duplicates(result.triangles, result.vertices.size());
    connect(result);
  }
  orient(result, body, repair);
  repair.boundary_loops = count_boundary_loops(result);
  return result;
}

}  // namespace treadmark::mesh
