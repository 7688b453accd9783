// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/base_heights.hpp"
#include "treadmark/core/kernel.hpp"

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
  const BandKernel& kernel = fastest_kernel<BandKernel>();
  const BendLimits limits{1.0 / g_.dx, 1.0 / g_.dy, kBend * g_.dx * g_.dx, kBend * g_.dy * g_.dy};
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
    for (const int ix : {-1, g_.nx}) b[ix] = z[ix] == z[ix] ? kAlongX | kAlongY : 0;
    kernel.bends(static_cast<std::size_t>(g_.nx), z, row(iy - 1), row(iy + 1), limits, b);
  }
  for (int iy = 0; iy < g_.ny; ++iy) {
    std::uint8_t* s = smooth_.data() + static_cast<std::size_t>(iy) * static_cast<std::size_t>(g_.nx);
    kernel.smooth(static_cast<std::size_t>(g_.nx), bent(iy - 1), bent(iy), bent(iy + 1), s);
  }
}

}  // namespace treadmark::displacement
