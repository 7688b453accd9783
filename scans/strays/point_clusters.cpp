// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/point_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {

namespace {

using Cell = std::array<std::int64_t, 3>;
constexpr std::int64_t kReach = 2;  // cells: a gap is sqrt(3) sides long

struct CellOfPoint {
  Cell cell;
  std::uint32_t point;
  auto operator<=>(const CellOfPoint&) const = default;
};

/// Disjoint sets, each with its least member as root.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<std::uint32_t> cluster_points(std::span<const Vec3> points, double gap) {
  // Cells whose diagonal is the gap: all points of one belong together, and only cells within reach are left to
  // compare.
  const double side = gap / std::sqrt(3.0) * (1.0 - 1e-12);
  std::vector<CellOfPoint> sorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      sorted[i].cell[axis] = to_whole<std::int64_t>(std::floor(points[i][static_cast<Eigen::Index>(axis)] / side));
    sorted[i].point = static_cast<std::uint32_t>(i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> begin;  // of every cell, and the end
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (i == 0 || sorted[i].cell != sorted[i - 1].cell) begin.push_back(i);
  const std::size_t cells = begin.size();
  begin.push_back(sorted.size());

  Sets sets(points.size());
  for (std::size_t c = 0; c < cells; ++c)
    for (std::size_t i = begin[c] + 1; i < begin[c + 1]; ++i) sets.unite(sorted[begin[c]].point, sorted[i].point);

  const auto touch = [&](std::size_t a, std::size_t b) {
    for (std::size_t i = begin[a]; i < begin[a + 1]; ++i)
      for (std::size_t j = begin[b]; j < begin[b + 1]; ++j)
        if ((points[sorted[i].point] - points[sorted[j].point]).squaredNorm() <= gap * gap) return true;
    return false;
  };
  for (std::size_t c = 0; c < cells; ++c) {
    const Cell cell = sorted[begin[c]].cell;
    const std::uint32_t first = sorted[begin[c]].point;
    for (std::int64_t dx = 0; dx <= kReach; ++dx)
      for (std::int64_t dy = dx == 0 ? 0 : -kReach; dy <= kReach; ++dy) {
        const Cell from{cell[0] + dx, cell[1] + dy, cell[2] + (dx == 0 && dy == 0 ? 1 : -kReach)};
        const Cell last{from[0], from[1], cell[2] + kReach};
        auto at = std::lower_bound(begin.begin() + static_cast<std::ptrdiff_t>(c), begin.end() - 1, from,
                                   [&](std::size_t b, const Cell& value) { return sorted[b].cell < value; });
        for (; at != begin.end() - 1 && sorted[*at].cell <= last; ++at) {
          const std::uint32_t other = sorted[*at].point;
          if (sets.root(first) != sets.root(other) && touch(c, static_cast<std::size_t>(at - begin.begin())))
            sets.unite(first, other);
        }
      }
  }

  std::vector<std::uint32_t> group(points.size());
  std::uint32_t groups = 0;
  for (std::uint32_t i = 0; i < group.size(); ++i) {
    const std::uint32_t root = sets.root(i);  // the least member, so its group is known already
    group[i] = root == i ? groups++ : group[root];
  }
  return group;
}

}  // namespace treadmark::scans
