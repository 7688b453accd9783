// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::offset {

/// Steps below this are a mistake, and places counted in them are no integers [m] or [rad].
inline constexpr double kLeastStep = 1e-9;

/// Where voxels lie: (u, y) = (u0 + i du, y0 + j dy).
struct SheetFrame {
  Body body = Body::rail;
  double u0 = 0.0, y0 = 0.0;  ///< [m] or [rad]; [m]
  double du = 1.0, dy = 1.0;
  int turn = 0;  ///< voxels round a wheel that is covered all round; i then counts modulo turn. 0: a patch, or a rail
  double first = 0.0, last = 0.0;  ///< i of a patch on a wheel, to choose the branch of theta

  double period() const { return turn > 0 ? turn : 2.0 * std::numbers::pi / du; }  ///< of a wheel [voxels]
  double branch_begin() const { return turn > 0 ? 0.0 : 0.5 * (first + last - period()); }

  /// u in voxels, on the branch the voxels are on.
  double along(double u) const {
    const double s = (u - u0) / du;
    if (body == Body::rail) return s;
    const double low = branch_begin(), period = this->period();
    const double inside = s - period * std::floor((s - low) / period);
    return inside >= low + period ? low : inside;
  }
  double across(double y) const { return (y - y0) / dy; }
  int wrapped(int i) const {
    if (turn == 0) return i;
    const int k = i % turn;
    return k < 0 ? k + turn : k;
  }
};

class SparseOffsets {
 public:
  SheetFrame frame;
  double tolerance = 0.0;               ///< [m]
  double nominal_radius = 0.0;          ///< wheel [m]
  SheetGrid grid;                       ///< values [m]
  std::optional<SheetGrid> cubic = {};  ///< coefficients of the cubic spline, where a file has brought them [m]
};

}  // namespace treadmark::offset
