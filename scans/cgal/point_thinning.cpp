// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/point_thinning.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {

namespace {

constexpr double kLeastDistance = 0.6;  // spacings

using Cell = std::array<std::int64_t, 3>;

struct CellOfPoint {
  Cell cell;
  std::uint32_t point;
  auto operator<=>(const CellOfPoint&) const = default;
};

/// What lies in a cube: one point.
struct Representative {
  Cell cell;
  std::uint32_t point;
  bool kept;
};

}  // namespace

std::vector<std::uint32_t> thin_points(std::span<const Vec3> points, double spacing) {
  std::vector<CellOfPoint> sorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      sorted[i].cell[axis] = to_whole<std::int64_t>(std::floor(points[i][static_cast<Eigen::Index>(axis)] / spacing));
    sorted[i].point = static_cast<std::uint32_t>(i);
  }
  std::sort(sorted.begin(), sorted.end());

  std::vector<Representative> of_cell;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    Vec3 mean = Vec3::Zero();
    while (end < sorted.size() && sorted[end].cell == sorted[begin].cell) mean += points[sorted[end++].point];
    mean /= static_cast<double>(end - begin);
    std::uint32_t best = sorted[begin].point;
    for (std::size_t i = begin; i < end; ++i)
      if ((points[sorted[i].point] - mean).squaredNorm() < (points[best] - mean).squaredNorm()) best = sorted[i].point;
    of_cell.push_back({sorted[begin].cell, best, false});
  }

  // The cubes come in lexicographic order, so the neighbours decided before are in three columns per earlier layer.
  std::vector<std::uint32_t> kept;
  const double least = kLeastDistance * spacing;
  for (std::size_t c = 0; c < of_cell.size(); ++c) {
    const Cell cell = of_cell[c].cell;
    bool free = true;
    for (std::int64_t dx = -1; dx <= 0 && free; ++dx)
      for (std::int64_t dy = -1; dy <= (dx < 0 ? 1 : 0) && free; ++dy) {
        const Cell from{cell[0] + dx, cell[1] + dy, cell[2] - 1}, last{from[0], from[1], cell[2] + 1};
        auto at = std::lower_bound(of_cell.begin(), of_cell.begin() + static_cast<std::ptrdiff_t>(c), from,
                                   [](const Representative& r, const Cell& value) { return r.cell < value; });
        for (; at != of_cell.begin() + static_cast<std::ptrdiff_t>(c) && at->cell <= last; ++at)
          if (at->kept && (points[at->point] - points[of_cell[c].point]).squaredNorm() < least * least) free = false;
      }
    if (!free) continue;
    of_cell[c].kept = true;
    kept.push_back(of_cell[c].point);
  }
  return kept;
}

}  // namespace treadmark::scans
