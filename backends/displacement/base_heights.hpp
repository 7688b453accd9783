// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <vector>

#include "treadmark/backends/displacement/band_kernel.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::displacement {

/// Heights of a base over a grid and over one more point beyond each side of it, and where they change smoothly from
/// point to point: without a miss, and with second differences as a curvature of kBend may make them. A fold of the
/// base between neighbours, where one sheet hides another, shows as a jump.
class BaseHeights {
 public:
  /// Asks the base for heights into out.z, and for slopes into out.dzdx and out.dzdy, each of grid.size() or empty.
  BaseHeights(const Surface& base, const PlaneGrid& plane_grid, const HeightsOut& out);

  static constexpr double kBend = 100.0;  ///< [1/m]

  /// Row iy in [-1, ny]; entries -1 to nx.
  const double* row(int iy) const { return z_.data() + static_cast<std::size_t>(iy + 1) * stride_ + 1; }

  using enum Smooth;
  std::uint8_t smooth(int ix, int iy) const {
    return smooth_[static_cast<std::size_t>(iy) * static_cast<std::size_t>(g_.nx) + static_cast<std::size_t>(ix)];
  }

 private:
  double* row(int iy) { return z_.data() + static_cast<std::size_t>(iy + 1) * stride_ + 1; }
  void ask_rim(const Surface& base, const Pose& X_SP);
  void judge();

  Grid2 g_;
  std::size_t stride_;
  std::vector<double> z_;
  std::vector<std::uint8_t> smooth_;
};

}  // namespace treadmark::displacement
