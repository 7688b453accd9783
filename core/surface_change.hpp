// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
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

/// The way back from there (Surface::do_pull_back). take: (i, const SurfacePoint&, const Vec3& force); what is wanted
/// of a parameter is the sum of force . displacement over all points. force: the weight of point i, along the normal.
template <class Take>
void pull_back_by_displacement(const Surface& surface, const Pose& X_SP, std::span<const Vec2> points_P,
                               std::span<const double> weights, Take&& take) {
  std::vector<SurfacePoint> at(points_P.size());
  surface.locate(X_SP, points_P, at);
  const Vec3 up = X_SP.rotation.col(2);
  for (std::size_t i = 0; i < at.size(); ++i)
    if (at[i].status != LocateStatus::outside)
      take(i, at[i], Vec3(weights[i] / up.dot(at[i].normal_S) * at[i].normal_S));
}

/// A step of a parameter that moves a surface over this width [m]: between near places little height is much curvature,
/// some four times this; little beside that of a rail's crown, while contact still moves by more than its place is
/// uncertain.
inline double step_over(double width) {
  constexpr double kCurvature = 1e-3, kLeast = 2e-11, kMost = 5e-8;  // [1/m], [m], [m]
  return std::clamp(kCurvature * width * width, kLeast, kMost);
}

}  // namespace treadmark
