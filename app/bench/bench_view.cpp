// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/bench_view.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::app {
namespace {

constexpr RollYawPitch kTilt{0.05, 0.03, 0.02};

/// Looks straight at the surface: along z of a rail, along the radius of a wheel.
Pose level_pose(const Surface& surface, const Vec3& contact_S) {
  Pose level{contact_S, Mat3::Identity()};
  if (surface.facing() == Facing::down) level.rotation = rotation_y(std::atan2(contact_S.x(), contact_S.z()));
  return level;
}

BenchView::Plane seen(const Surface& surface, const Pose& X_SP, const Grid2& grid) {
  BenchView::Plane plane{X_SP, {}, {}, {}};
  for (auto* values : {&plane.z, &plane.dzdx, &plane.dzdy}) values->resize(grid.size());
  surface.heights({X_SP, grid}, {plane.z, plane.dzdx, plane.dzdy});
  return plane;
}

double largest_curvature(const Surface& surface, const Pose& X_SP, const Grid2& grid) {
  constexpr int kEvery = 8;
  std::vector<Vec2> points;
  for (int iy = 0; iy < grid.ny; iy += kEvery)
    for (int ix = 0; ix < grid.nx; ix += 2 * kEvery) points.emplace_back(grid.x(ix), grid.y(iy));
  std::vector<SurfacePoint> found(points.size());
  surface.locate(X_SP, points, found);
  double largest = 0.0;
  for (const SurfacePoint& p : found)
    if (p.status != LocateStatus::outside)
      largest = std::fmax(largest, std::fmax(std::abs(p.curvature_1), std::abs(p.curvature_2)));
  return largest;
}

}  // namespace

BenchView make_bench_view(const Surface& surface, const Vec3& contact_S, double y_before, double y_after,
                          const BenchGrid& size) {
  BenchView view;
  Grid2& g = view.grid;
  g.dx = g.dy = size.step;
  g.ny = std::max(3, static_cast<int>((y_after - y_before) / g.dy));
  g.nx = std::max(3, size.points / g.ny);
  g.x0 = -0.5 * (g.nx - 1) * g.dx;
  g.y0 = 0.5 * (y_before + y_after) - 0.5 * (g.ny - 1) * g.dy;
  const Pose level = level_pose(surface, contact_S);
  view.level = seen(surface, level, g);
  view.tilted = seen(surface, {level.origin, level.rotation * rotation(kTilt)}, g);
  view.largest_curvature = largest_curvature(surface, level, g);
  return view;
}

}  // namespace treadmark::app
