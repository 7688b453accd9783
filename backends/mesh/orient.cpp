// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::mesh {

namespace {

/// Whether the triangle runs along its edge opposite to corner k from a to b.
bool runs(const Corners& triangle, std::uint32_t a, std::uint32_t b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (triangle[k] == a && triangle[(k + 1) % 3] == b) return true;
  return false;
}

[[noreturn]] void one_sided(const PreparedMesh& mesh, std::uint32_t t) {
  const Vec3 at = mesh.vertices[mesh.triangles[t][0]] + mesh.centre;
  throw Error(
      ErrorKind::input_data,
      fmt::format("the mesh '{}' has no inside and outside: triangles that disagree meet at ({:.6g}, {:.6g}, {:.6g}) m",
                  mesh.name, at.x(), at.y(), at.z()),
      {}, "it contains a one-sided band (Moebius): cut it open or repair it in a mesh program");
}

constexpr std::size_t kOriented = 1 << 14;  ///< triangles that one thread looks at

/// Whether all neighbours run along their common edges in opposite directions.
bool agree(const PreparedMesh& mesh) {
  std::atomic<bool> all = true;
  parallel_blocks(mesh.triangles.size(), kOriented, [&](std::size_t from, std::size_t to) {
    for (std::size_t t = from; t < to && all.load(std::memory_order_relaxed); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t n = mesh.neighbours[t][k];
        if (n == kNone || n < t) continue;
        if (runs(mesh.triangles[n], mesh.triangles[t][(k + 1) % 3], mesh.triangles[t][(k + 2) % 3])) all = false;
      }
  });
  return all;
}

/// > 0: the part faces outwards as it stands, < 0: inwards, 0: cannot be told.
double facing_of(const PreparedMesh& mesh, Body body, const std::vector<std::uint32_t>& part,
                 const std::vector<char>& flip) {
  constexpr double kUndecided = 1e-9;  // share of the whole
  struct Share {
    double sum = 0.0, size = 0.0;
    bool closed = true;
  };
  std::vector<Share> shares((part.size() + kOriented - 1) / kOriented);
  parallel_blocks(part.size(), kOriented, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i)
      for (const std::uint32_t n : mesh.neighbours[part[i]])
        shares[from / kOriented].closed = shares[from / kOriented].closed && n != kNone;
  });
  const bool closed = ranges::all_of(shares, &Share::closed);
  const Vec3 base = mesh.vertices[mesh.triangles[part.front()][0]];
  parallel_blocks(part.size(), kOriented, [&](std::size_t from, std::size_t to) {
    Share own;
    for (std::size_t i = from; i < to; ++i) {
      const std::uint32_t t = part[i];
      const Vec3 area = doubled_area(mesh, t) * (flip[t] ? -1.0 : 1.0);
      const Vec3 middle = (mesh.vertices[mesh.triangles[t][0]] + mesh.vertices[mesh.triangles[t][1]] +
                           mesh.vertices[mesh.triangles[t][2]]) /
                          3.0;
      Vec3 outwards(0.0, 0.0, -1.0);
      if (closed) {
        outwards = middle - base;
      } else if (body == Body::wheel) {
        outwards = middle + mesh.centre;
        outwards.y() = 0.0;
        outwards.normalize();
      }
      const double share = area.dot(outwards);
      own.sum += share;
      own.size += std::fabs(share);
    }
    shares[from / kOriented] = own;
  });
  double sum = 0.0, size = 0.0;
  for (const Share& share : shares) sum += share.sum, size += share.size;
  return std::fabs(sum) > kUndecided * size ? sum : 0.0;
}

}  // namespace

void orient(PreparedMesh& mesh, Body body, MeshRepair& repair) {
  std::vector<char> seen(mesh.triangles.size(), 0), flip(mesh.triangles.size(), 0);
  const bool in_order = agree(mesh);
  bool all_inside_out = true;
  std::vector<std::uint32_t> part;
  part.reserve(mesh.triangles.size());
  CheckPoint check;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (seen[seed]) continue;
    part.assign(1, seed);
    seen[seed] = 1;
    for (std::size_t i = 0; i < part.size(); ++i) {
      check.pass();
      const std::uint32_t t = part[i];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t n = mesh.neighbours[t][k];
        if (n == kNone) continue;
        // neighbours agree when they run along the common edge in opposite directions
        const bool clash =
            !in_order && runs(mesh.triangles[n], mesh.triangles[t][(k + 1) % 3], mesh.triangles[t][(k + 2) % 3]);
        const char wanted = static_cast<char>(flip[t] ^ static_cast<char>(clash));
        if (!seen[n]) {
          seen[n] = 1;
          flip[n] = wanted;
          part.push_back(n);
        } else if (flip[n] != wanted) {
          one_sided(mesh, t);
        }
      }
    }
    std::size_t turned = 0;
    for (const std::uint32_t t : part) turned += static_cast<std::size_t>(flip[t]);
    double facing = facing_of(mesh, body, part, flip);
    // where nothing tells, most of the triangles of the file decide
    if (facing == 0.0) facing = 2 * turned > part.size() ? -1.0 : 1.0;
    if (facing < 0.0) {
      for (const std::uint32_t t : part) flip[t] = static_cast<char>(1 - flip[t]);
      turned = part.size() - turned;
    }
    const bool inside_out = 2 * turned > part.size();
    all_inside_out = all_inside_out && inside_out;
    repair.flipped += inside_out ? part.size() - turned : turned;
    ++repair.parts;
  }
  repair.turned_inside_out = all_inside_out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!flip[t]) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    std::swap(mesh.neighbours[t][1], mesh.neighbours[t][2]);
  }
}

}  // namespace treadmark::mesh
