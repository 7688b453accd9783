// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/section_raster.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// A scattered point in the axes of grid lines, with its place in the caller's list.
struct ListedPoint {
  double across, along;
  std::size_t index;
};

/// One point as samples of a line; the step only sets the slack at the ends of a surface, here that of a grid of 1 mm.
inline Samples one_sample(double along) { return {along, 1e-3, 1}; }

/// Points of one batch that share a value of across, and so one section of the surface.
using ListedLine = std::span<const ListedPoint>;

inline constexpr std::size_t kPointsPerTask = 256, kPointsPerBatch = 32;
/// A batch that more cells lie over, or that is wider than this, is split, unless all its points lie on one line.
inline constexpr std::size_t kCellsPerBatch = 6;
inline constexpr double kWidestBatch = 8e-3;  // [m]

/// Cuts [points) into batches of neighbours. over(across, along): the cells over a rectangle; count(cells): how many;
/// use(batch, cells): called for every batch in the order of the list, also with no cells.
template <class Over, class Count, class Use>
void split_batch(std::span<const ListedPoint> points, const Over& over, const Count& count, const Use& use) {
  Interval across = Interval::none(), along = Interval::none();
  for (const ListedPoint& p : points) {
    across.include({p.across, p.across});
    along.include({p.along, p.along});
  }
  const bool may_split = points.size() > 1 && across.low < across.high;
  const auto split = [&] {
    const std::size_t half = points.size() / 2;
    split_batch(points.first(half), over, count, use);
    split_batch(points.subspan(half), over, count, use);
  };
  if (may_split && std::max(across.width(), along.width()) > kWidestBatch) return split();
  const auto cells = over(across, along);
  if (may_split && count(cells) > kCellsPerBatch) return split();
  use(points, cells);
}

/// Calls use(line) for the lines of a batch.
template <class Use>
void for_lines(std::span<const ListedPoint> batch, const Use& use) {
  for (std::size_t first = 0; first < batch.size();) {
    std::size_t last = first + 1;
    while (last < batch.size() && batch[last].across == batch[first].across) ++last;
    use(batch.subspan(first, last - first));
    first = last;
  }
}

/// Runs work(points) for tasks of neighbouring points, in parallel; the tasks depend on nothing but the list.
template <class Work>
void for_listed_points(std::span<const Vec2> points_P, bool along_is_y, const Work& work) {
  parallel_for((points_P.size() + kPointsPerTask - 1) / kPointsPerTask, [&](std::size_t task) {
    std::vector<ListedPoint> points;
    const std::size_t begin = task * kPointsPerTask, end = std::min(points_P.size(), begin + kPointsPerTask);
    for (std::size_t i = begin; i < end; ++i)
      points.push_back({points_P[i][along_is_y ? 0 : 1], points_P[i][along_is_y ? 1 : 0], i});
    work(std::span<const ListedPoint>(points));
  });
}

}  // namespace treadmark::spline
