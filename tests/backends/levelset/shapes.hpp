// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/solid_shape.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::testing {

inline constexpr double kTenthOfVoxel = 0.1;  ///< of heights off, as docs/representations.md promises

/// A distance from a surface by formula [m], positive outside.
using Distance = std::function<double(const Vec3&)>;

/// The nodes of a lattice within the half width [voxels] of a surface, with their exact distances.
inline DistanceGrid sampled(const Distance& distance, const Vec3& low, const Vec3& high, double voxel,
                            double half_width = 3.5) {
  DistanceGrid grid;
  grid.name = "formula";
  grid.voxel = voxel;
  std::array<int, 3> from{}, to{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    from[k] = static_cast<int>(std::floor(low[axis] / voxel / 8.0)),
    to[k] = static_cast<int>(std::floor(high[axis] / voxel / 8.0));
  }
  for (int i = from[0]; i <= to[0]; ++i)
    for (int j = from[1]; j <= to[1]; ++j)
      for (int k = from[2]; k <= to[2]; ++k) {
        DistanceGrid::Block block;
        block.first = {8 * i, 8 * j, 8 * k};
        bool any = false;
        for (int n = 0; n < DistanceGrid::kNodes; ++n) {
          const Vec3 p = voxel * Vec3(8 * i + (n >> 6), 8 * j + (n >> 3 & 7), 8 * k + (n & 7));
          const double d = distance(p) / voxel;
          if (std::fabs(d) > half_width) continue;
          block.value[static_cast<std::size_t>(n)] = static_cast<float>(d);
          block.known[static_cast<std::size_t>(n >> 6)] |= std::uint64_t{1} << (n & 63);
          any = true;
        }
        if (any) grid.blocks.push_back(block);
      }
  return grid;
}

/// A torus about the y axis: distance of p.
inline double torus(const Vec3& p, double large, double small) {
  return std::hypot(std::hypot(p.x(), p.z()) - large, p.y()) - small;
}

/// Closed triangles over a torus about the y axis.
inline TriangleMesh torus_mesh(double large, double small, int round, int across) {
  TriangleMesh mesh;
  mesh.name = "torus";
  for (int i = 0; i < round; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2.0 * kPi * (i + 0.5 * (j % 2)) / round, b = 2.0 * kPi * j / across;
      const double r = large + small * std::cos(b);
      mesh.vertices.emplace_back(r * std::sin(a), small * std::sin(b), r * std::cos(a));
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % round) * across + j % across); };
  for (int i = 0; i < round; ++i)
    for (int j = 0; j < across; ++j) {
      // odd rows lie half a step on
      if (j % 2 == 0) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      } else {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  return mesh;
}

/// Closed triangles over a box, outside as told.
inline TriangleMesh box_mesh(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  mesh.name = "box";
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(), k & 4 ? high.z() : low.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Closed triangles over a cylinder about an axis along y through (x, z).
inline TriangleMesh cylinder_mesh(double x, double z, double radius, double y_low, double y_high, int round) {
  TriangleMesh mesh;
  mesh.name = "cylinder";
  for (int i = 0; i < round; ++i)
    for (const double y : {y_low, y_high}) {
      const double a = 2.0 * kPi * i / round;
      mesh.vertices.emplace_back(x + radius * std::sin(a), y, z + radius * std::cos(a));
    }
  const auto low = static_cast<std::uint32_t>(mesh.vertices.size()), high = low + 1;
  mesh.vertices.emplace_back(x, y_low, z);
  mesh.vertices.emplace_back(x, y_high, z);
  for (int i = 0; i < round; ++i) {
    const auto a = static_cast<std::uint32_t>(2 * i), b = static_cast<std::uint32_t>(2 * ((i + 1) % round));
    mesh.triangles.push_back({a, b, a + 1});
    mesh.triangles.push_back({b, b + 1, a + 1});
    mesh.triangles.push_back({low, b, a});
    mesh.triangles.push_back({high, a + 1, b + 1});
  }
  return mesh;
}

/// The largest distance of heights over a grid from a formula, and how many there are.
struct HeightError {
  double largest = 0.0;  ///< [m]
  double rms = 0.0;      ///< [m]
  int count = 0;
};

inline HeightError error_of(const Surface& surface, const Pose& X_SP, const Grid2& grid, const Distance& distance) {
  std::vector<double> z(grid.size());
  surface.heights({X_SP, grid}, {z, {}, {}});
  HeightError error;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double height = z[grid.index(ix, iy)];
      if (std::isnan(height)) continue;
      const double off = std::fabs(distance(X_SP.apply({grid.x(ix), grid.y(iy), height})));
      error.largest = std::max(error.largest, off);
      error.rms += off * off;
      ++error.count;
    }
  error.rms = std::sqrt(error.rms / std::max(error.count, 1));
  return error;
}

}  // namespace treadmark::testing
