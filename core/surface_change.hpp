// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark {

/// Derivatives of heights where it is known how the points of a surface move (Surface::do_heights_by).
/// displacement: const SurfacePoint& -> Vec3, of the point per unit of the parameter [m], surface frame. Only its part
/// along the normal changes the shape: a height over a place that stays changes by d.n / up.n.
template <class Displacement>
void heights_by_displacement(const Surface& surface, const PlaneGrid& plane_grid, std::span<double> by,
                             Displacement&& displacement) {
  const Grid2& g = plane_grid.grid;
  std::vector<Vec2> points;
  points.reserve(g.size());
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) points.emplace_back(g.x(ix), g.y(iy));
  std::vector<SurfacePoint> at(points.size());
  surface.locate(plane_grid.X_SP, points, at);
  const Vec3 up = plane_grid.X_SP.rotation.col(2);
  for (std::size_t i = 0; i < at.size(); ++i)
    by[i] = at[i].status == LocateStatus::outside ? std::numeric_limits<double>::quiet_NaN()
                                                  : displacement(at[i]).dot(at[i].normal_S) / up.dot(at[i].normal_S);
}

}  // namespace treadmark
