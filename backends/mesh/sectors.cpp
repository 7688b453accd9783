// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/sectors.hpp"

#include <cmath>
#include <numeric>

#include "treadmark/backends/mesh/vertex_fit.hpp"
#include "treadmark/core/check_point.hpp"

namespace treadmark::mesh {

namespace {

std::uint32_t root_corner(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

bool is_sliver(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  return !(ab.cross(ac).norm() > kSliver * longest);
}

Sectors find_sectors(const PreparedMesh& mesh, double crease_angle) {
  const std::size_t n = mesh.triangles.size();
  std::vector<Vec3> normals(n);
  CheckPoint check;
  for (std::size_t t = 0; t < n; ++t) {
    check.pass();
    const Corners& c = mesh.triangles[t];
    const bool sliver = is_sliver(mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]);
    normals[t] = sliver ? Vec3(Vec3::Zero()) : doubled_area(mesh, t).normalized();
  }
  const double least = std::cos(crease_angle);
  std::vector<std::uint32_t> parent(3 * n);
  std::iota(parent.begin(), parent.end(), 0u);
  for (std::uint32_t t = 0; t < n; ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      check.pass();
      const std::uint32_t o = mesh.neighbours[t][k];
      if (o == kNone || o < t) continue;
      // the normal of a sliver is noise: no crease there
      const bool known = !normals[t].isZero() && !normals[o].isZero();
      if (known && normals[t].dot(normals[o]) < least) continue;
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
