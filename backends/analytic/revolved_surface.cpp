// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/revolved_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/backends/analytic/wheel_bounds.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::analytic {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Vec3 gradient(const WheelHit& hit) {
  const double sin = hit.x / hit.r, cos = hit.z / hit.r, along = hit.f_theta / hit.r;
  return {sin + along * cos, hit.f_y, cos - along * sin};
}

/// One row, every line started from the three before it.
void march_row(const WheelBody& body, const PlaneGrid& plane_grid, const HeightsOut& out, int iy) {
  const Pose& X = plane_grid.X_SP;
  const Grid2& g = plane_grid.grid;
  const bool slopes = !out.dzdx.empty() || !out.dzdy.empty();
  WheelRay ray(body, X.rotation.col(2));
  const Vec3 row = X.origin + X.rotation.col(1) * g.y(iy);
  double t1 = kNaN, t2 = kNaN, t3 = kNaN;  // heights of the points before, nearest first
  WheelHit hit;
  for (int ix = 0; ix < g.nx; ++ix) {
    const std::size_t i = g.index(ix, iy);
    double guess = 3.0 * (t1 - t2) + t3;
    if (std::isnan(guess)) guess = std::isnan(t2) ? t1 : 2.0 * t1 - t2;
    const bool found = ray.cast(row + X.rotation.col(0) * g.x(ix), guess, hit, slopes);
    t3 = t2;
    t2 = t1;
    t1 = found ? hit.t : kNaN;
    if (!out.z.empty()) out.z[i] = t1;
    if (!slopes) continue;
    double dzdx = kNaN, dzdy = kNaN;
    if (found) {
      const Vec3 f = X.rotation.transpose() * gradient(hit);
      dzdx = -f.x() / f.z();
      dzdy = -f.y() / f.z();
    }
    if (!out.dzdx.empty()) out.dzdx[i] = dzdx;
    if (!out.dzdy.empty()) out.dzdy[i] = dzdy;
  }
}

/// Points [begin, end) of a list, every line started from the tangent plane at the hit before, bent as that hit lay off its
/// own start.
void follow_list(const WheelBody& body, const Pose& X, std::span<const Vec2> points, const HeightsOut& out, std::size_t begin,
                 std::size_t end) {
  WheelRay ray(body, X.rotation.col(2));
  WheelHit hit;
  const bool slopes = !out.dzdx.empty() || !out.dzdy.empty();
  double z = kNaN, dzdx = kNaN, dzdy = kNaN, bend = 0.0;
  Vec2 before = Vec2::Zero();
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2& p = points[i];
    const double dx = p.x() - before.x(), dy = p.y() - before.y(), distance_2 = dx * dx + dy * dy;
    const double tangent = z + dzdx * dx + dzdy * dy;
    const bool found = ray.cast(X.apply({p.x(), p.y(), 0.0}), tangent + bend * distance_2, hit, slopes);
    if (found) {
      const Vec3 f = X.rotation.transpose() * gradient(hit);
      z = hit.t;
      dzdx = -f.x() / f.z();
      dzdy = -f.y() / f.z();
      bend = distance_2 > 0.0 && !std::isnan(tangent) ? (z - tangent) / distance_2 : 0.0;
      before = p;
    }
    if (!out.z.empty()) out.z[i] = found ? z : kNaN;
    if (!out.dzdx.empty()) out.dzdx[i] = found ? dzdx : kNaN;
    if (!out.dzdy.empty()) out.dzdy[i] = found ? dzdy : kNaN;
  }
}

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
  constexpr std::size_t kWorthThreads = 4000;
  if (plane_grid.grid.size() < kWorthThreads)
    for (int iy = 0; iy < plane_grid.grid.ny; ++iy) march_row(body_, plane_grid, out, iy);
  else
    parallel_for(static_cast<std::size_t>(plane_grid.grid.ny),
                 [&](std::size_t iy) { march_row(body_, plane_grid, out, static_cast<int>(iy)); });
}

void RevolvedSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  constexpr std::size_t kPointsPerTask = 1024;
  parallel_for((points_P.size() + kPointsPerTask - 1) / kPointsPerTask, [&](std::size_t task) {
    follow_list(body_, X_SP, points_P, out, task * kPointsPerTask, std::min(points_P.size(), (task + 1) * kPointsPerTask));
  });
}

void RevolvedSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  WheelRay ray(body_, X_SP.rotation.col(2));
  WheelHit hit;
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    out[i] = {};
    if (!ray.cast(X_SP.apply({points_P[i].x(), points_P[i].y(), 0.0}), kNaN, hit)) continue;
    ray.refine(hit);
    out[i].position_S = {hit.x, hit.y, hit.z};
    fill_shape(body_, hit, out[i]);
    out[i].status = ray.hides_others(hit) ? LocateStatus::ambiguous : LocateStatus::converged;
  }
}

HeightBounds RevolvedSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const auto bounds = body_.hull.heights(body_.nominal_radius, body_.flats, X_SP, r);
  return bounds ? *bounds : WheelBounds(body_, X_SP, r).heights();
}

}  // namespace treadmark::analytic
