// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/base_heights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::displacement {

BaseHeights::BaseHeights(const Surface& base, const PlaneGrid& plane_grid, const HeightsOut& out)
    : g_(plane_grid.grid),
      stride_(static_cast<std::size_t>(g_.nx) + 2),
      z_(stride_ * (static_cast<std::size_t>(g_.ny) + 2), std::numeric_limits<double>::quiet_NaN()),
      smooth_(g_.size()) {
  base.heights(plane_grid, out);
  const auto nx = static_cast<std::size_t>(g_.nx);
  for (int iy = 0; iy < g_.ny; ++iy) std::copy_n(out.z.data() + nx * static_cast<std::size_t>(iy), nx, row(iy));
  ask_rim(base, plane_grid.X_SP);
  judge();
}

void BaseHeights::ask_rim(const Surface& base, const Pose& X_SP) {
  std::vector<double> column(static_cast<std::size_t>(g_.ny));
  for (const int ix : {-1, g_.nx}) {
    base.heights({X_SP, {g_.x(ix), g_.y0, g_.dx, g_.dy, 1, g_.ny}}, {column, {}, {}});
    for (int iy = 0; iy < g_.ny; ++iy) row(iy)[ix] = column[static_cast<std::size_t>(iy)];
  }
  for (const int iy : {-1, g_.ny})
    base.heights({X_SP, {g_.x0, g_.y(iy), g_.dx, g_.dy, g_.nx, 1}},
                 {{row(iy), static_cast<std::size_t>(g_.nx)}, {}, {}});
}

void BaseHeights::judge() {
  constexpr double kRounding = 1e-8;  // [m]
  const double per_dx = 1.0 / g_.dx, per_dy = 1.0 / g_.dy;
  const double most_x = kBend * g_.dx * g_.dx, most_y = kBend * g_.dy * g_.dy;
  // Beyond the grid there is nothing to compare with.
  std::vector<std::uint8_t> bends(z_.size(), kAlongX | kAlongY);
  const auto bent = [&](int iy) { return bends.data() + static_cast<std::size_t>(iy + 1) * stride_ + 1; };
  for (int iy = -1; iy <= g_.ny; ++iy) {
    const double* z = row(iy);
    std::uint8_t* b = bent(iy);
    if (iy < 0 || iy == g_.ny) {
      for (int ix = 0; ix < g_.nx; ++ix) b[ix] = z[ix] == z[ix] ? kAlongX | kAlongY : 0;
      continue;
    }
    const double *before = row(iy - 1), *behind = row(iy + 1);
    for (const int ix : {-1, g_.nx}) b[ix] = z[ix] == z[ix] ? kAlongX | kAlongY : 0;
    for (int ix = 0; ix < g_.nx; ++ix) {
      const double x1 = z[ix] - z[ix - 1], x2 = z[ix + 1] - z[ix], y1 = z[ix] - before[ix], y2 = behind[ix] - z[ix];
      const double xx = std::fabs(x2 - x1), yy = std::fabs(y2 - y1);
      // the slope without the jump, if there is one
      const double sx = std::min(std::fabs(x1), std::fabs(x2)) * per_dx,
                   sy = std::min(std::fabs(y1), std::fabs(y2)) * per_dy;
      // A second derivative is the curvature times (1 + slope^2)^1.5; a slope that is not known is none.
      const double square = (sx == sx ? sx * sx : 0.0) + (sy == sy ? sy * sy : 0.0),
                   steep = (1.0 + square) * std::sqrt(1.0 + square);
      b[ix] = static_cast<std::uint8_t>((xx <= most_x * steep + kRounding ? kAlongX : 0) |
                                        (yy <= most_y * steep + kRounding ? kAlongY : 0));
    }
  }
  for (int iy = 0; iy < g_.ny; ++iy) {
    const std::uint8_t *before = bent(iy - 1), *b = bent(iy), *behind = bent(iy + 1);
    std::uint8_t* s = smooth_.data() + static_cast<std::size_t>(iy) * static_cast<std::size_t>(g_.nx);
    for (int ix = 0; ix < g_.nx; ++ix) {
      const int along_x = b[ix - 1] & b[ix] & b[ix + 1], along_y = before[ix] & b[ix] & behind[ix];
      const int corners = before[ix - 1] & before[ix + 1] & behind[ix - 1] & behind[ix + 1];
      const int all = along_x & along_y & corners;
      s[ix] = static_cast<std::uint8_t>((along_x & kAlongX) | (along_y & kAlongY) | ((all & (all >> 1) & 1) * kAround));
    }
  }
}

}  // namespace treadmark::displacement
