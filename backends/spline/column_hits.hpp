// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/backends/spline/section_raster.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::spline {

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
