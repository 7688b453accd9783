// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/analytic/defects/cut_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/defects/cutter_ray.hpp"
#include "treadmark/core/constants.hpp"
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

namespace {

constexpr double kRounding = 1e-12;  // [m]

struct Window {
  double low, high;
  Window widened(double by) const { return {low - by, high + by}; }
};

/// All lines over the rectangle. A point at height t has the coordinates w across and a + m t along the part of the
/// normal in the section's plane, d of unit length.
struct Lines {
  double d_y, d_z, m, n_x;
  Window w, a, x;  ///< x at t = 0
  double size;

  Lines(const Pose& X, const Rectangle& r) : n_x(X.rotation(0, 2)) {
    const double n_y = X.rotation(1, 2), n_z = X.rotation(2, 2);
    m = std::sqrt(n_y * n_y + n_z * n_z);
    if (!(m > 0.0)) return;
    d_y = n_y / m;
    d_z = n_z / m;
    const double hx = 0.5 * (r.x_max - r.x_min), hy = 0.5 * (r.y_max - r.y_min);
    size = hx + hy;
    const auto e_x = X.rotation.col(0), e_y = X.rotation.col(1);
    const Vec3 middle = X.origin + e_x * (r.x_min + hx) + e_y * (r.y_min + hy);
    const auto window = [&](const auto& of) {
      const double half = std::fabs(of(e_x)) * hx + std::fabs(of(e_y)) * hy + kRounding;
      return Window{of(middle) - half, of(middle) + half};
    };
    w = window([&](const auto& p) { return p.y() * d_z - p.z() * d_y; });
    a = window([&](const auto& p) { return p.y() * d_y + p.z() * d_z; });
    x = window([](const auto& p) { return p.x(); });
  }
  /// Places x of all points with t in a window.
  Window x_over(const Window& t) const {
    return {x.low + std::min(n_x * t.low, n_x * t.high), x.high + std::max(n_x * t.low, n_x * t.high)};
  }
};

/// The greatest h on the wall above an end (s, q) of the section, seen along (d_s, d_q), d_q > 0, over a window of w.
double greatest_on_wall(double s, double q, double d_s, double d_q, const Window& w) {
  const double w_end = s * d_q - q * d_s;
  const double up = w_end < w.low ? (w.low - w_end) / d_s : w_end > w.high ? (w.high - w_end) / d_s : 0.0;
  return up >= 0.0 ? s * d_s + (q - up) * d_q : -kInfinity;
}

struct Reach {
  double greatest = -kInfinity;  ///< of t where lines leave the volume; -infinity if none can be in it
  double least = -kInfinity;     ///< below this t all points of the lines are removed
};

/// For results t in a window, whose low end no result can be below.
Reach reach(const Cutter& cutter, const Lines& lines, const Window& t) {
  const Window x = lines.x_over(t);
  if (x.high < cutter.x_min() || x.low > cutter.x_max()) return {};
  const CutterPath& path = cutter.path();
  const CutterPath::Range y = path.range(CutterPath::kY, x.low, x.high), z = path.range(CutterPath::kZ, x.low, x.high);
  const CutterPath::Range roll = path.range(CutterPath::kRoll, x.low, x.high);
  const double thickness = std::hypot(0.5 * (y.high - y.low), 0.5 * (z.high - z.low)) +
                           0.5 * (roll.high - roll.low) * cutter.reach() + kRounding;
  const double y_m = 0.5 * (y.low + y.high), z_m = 0.5 * (z.low + z.high), r_m = 0.5 * (roll.low + roll.high);
  const double cos = std::cos(r_m), sin = std::sin(r_m);
  const double d_s = cos * lines.d_y + sin * lines.d_z, d_q = cos * lines.d_z - sin * lines.d_y;
  constexpr double kSideways = 0.05;  // a wall seen nearly from above ends far down
  if (d_q < kSideways) return {kInfinity, -kInfinity};

  // the section at the middle of the path, and places relative to it
  const Window w = lines.w.widened(thickness);
  const double w_m = y_m * lines.d_z - z_m * lines.d_y, h_m = y_m * lines.d_y + z_m * lines.d_z;
  const Window v{w.low - w_m, w.high - w_m};
  const TurnedChain view(d_s, d_q);
  const double coarse = 1e-6 + 0.02 * lines.size;
  const GraphCurve& section = cutter.section();
  const double h_start = section.start_height(), h_end = section.end_height();
  const double high = std::max({view.greatest(cutter.chords(), v.low, v.high, coarse),
                                greatest_on_wall(cutter.s_min(), h_start, d_s, d_q, v),
                                greatest_on_wall(cutter.s_max(), h_end, d_s, d_q, v)});
  if (!(high > -kInfinity)) return {};
  Reach result;
  result.greatest = (high + h_m + thickness - lines.a.low) / lines.m + kRounding;

  if (!(x.low > cutter.x_min() && x.high < cutter.x_max())) return result;
  const double low = view.least(cutter.chords(), v.low, v.high, coarse) - thickness;
  const double from = lines.m * t.low + lines.a.low - h_m - kRounding;
  if (!std::isfinite(low) || low <= from) return result;
  // Between `from` and `low` no point of the section lies over the window; so all of it is removed, or nothing.
  const double s_low = v.low * d_q + std::min(from * d_s, low * d_s),
               s_high = v.high * d_q + std::max(from * d_s, low * d_s);
  if (!(s_low - thickness > cutter.s_min() && s_high + thickness < cutter.s_max())) return result;
  const double v_m = 0.5 * (v.low + v.high), s = v_m * d_q + low * d_s, q = low * d_q - v_m * d_s;
  if (section.height(s, section.find(s, 0)) > q) result.least = (low + h_m - lines.a.high) / lines.m - kRounding;
  return result;
}

}  // namespace

HeightBounds cut_bounds(std::span<const Cutter> cutters, const Pose& X_SP, const Rectangle& r,
                        const HeightBounds& base) {
  if (base.empty) return base;
  const Lines lines(X_SP, r);
  HeightBounds result = base;
  constexpr double kAlong = 1e-6;
  for (const Cutter& cutter : cutters) {
    if (!(lines.m > kAlong)) {
      result.z_max = kInfinity;
      break;
    }
    // nothing of the cutter lies further along the normal
    const double farthest =
        std::max(cutter.y_min() * lines.d_y, cutter.y_max() * lines.d_y) + cutter.z_max() * lines.d_z;
    const double last = lines.d_z > 0.0 ? std::max(base.z_max, (farthest - lines.a.low) / lines.m) : kInfinity;
    if (last == kInfinity) {
      result.z_max = kInfinity;
      continue;
    }
    Reach one = reach(cutter, lines, {base.z_min, last});
    constexpr double kWorthAnother = 0.5;
    if (std::isfinite(one.greatest) &&
        std::fabs(lines.n_x) * (last - std::max(base.z_min, one.greatest)) > kWorthAnother * lines.size)
      one = reach(cutter, lines, {base.z_min, std::max(base.z_min, one.greatest)});
    result.z_max = std::max(result.z_max, one.greatest);
    result.z_min = std::max(result.z_min, one.least);
  }
  return result;
}

}  // namespace treadmark::analytic
