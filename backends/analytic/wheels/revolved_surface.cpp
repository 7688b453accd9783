// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/revolved_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/backends/analytic/wheels/wheel_bounds.hpp"
#include "treadmark/backends/analytic/wheels/wheel_lines.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::analytic {

namespace {

/// Normal and principal curvatures from the Hessian of F in the axes e_r, e_theta, e_y.
void fill_shape(const WheelBody& body, const WheelHit& hit, SurfacePoint& point) {
  const double theta = std::atan2(hit.x, hit.z), r = hit.r;
  const Jet curve = body.curve.jet(hit.y, body.curve.find(hit.y, 0));
  const DepthJet d = body.flats.jet(theta, hit.y);
  const Vec3 g(1.0, d.d_theta / r, d.d_y - curve.dh);
  Mat3 H = Mat3::Zero();
  H(0, 1) = H(1, 0) = -d.d_theta / (r * r);
  H(1, 1) = d.d_theta_theta / (r * r) + 1.0 / r;
  H(1, 2) = H(2, 1) = d.d_theta_y / r;
  H(2, 2) = d.d_y_y - curve.ddh;

  const double length = g.norm();
  const Vec3 n = g / length;
  const Vec3 t1 = Vec3(-n.y(), n.x(), 0.0).normalized(), t2 = n.cross(t1);
  const double a = t1.dot(H * t1) / length, b = t1.dot(H * t2) / length, c = t2.dot(H * t2) / length;
  const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
  point.curvature_1 = mean + spread;
  point.curvature_2 = mean - spread;
  const double sin = hit.x / r, cos = hit.z / r;
  point.normal_S = {n.x() * sin + n.y() * cos, n.z(), n.x() * cos - n.y() * sin};
  point.u = theta;
  point.v = hit.y;
}

}  // namespace

void RevolvedSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const WheelLines lines(body_, plane_grid.X_SP, out);
  const Grid2& g = plane_grid.grid;
  // lines of points along x, or along y where those are longer and there are few; neighbouring ones one after the other
  constexpr int kFew = 8, kLinesPerTask = 8;
  const bool along_x = g.nx >= kFew || g.nx >= g.ny;
  const int count = along_x ? g.ny : g.nx;
  const auto task = [&](std::size_t k) {
    const int begin = static_cast<int>(k) * kLinesPerTask;
    lines.march(g, along_x, begin, std::min(count, begin + kLinesPerTask));
  };
  const auto tasks = static_cast<std::size_t>((count + kLinesPerTask - 1) / kLinesPerTask);
  constexpr std::size_t kWorthThreads = 4000;
  if (g.size() < kWorthThreads)
    for (std::size_t k = 0; k < tasks; ++k) task(k);
  else
    parallel_for(tasks, task);
}

void RevolvedSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  const WheelLines lines(body_, X_SP, out);
  constexpr std::size_t kPointsPerTask = 1024;
  parallel_for((points_P.size() + kPointsPerTask - 1) / kPointsPerTask, [&](std::size_t task) {
    lines.follow(points_P, task * kPointsPerTask, std::min(points_P.size(), (task + 1) * kPointsPerTask));
  });
}

void RevolvedSurface::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double theta = uv[i].x(), y = uv[i].y();
    out[i] = {};
    if (!std::isfinite(theta) || !(y >= body_.curve.y_min() && y <= body_.curve.y_max())) continue;
    const Jet curve = body_.curve.jet(y, body_.curve.find(y, 0));
    const DepthJet d = body_.flats.jet(theta, y);
    const double r = body_.nominal_radius + curve.h - d.d, r_y = curve.dh - d.d_y;
    const Vec3 e(std::sin(theta), 0.0, std::cos(theta)), along(e.z(), 0.0, -e.x()), axle = Vec3::UnitY();
    out[i] = {r * e + y * axle,
              r * along - d.d_theta * e,
              r_y * e + axle,
              (-d.d_theta_theta - r) * e - 2.0 * d.d_theta * along,
              r_y * along - d.d_theta_y * e,
              (curve.ddh - d.d_y_y) * e,
              1.0};
  }
}

void RevolvedSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  WheelRay ray(body_, X_SP.rotation.col(2));
  WheelHit hit;
  Vec3 before = Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), normal = before;
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    out[i] = {};
    const Vec3 origin = X_SP.apply({points_P[i].x(), points_P[i].y(), 0.0});
    // from the tangent plane at the point before
    const double guess = normal.dot(before - origin) / normal.dot(X_SP.rotation.col(2));
    if (!ray.cast(origin, guess, hit)) continue;
    ray.refine(hit);
    out[i].position_S = before = {hit.x, hit.y, hit.z};
    fill_shape(body_, hit, out[i]);
    normal = out[i].normal_S;
    out[i].status = ray.hides_others(hit) ? LocateStatus::ambiguous : LocateStatus::converged;
  }
}

HeightBounds RevolvedSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const auto bounds = body_.hull.heights(body_.nominal_radius, body_.flats, X_SP, r);
  return bounds ? *bounds : WheelBounds(body_, X_SP, r).heights();
}

}  // namespace treadmark::analytic
