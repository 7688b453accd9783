// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/cut_surface.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/cut_bounds.hpp"
#include "treadmark/backends/analytic/cutter_ray.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::analytic {

namespace {

/// Lines of one direction through all cutters; one object serves one thread.
class Rays {
 public:
  Rays(const std::vector<Cutter>& cutters, const Vec3& direction) {
    rays_.reserve(cutters.size());
    for (const Cutter& cutter : cutters) rays_.emplace_back(cutter, direction);
  }

  /// If the point at t is removed by some cutter: the first point beyond it that none removes, and the last cutter
  /// left.
  bool leave(const Vec3& origin, double t, CutterRay::Hit& hit, std::size_t& last) {
    bool removed = false;
    for (std::size_t i = 0, kept_by = 0; kept_by < rays_.size(); i = (i + 1) % rays_.size()) {
      CutterRay::Hit next;
      if (!(removed && i == last) && rays_[i].leave(origin, t, next)) {
        removed = true;
        last = i;
        hit = next;
        t = next.t;
        kept_by = 1;
      } else {
        ++kept_by;
      }
    }
    return removed;
  }

 private:
  std::vector<CutterRay> rays_;
};

/// Replaces the height z of the base, and its slopes, where the point at it is removed.
void cut_point(Rays& rays, const Pose& X, const Vec3& origin, double z, const HeightsOut& out, std::size_t i) {
  CutterRay::Hit hit;
  std::size_t last = 0;
  if (std::isnan(z) || !rays.leave(origin, z, hit, last)) return;
  if (!out.z.empty()) out.z[i] = hit.t;
  if (out.dzdx.empty() && out.dzdy.empty()) return;
  const Vec3 f = X.rotation.transpose() * hit.gradient;
  if (!out.dzdx.empty()) out.dzdx[i] = -f.x() / f.z();
  if (!out.dzdy.empty()) out.dzdy[i] = -f.y() / f.z();
}

/// Heights of the base in out.z, or beside it if they are not wanted.
template <class Evaluate>
std::span<const double> base_heights(const HeightsOut& out, std::size_t count, std::vector<double>& spare,
                                     Evaluate evaluate) {
  HeightsOut base = out;
  if (out.z.empty()) {
    spare.resize(count);
    base.z = spare;
  }
  evaluate(base);
  return base.z;
}

/// Normal and principal curvatures of the surface bound = 0, which is solid where it is negative.
void fill_shape(const Vec3& gradient, const Mat3& hessian, SurfacePoint& point) {
  const double length = gradient.norm();
  const Vec3 n = gradient / length;
  const Vec3 t1 = n.unitOrthogonal(), t2 = n.cross(t1);
  const double a = t1.dot(hessian * t1) / length, b = t1.dot(hessian * t2) / length, c = t2.dot(hessian * t2) / length;
  const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
  point.normal_S = n;
  point.curvature_1 = mean + spread;
  point.curvature_2 = mean - spread;
}

}  // namespace

Box3 CutSurface::bounds() const {
  Box3 box = base_->bounds();
  for (const Cutter& cutter : cutters_) box.max.z() = std::max(box.max.z(), cutter.z_max());
  return box;
}

std::size_t CutSurface::memory_bytes() const {
  std::size_t sum = sizeof(*this) + base_->memory_bytes();
  for (const Cutter& cutter : cutters_) sum += cutter.memory_bytes();
  return sum;
}

void CutSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const Grid2& g = plane_grid.grid;
  const Pose& X = plane_grid.X_SP;
  std::vector<double> spare;
  const auto z = base_heights(out, g.size(), spare, [&](const HeightsOut& base) { base_->heights(plane_grid, base); });
  const auto row = [&](std::size_t iy) {
    Rays rays(cutters_, X.rotation.col(2));
    const Vec3 start = X.origin + X.rotation.col(1) * g.y(static_cast<int>(iy));
    for (int ix = 0; ix < g.nx; ++ix) {
      const std::size_t i = g.index(ix, static_cast<int>(iy));
      cut_point(rays, X, start + X.rotation.col(0) * g.x(ix), z[i], out, i);
    }
  };
  constexpr std::size_t kWorthThreads = 10'000;
  if (g.size() < kWorthThreads)
    for (std::size_t iy = 0; iy < static_cast<std::size_t>(g.ny); ++iy) row(iy);
  else
    parallel_for(static_cast<std::size_t>(g.ny), row);
}

void CutSurface::do_heights_at(const Pose& X, std::span<const Vec2> points_P, const HeightsOut& out) const {
  std::vector<double> spare;
  const auto z =
      base_heights(out, points_P.size(), spare, [&](const HeightsOut& base) { base_->heights_at(X, points_P, base); });
  Rays rays(cutters_, X.rotation.col(2));
  for (std::size_t i = 0; i < points_P.size(); ++i)
    cut_point(rays, X, X.apply({points_P[i].x(), points_P[i].y(), 0.0}), z[i], out, i);
}

void CutSurface::do_locate(const Pose& X, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  base_->locate(X, points_P, out);
  const Vec3 n = X.rotation.col(2);
  Rays rays(cutters_, n);
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    SurfacePoint& point = out[i];
    if (point.status == LocateStatus::outside) continue;
    const Vec3 origin = X.apply({points_P[i].x(), points_P[i].y(), 0.0});
    CutterRay::Hit hit;
    Cutter::Hint hint;
    std::size_t last = 0;
    if (!rays.leave(origin, n.dot(point.position_S - origin), hit, last)) continue;
    point.position_S = origin + hit.t * n;
    point.u = point.position_S.x();
    fill_shape(hit.gradient, cutters_[last].hessian(hit.bound, point.position_S, hint), point);
  }
}

HeightBounds CutSurface::do_height_bounds(const Pose& X, const Rectangle& rectangle_P) const {
  return cut_bounds(cutters_, X, rectangle_P, base_->height_bounds(X, rectangle_P));
}

}  // namespace treadmark::analytic
