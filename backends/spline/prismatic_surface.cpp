// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/prismatic_surface.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "treadmark/backends/spline/grid_lines.hpp"
#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/node_change.hpp"
#include "treadmark/backends/spline/point_batches.hpp"
#include "treadmark/backends/spline/profile_tree.hpp"
#include "treadmark/backends/spline/surface_derivatives.hpp"
#include "treadmark/backends/spline/viewed_profile.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/recent.hpp"
#include "treadmark/core/surface_change.hpp"

namespace treadmark::spline {
namespace {

constexpr double kSamePosition = 1e-15;  // [m]
constexpr std::size_t kLinesPerTask = 32;

// A range of the width of the viewed profile.
struct WidthWindow {
  const ProfileView& view;
  Range width;
  double small_width;

  WidthWindow(const ProfileView& profile_view, const Interval& window)
      : view(profile_view), width(window), small_width(2.0 * window.width() + 1e-5) {}
  static Range on(const Vec2& direction, const Range& y, const Range& z) {
    return {direction.x() * y.middle + direction.y() * z.middle,
            std::abs(direction.x()) * y.half + std::abs(direction.y()) * z.half};
  }
  Interval heights(const Range& y, const Range& z) const {
    return on(view.width, y, z).overlaps(width) ? on(view.depth, y, z).interval() : Interval::none();
  }
  bool small(const Range& y, const Range& z) const { return 2.0 * on(view.width, y, z).half <= small_width; }
};

void fill(std::span<double> values, double value) { std::fill(values.begin(), values.end(), value); }

// The views that a thread used last: single points come by the hundred along the same few directions.
std::shared_ptr<const SortedProfile> sorted_view(std::uint64_t surface, const ProfileSpline& profile,
                                                 const ProfileView& view) {
  thread_local Recent<std::tuple<std::uint64_t, Vec2, Vec2>, SortedProfile> views;
  return views.of({surface, view.depth, view.width},
                  [&] { return std::make_shared<const SortedProfile>(profile, view); });
}

}  // namespace

PrismaticSurface::PrismaticSurface(ProfileSpline profile)
    : id_(owner_number()), profile_(std::move(profile)), hulls_(profile_) {}

Vec3 PrismaticSurface::point(double u, double v) const {
  const Vec2 p = profile_.position(v);
  return {u, p.x(), p.y()};
}

Box3 PrismaticSurface::bounds() const {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Interval y = Interval::none(), z = Interval::none();
  for (std::size_t k = 0; k < profile_.segments().size(); ++k) {
    const BezierCubic hull(profile_.segments()[k], profile_.breaks()[k + 1] - profile_.breaks()[k]);
    y.include(hull.range({1.0, 0.0}));
    z.include(hull.range({0.0, 1.0}));
  }
  return {{-kInfinite, y.low, z.low}, {kInfinite, y.high, z.high}};
}

std::size_t PrismaticSurface::memory_bytes() const {
  return sizeof(*this) + profile_.breaks().size_bytes() + profile_.segments().size_bytes() + hulls_.memory_bytes();
}

std::vector<ShapeParameter> PrismaticSurface::parameters() const { return node_parameters(profile_); }

std::shared_ptr<const Surface> PrismaticSurface::do_change(std::size_t parameter, double amount) const {
  return std::make_shared<PrismaticSurface>(with_node(profile_, parameter, amount));
}

bool PrismaticSurface::do_heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const {
  const ProfileSpline change = node_change(profile_, parameter);
  heights_by_displacement(*this, plane_grid, by,
                          [&](const SurfacePoint& at) -> Vec3 { return change.position(at.v).y() * Vec3::UnitZ(); });
  return true;
}

std::optional<HeightsBy> PrismaticSurface::do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                                        std::span<const double> weights, std::span<double> by) const {
  std::vector<double> v, pulling;
  pull_back_by_displacement(
      *this, X_SP, points_P, weights,
      [&](std::size_t, const SurfacePoint& at, const Vec3& force) { v.push_back(at.v), pulling.push_back(force.z()); });
  pull_back_to_nodes(profile_, v, pulling, by);
  return HeightsBy::exact;
}

void PrismaticSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  ProfileView view(plane_grid.X_SP.rotation.col(2));
  if (!view.visible()) {
    for (const auto values : {out.z, out.dzdx, out.dzdy}) fill(values, kNaN);
    return;
  }
  // (w along, w across) is a unit vector, so the greater part serves for marching.
  const Mat3& axes = plane_grid.X_SP.rotation;
  const bool along_y = std::abs(view.width.dot(lateral(axes.col(1)))) >= std::abs(view.width.dot(lateral(axes.col(0))));
  const GridLines g(plane_grid, along_y);
  if (view.width.dot(lateral(g.along)) < 0.0) view.width = -view.width;
  const double w_along = view.width.dot(lateral(g.along)), w_across = view.width.dot(lateral(g.across));
  const double w_origin = view.width.dot(lateral(g.origin));
  const double depth_along = view.depth.dot(lateral(g.along)), depth_across = view.depth.dot(lateral(g.across));
  const double depth_origin = view.depth.dot(lateral(g.origin));
  const double scale = 1.0 / view.normal_part;

  const double last_along = g.samples.last();
  Interval window = Interval::none();
  for (const double across : {g.across_at(0), g.across_at(g.lines - 1)})
    for (const double along : {g.samples.first, last_along}) {
      const double width = w_origin + w_across * across + w_along * along;
      window.include({width, width});
    }
  const double slack = kEdgeSlack * g.samples.step + 1e-12;
  window = {window.low - slack, window.high + slack};
  thread_local std::vector<int> segments;
  const WidthWindow seen(view, window);
  segments_over(ProfileTree(seen, profile_, hulls_), segments);
  const ViewedProfile viewed(profile_, view, segments);
  const std::span<double> z = out.z, dz_along = g.along_is_y ? out.dzdy : out.dzdx,
                          dz_across = g.along_is_y ? out.dzdx : out.dzdy;
  const bool slopes = !dz_along.empty() || !dz_across.empty();

  const auto raster_line = [&](int line, ColumnHits& hits) {
    const Samples samples{w_origin + w_across * g.across_at(line) + w_along * g.samples.first, w_along * g.samples.step,
                          g.samples.count};
    hits.clear();
    viewed.raster(samples, hits);
    if (!slopes) return;
    for (std::size_t i = 0; i < hits.n.size(); ++i) {
      if (std::isnan(hits.n[i])) continue;
      const SectionPoint p = viewed.point(hits.cell[i], hits.v[i], 0.0);
      hits.u[i] = p.dn / p.ds;  // slope of the viewed curve
    }
  };
  const auto write_line = [&](int line, const ColumnHits& hits) {
    const double across = g.across_at(line);
    const std::size_t start = static_cast<std::size_t>(line) * g.across_stride;
    for (std::size_t i = 0; i < hits.n.size(); ++i) {
      const std::size_t k = start + i * g.along_stride;
      const double along = g.samples.first + static_cast<double>(i) * g.samples.step;
      if (!z.empty()) z[k] = scale * (hits.n[i] - (depth_origin + depth_across * across + depth_along * along));
      if (!slopes) continue;
      const double slope = std::isnan(hits.n[i]) ? kNaN : hits.u[i];
      if (!dz_along.empty()) dz_along[k] = scale * (slope * w_along - depth_along);
      if (!dz_across.empty()) dz_across[k] = scale * (slope * w_across - depth_across);
    }
  };

  const double across_reach = std::max(std::abs(g.across_at(0)), std::abs(g.across_at(g.lines - 1)));
  if (std::abs(w_across) * across_reach < kSamePosition && std::abs(depth_across) * across_reach < kSamePosition) {
    // A plane that is only rolled: all lines are the same.
    thread_local ColumnHits hits(0, Facing::up);
    hits.resize(g.samples.count);
    raster_line(0, hits);
    write_line(0, hits);
    for (const auto values : {z, dz_along, dz_across}) {
      if (values.empty()) continue;
      if (g.along_is_y) {
        for (std::size_t i = 0; i < hits.n.size(); ++i)
          fill(values.subspan(i * g.along_stride, static_cast<std::size_t>(g.lines)), values[i * g.along_stride]);
      } else {
        for (int line = 1; line < g.lines; ++line)
          std::copy_n(values.begin(), g.samples.count,
                      values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(line) * g.across_stride));
      }
    }
    return;
  }
  const std::size_t tasks = (static_cast<std::size_t>(g.lines) + kLinesPerTask - 1) / kLinesPerTask;
  parallel_for(tasks, [&](std::size_t task) {
    ColumnHits hits(g.samples.count, Facing::up);
    const int first = static_cast<int>(task * kLinesPerTask);
    for (int line = first; line < std::min(g.lines, first + static_cast<int>(kLinesPerTask)); ++line) {
      raster_line(line, hits);
      write_line(line, hits);
    }
  });
}

void PrismaticSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  ProfileView view(X_SP.rotation.col(2));
  if (!view.visible()) {
    for (const auto values : {out.z, out.dzdx, out.dzdy}) fill(values, kNaN);
    return;
  }
  const auto on_axes = [&](const Vec2& direction) {
    return Vec3(direction.dot(lateral(X_SP.rotation.col(0))), direction.dot(lateral(X_SP.rotation.col(1))),
                direction.dot(lateral(X_SP.origin)));
  };
  const Vec3 width = on_axes(view.width), depth = on_axes(view.depth);
  const double scale = 1.0 / view.normal_part;
  const bool slopes = !out.dzdx.empty() || !out.dzdy.empty();
  const std::shared_ptr<const SortedProfile> sorted = sorted_view(id_, profile_, view);
  for_listed_points(points_P, true, [&](std::span<const ListedPoint> points) {
    ColumnHits hits(1, Facing::up);
    for (const ListedPoint& p : points) {
      const double x = p.across, y = p.along;
      sorted->hit(width.z() + width.x() * x + width.y() * y, hits);
      const double n = hits.n[0];
      if (!out.z.empty()) out.z[p.index] = scale * (n - (depth.z() + depth.x() * x + depth.y() * y));
      if (!slopes) continue;
      double slope = n;  // NaN stays
      if (!std::isnan(n)) {
        const SectionPoint at = sorted->point(hits.cell[0], hits.v[0]);
        slope = at.dn / at.ds;
      }
      if (!out.dzdx.empty()) out.dzdx[p.index] = scale * (slope * width.x() - depth.x());
      if (!out.dzdy.empty()) out.dzdy[p.index] = scale * (slope * width.y() - depth.y());
    }
  });
}

namespace {

SurfaceDerivatives prismatic_derivatives(const ProfileSpline& profile, double u, double v) {
  const Vec2 p = profile.position(v), d = profile.derivative(v), dd = profile.second_derivative(v);
  return {{u, p.x(), p.y()}, {1, 0, 0}, {0, d.x(), d.y()}, Vec3::Zero(), Vec3::Zero(), {0, dd.x(), dd.y()}};
}

}  // namespace

void PrismaticSurface::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double u = uv[i].x(), v = uv[i].y();
    const bool inside = std::isfinite(u) && v >= profile_.begin() && v <= profile_.end();
    out[i] = inside ? jet_of(prismatic_derivatives(profile_, u, v)) : SurfaceJet{};
  }
}

void PrismaticSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  const ProfileView view(X_SP.rotation.col(2));
  if (!view.visible()) {
    std::fill(out.begin(), out.end(), SurfacePoint{});
    return;
  }
  const std::shared_ptr<const SortedProfile> sorted = sorted_view(id_, profile_, view);
  ColumnHits hits(1, Facing::up);
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    const Vec3 foot = X_SP.apply({points_P[i].x(), points_P[i].y(), 0.0});
    out[i] = {};
    sorted->hit(view.width.dot(lateral(foot)), hits);
    if (std::isnan(hits.n[0])) continue;
    out[i].status = hits.several[0] ? LocateStatus::ambiguous : LocateStatus::converged;
    const double n = (hits.n[0] - view.depth.dot(lateral(foot))) / view.normal_part;
    const double v = hits.v[0];
    out[i].u = foot.x() + n * X_SP.rotation(0, 2);
    out[i].v = out[i].arc_length = v;
    set_geometry(prismatic_derivatives(profile_, out[i].u, v), out[i]);
  }
}

HeightBounds PrismaticSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const ProfileView view(X_SP.rotation.col(2));
  if (!view.visible()) return {0.0, 0.0, true};
  const Interval x{r.x_min, r.x_max}, y{r.y_min, r.y_max};
  const auto over_rectangle = [&](const Vec2& direction) {
    return direction.dot(lateral(X_SP.rotation.col(0))) * x + direction.dot(lateral(X_SP.rotation.col(1))) * y +
           direction.dot(lateral(X_SP.origin));
  };
  Interval window = over_rectangle(view.width);
  const double slack = 1e-12 + 1e-9 * window.width();
  window = {window.low - slack, window.high + slack};
  const WidthWindow seen(view, window);
  const ProfileTree tree(seen, profile_, hulls_);
  const Interval depth = BoundSearch(tree, facing()).range(tree.root());
  if (depth.empty()) return {0.0, 0.0, true};
  const Interval n = (1.0 / view.normal_part) * (depth + -1.0 * over_rectangle(view.depth));
  const double rounding = 1e-12 * (1.0 + std::abs(n.low) + std::abs(n.high));
  return {n.low - rounding, n.high + rounding, false};
}

void PrismaticSurface::do_grid_bounds(const Pose& X_SP, const RectangleGrid& r, std::span<HeightBounds> out) const {
  const bool one_column = lateral(X_SP.rotation.col(0)).isZero(0.0);
  for (int iy = 0; iy < r.ny; ++iy)
    for (int ix = 0; ix < r.nx; ++ix)
      out[r.index(ix, iy)] = one_column && ix > 0 ? out[r.index(0, iy)] : do_height_bounds(X_SP, r.at(ix, iy));
}

}  // namespace treadmark::spline
