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

void check_input(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) refuse(mesh, "has no triangles", "is it a point cloud? make triangles of it first");
  if (mesh.vertices.size() >= kNone || mesh.triangles.size() >= kNone / 3)
    refuse(mesh, "is too large for 32-bit indices", "thin it out or cut it into pieces");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!mesh.vertices[i].allFinite())
      refuse(mesh, fmt::format("has a coordinate that is not finite at vertex {} (counted from 0)", i),
             "remove or repair the vertex");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      if (v >= mesh.vertices.size())
        refuse(mesh,
               fmt::format("names vertex {} in triangle {} (counted from 0), but has {} vertices only", v, t,
                           mesh.vertices.size()),
               "is the file complete?");
}

/// Coordinates in mm or in inches taken for metres show in the size of wheels and rail sections.
void check_units(const TriangleMesh& mesh, Body body, const Vec3& extent) {
  const auto advise = [](bool large) {
    return std::string(large ? "is the factor from the units of the file to mm right? (scale_to_mm, --scale)"
                             : "is the file in metres? then the factor to mm is 1000 (scale_to_mm, --scale)");
  };
  if (body == Body::wheel) {
    double radius = 0.0;
    for (const auto& corners : mesh.triangles)
      for (const std::uint32_t v : corners)
        radius = std::max(radius, std::hypot(mesh.vertices[v].x(), mesh.vertices[v].z()));
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

/// Marks all but the first of triangles with the same corners in any order.
std::size_t drop_duplicates(std::vector<Corners>& triangles, std::size_t vertices) {
  using Rest = std::array<std::uint32_t, 3>;  // the two higher corners and the triangle, in the bucket of the lowest
  const Buckets<Rest> same(vertices, [&](const auto& put) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      Corners sorted = triangles[t];
      std::sort(sorted.begin(), sorted.end());
      put(sorted[0], Rest{sorted[1], sorted[2], t});
    }
  });
  std::vector<char> drop(triangles.size(), 0);
  std::size_t count = 0;
  for (std::size_t v = 0; v < same.size(); ++v) {
    const std::span<const Rest> own = same[v];
    for (std::size_t i = 1; i < own.size(); ++i)
      if (own[i][0] == own[i - 1][0] && own[i][1] == own[i - 1][1]) drop[own[i][2]] = 1, ++count;
  }
  if (count == 0) return 0;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!drop[t]) triangles[kept++] = triangles[t];
  triangles.resize(kept);
  return count;
}

}  // namespace

PreparedMesh prepare(const TriangleMesh& mesh, Body body, MeshRepair& repair) {
  repair = {};
  check_input(mesh);
  PreparedMesh result;
  result.name = mesh.name;

  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& corners : mesh.triangles)
    for (const std::uint32_t v : corners) low = low.cwiseMin(mesh.vertices[v]), high = high.cwiseMax(mesh.vertices[v]);
  check_units(mesh, body, high - low);
  result.centre = 0.5 * (low + high);

  const std::vector<std::uint32_t> same =
      merge_close(mesh.vertices, std::max(kMergeDistance, kMergeShare * (high - low).norm()));
  for (std::size_t v = 0; v < same.size(); ++v) repair.merged_vertices += same[v] != v;

  result.triangles.reserve(mesh.triangles.size());
  CheckPoint check;
  for (const auto& corners : mesh.triangles) {
    check.pass();
    const Corners c{same[corners[0]], same[corners[1]], same[corners[2]]};
    const bool flat = c[0] == c[1] || c[1] == c[2] || c[2] == c[0] ||
                      without_area(mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]);
    if (flat)
      ++repair.degenerate;
    else
      result.triangles.push_back(c);
  }
  if (result.triangles.empty()) refuse(mesh, "has only triangles without area", "check the file and the scale");
  repair.duplicates = drop_duplicates(result.triangles, mesh.vertices.size());

  // keep the vertices that are used, in their order
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kNone);
  for (const Corners& c : result.triangles)
    for (const std::uint32_t v : c) renumbered[v] = 0;
  check_cancelled();
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] == kNone) {
      repair.unused_vertices += same[v] == v;
      continue;
    }
    renumbered[v] = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.emplace_back(mesh.vertices[v] - result.centre);
  }
  result.vertices.shrink_to_fit();
  for (Corners& c : result.triangles)
    for (std::uint32_t& v : c) v = renumbered[v];
  result.low = Vec3::Constant(std::numeric_limits<double>::infinity());
  result.high = -result.low;
  for (const Vec3& v : result.vertices) result.low = result.low.cwiseMin(v), result.high = result.high.cwiseMax(v);

  connect(result);
  orient(result, body, repair);
  repair.boundary_loops = count_boundary_loops(result);
  return result;
}

}  // namespace treadmark::mesh
