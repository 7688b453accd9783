// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A point at a time: what grids save.
#include "treadmark/bench/distance/enter.hpp"

namespace treadmark::bench {
namespace {

std::vector<double> point_by_point(const detection::BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C) {
  const Pose X_RC = bodies.X_TR.inverse() * X_TC, X_WC = bodies.X_TW.inverse() * X_TC;
  std::vector<double> out;
  out.reserve(grid_C.size());
  for (int iy = 0; iy < grid_C.ny; ++iy)
    for (int ix = 0; ix < grid_C.nx; ++ix) {
      const Vec2 p(grid_C.x(ix), grid_C.y(iy));
      out.push_back(height_at(*bodies.rail, X_RC, p) - height_at(*bodies.wheel, X_WC, p));
    }
  return out;
}

[[maybe_unused]] const bool entered = enter_distance("points", point_by_point);

}  // namespace
}  // namespace treadmark::bench
