// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/defect_depth.hpp"

#include <algorithm>
#include <numbers>

#include "treadmark/solvers/wheelrail/mirror.hpp"

namespace treadmark::app {
namespace {

std::vector<double> heights(const Surface& surface, const Pose& X_SP, const Grid2& grid) {
  std::vector<double> z(grid.size());
  surface.heights({X_SP, grid}, {z, {}, {}});
  return z;
}

/// Surfaces are those of right-hand wheels: of a left-hand one the mirror image is asked for.
wheelrail::Placement in_mirror(const wheelrail::Placement& placement) {
  wheelrail::PairSolution seen;
  seen.placement = placement;
  return wheelrail::mirrored(std::move(seen)).placement;
}

Grid2 in_mirror(Grid2 grid) {
  grid.y0 = -grid.y(grid.ny - 1);
  return grid;
}

}  // namespace

std::vector<double> DefectDepth::over(const Grid2& grid_T, const wheelrail::Placement& placement,
                                      wheelrail::Side side) const {
  const bool left = side == wheelrail::Side::left;
  const Grid2 grid = left ? in_mirror(grid_T) : grid_T;
  const Pose X_AT = (left ? in_mirror(placement) : placement).X_TA.inverse();
  const Pose half_a_turn{Vec3::Zero(), rotation_y(std::numbers::pi)};
  std::vector<double> depth = sound_ ? heights(*sound_, X_AT, grid) : heights(*wheel_, half_a_turn * X_AT, grid);
  const std::vector<double> actual = heights(*wheel_, X_AT, grid);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] -= actual[i];
  if (!left) return depth;
  std::vector<double> seen(depth.size());
  for (int iy = 0; iy < grid.ny; ++iy)
    std::copy_n(depth.begin() + static_cast<std::ptrdiff_t>(grid.index(0, iy)), grid.nx,
                seen.begin() + static_cast<std::ptrdiff_t>(grid.index(0, grid.ny - 1 - iy)));
  return seen;
}

}  // namespace treadmark::app
