// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/thin.hpp"

#include <algorithm>

#include "treadmark/core/parallel.hpp"

namespace treadmark::scans {

ThinnedPoints thin(std::span<const Vec3> points, const Vec3& origin, double size) {
  ThinnedPoints out{Voxels(points, origin, size), {}};
  out.position.resize(out.voxels.count());
  parallel_for(out.voxels.count(), [&](std::size_t v) {
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t i : out.voxels.points_of(v)) sum += points[i] - origin;
    out.position[v] = origin + sum / static_cast<double>(out.voxels.points_of(v).size());
  });
  return out;
}

std::size_t drop_duplicates(BandPoints& points, std::span<const Vec3> cloud) {
  std::vector<std::size_t> dropped(points.rows, 0);
  parallel_for(points.rows, [&](std::size_t row) {
    std::vector<std::uint32_t> order;
    for (std::size_t column = 0; column < points.columns; ++column) {
      const std::size_t from = points.first(row, column), to = points.begin[row * points.columns + column + 1];
      order.clear();
      for (std::size_t i = from; i < to; ++i) order.push_back(static_cast<std::uint32_t>(i));
      const auto place = [&](std::uint32_t i) -> const Vec3& { return cloud[points.index[i]]; };
      std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Vec3 &p = place(a), &q = place(b);
        for (int k = 0; k < 3; ++k)
          if (p[k] != q[k]) return p[k] < q[k];
        return points.index[a] < points.index[b];
      });
      for (std::size_t k = 1; k < order.size(); ++k)
        if (place(order[k]) == place(order[k - 1])) {
          points.state[order[k]] = PointState::off_band;
          ++dropped[row];
        }
    }
  });
  std::size_t sum = 0;
  for (const std::size_t n : dropped) sum += n;
  return sum;
}

}  // namespace treadmark::scans
