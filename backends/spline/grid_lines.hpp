// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "treadmark/backends/spline/section_raster.hpp"
#include "treadmark/core/grid.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::spline {

/// A plane grid as lines of points: "along" a line and "across" from line to line.
struct GridLines {
  bool along_is_y = true;
  Vec3 along, across, normal;  ///< unit vectors in the surface frame
  Vec3 origin;                 ///< of the plane, in the surface frame [m]
  Samples samples;             ///< along
  double across_first = 0.0, across_step = 0.0;
  int lines = 0;
  std::size_t along_stride = 1, across_stride = 1;

  GridLines(const PlaneGrid& plane_grid, bool lines_along_y);

  double across_at(int line) const { return across_first + line * across_step; }
};

inline GridLines::GridLines(const PlaneGrid& plane_grid, bool lines_along_y) : along_is_y(lines_along_y) {
  const Grid2& g = plane_grid.grid;
  const Mat3& axes = plane_grid.X_SP.rotation;
  origin = plane_grid.X_SP.origin;
  normal = axes.col(2);
  const auto row = static_cast<std::size_t>(g.nx);
  if (along_is_y) {
    along = axes.col(1), across = axes.col(0);
    samples = {g.y0, g.dy, g.ny};
    across_first = g.x0, across_step = g.dx, lines = g.nx;
    along_stride = row, across_stride = 1;
  } else {
    along = axes.col(0), across = axes.col(1);
    samples = {g.x0, g.dx, g.nx};
    across_first = g.y0, across_step = g.dy, lines = g.ny;
    along_stride = 1, across_stride = row;
  }
}

/// Receiver of a section raster: keeps the outermost hit of every grid point of one line.
class ColumnHits {
 public:
  ColumnHits(int count, Facing facing) : sign_(facing == Facing::up ? -1.0 : 1.0) {
    resize(count);
    clear();
  }

  /// To be cleared afterwards. All but n have room up to a multiple of four.
  void resize(int count) {
    const auto size = static_cast<std::size_t>(count), padded = (size + 3) / 4 * 4;
    n.resize(size), v.resize(padded), u.resize(padded), cell.resize(padded), several.resize(size);
  }

  void clear() {
    n.assign(n.size(), std::numeric_limits<double>::quiet_NaN());
    several.assign(several.size(), 0);
  }

  /// Also the places, for results at all points alike.
  void clear_places() {
    v.assign(v.size(), std::numeric_limits<double>::quiet_NaN());
    u.assign(u.size(), std::numeric_limits<double>::quiet_NaN());
    cell.assign(cell.size(), 0);
  }
  double sign() const { return sign_; }

  void operator()(int i, double height, int in_cell, double at_v, double at_u) {
    const auto k = static_cast<std::size_t>(i);
    if (std::abs(height - n[k]) > kSameHit) several[k] = 1;
    if (sign_ * height <= sign_ * n[k] || std::isnan(height)) return;
    n[k] = height, v[k] = at_v, u[k] = at_u, cell[k] = in_cell;
  }

  std::vector<double> n, v, u;
  std::vector<int> cell;
  std::vector<char> several;  ///< more than one hit over the point
  std::vector<HitGuess> queue;

 private:
  static constexpr double kSameHit = 1e-9;  // [m], hits nearer than this are the same one, found from two cells
  double sign_;
};

}  // namespace treadmark::spline
