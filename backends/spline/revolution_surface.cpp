// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/revolution_surface.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/backends/spline/grid_lines.hpp"
#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/node_change.hpp"
#include "treadmark/backends/spline/point_batches.hpp"
#include "treadmark/backends/spline/profile_tree.hpp"
#include "treadmark/backends/spline/surface_derivatives.hpp"
#include "treadmark/backends/spline/wheel_view.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/surface_change.hpp"

namespace treadmark::spline {
namespace {

constexpr std::size_t kRevolutionLinesPerTask = 16;

// The wheel cut at one value of the across coordinate.
class RevolutionSection {
 public:
  static constexpr double kStep = 1e-8, kStepU = 1e-8, kFine = 1e-15;

  RevolutionSection(const ProfileSpline& profile, const WheelView& view, double across)
      : breaks_(profile.breaks()), cells_(profile.segments()) {
    a0_ = (across + view.across_origin) / view.across_e, ay_ = -view.across_y / view.across_e;
    s0_ = view.along_e * a0_ - view.along_origin, sy_ = view.along_e * ay_ + view.along_y, sb_ = view.along_f;
    n0_ = view.normal_e * a0_ - view.normal_origin, ny_ = view.normal_e * ay_ + view.normal_y, nb_ = view.normal_f;
  }

  SectionPoint point(int cell, double v, double) const {
    const CubicSegment& c = cells_[static_cast<std::size_t>(cell)];
    const double t = v - breaks_[static_cast<std::size_t>(cell)];
    const double y = c.y[0] + t * (c.y[1] + t * (c.y[2] + t * c.y[3]));
    const double r = c.z[0] + t * (c.z[1] + t * (c.z[2] + t * c.z[3]));
    const double dy = c.y[1] + t * (2.0 * c.y[2] + 3.0 * t * c.y[3]);
    const double dr = c.z[1] + t * (2.0 * c.z[2] + 3.0 * t * c.z[3]);
    const double a = a0_ + ay_ * y;
    const double b = std::sqrt(r * r - a * a);
    const double db = (r * dr - a * ay_ * dy) / b;
    return {s0_ + sy_ * y + sb_ * b, n0_ + ny_ * y + nb_ * b, sy_ * dy + sb_ * db, ny_ * dy + nb_ * db};
  }

  /// The ends of a cell, to be used for many points.
  struct Ends {
    int cell;
    double va, vb;
    SectionPoint a, b;
  };
  Ends ends(int cell) const {
    const double a = breaks_[static_cast<std::size_t>(cell)], b = breaks_[static_cast<std::size_t>(cell) + 1];
    return {cell, a, b, point(cell, a, 0.0), point(cell, b, 0.0)};
  }

  /// Position across and towards the plane, for the angle about the axle.
  Vec2 a_b(double y, double r) const {
    const double a = a0_ + ay_ * y;
    return {a, std::sqrt(r * r - a * a)};
  }

  // Breaks may be far apart, and evaluation is cheap.
  static bool near_cubic(int, const SectionPoint&, const SectionPoint&) { return false; }

  /// cells: those to look at, increasing.
  void raster(const std::vector<int>& cells, const Samples& samples, ColumnHits& hits) const {
    SectionRaster<RevolutionSection, ColumnHits> raster(*this, samples, hits, hits.queue);
    for (const int k : cells) add(ends(k), raster);
    raster.finish();
  }
  void raster(const std::vector<Ends>& cells, const Samples& samples, ColumnHits& hits) const {
    SectionRaster<RevolutionSection, ColumnHits> raster(*this, samples, hits, hits.queue);
    for (const Ends& cell : cells) add(cell, raster);
    raster.finish();
  }

 private:
  static void add(const Ends& e, SectionRaster<RevolutionSection, ColumnHits>& raster) {
    raster.cell(e.cell, e.va, e.a, e.vb, e.b);
  }

  std::span<const double> breaks_;
  std::span<const CubicSegment> cells_;
  double a0_, ay_, s0_, sy_, sb_, n0_, ny_, nb_;
};

ProfileSpline add_radius(const ProfileSpline& profile, double nominal_radius) {
  std::vector<CubicSegment> cells(profile.segments().begin(), profile.segments().end());
  for (CubicSegment& cell : cells) cell.z[0] += nominal_radius;
  return ProfileSpline({profile.breaks().begin(), profile.breaks().end()}, std::move(cells),
                       {profile.kinks().begin(), profile.kinks().end()});
}

// What a rectangle sees of the wheel; a little widened for rounding and the slack at edges.
class ProfileWindow {
 public:
  ProfileWindow(const PlaneWindow& window) : window_(window), small_(2.0 * window.along.width() + 1e-5) {}

  Interval heights(const Range& y, const Range& r) const { return window_.heights(y, r); }
  bool small(const Range& y, const Range& r) const { return 2.0 * window_.along_of(y, r).half <= small_; }

 private:
  WheelWindow window_;
  double small_;
};
// Segments that may lie over a rectangle.
void cells_over(const ProfileSpline& profile, const ProfileHulls& hulls, const PlaneWindow& plane,
                std::vector<int>& cells) {
  const ProfileWindow window(plane);
  segments_over(ProfileTree(window, profile, hulls), cells);
}

// Slopes along and across the grid lines at a hit.
Vec2 slopes_at(const ProfileSpline& profile, const RevolutionSection& section, const WheelView& view, double v,
               const Vec3& along, const Vec3& across, const Vec3& plane_normal) {
  const Vec2 p = profile.position(v), d = profile.derivative(v);
  // Normal of the surface: forward x tangent, with the angle expressed by (a, b).
  const Vec2 ab = section.a_b(p.x(), p.y());
  const Vec3 outward = (ab.x() * view.e + ab.y() * view.f) / p.y();
  const Vec3 normal = d.x() * outward - d.y() * Vec3(0.0, 1.0, 0.0);
  const double upright = normal.dot(plane_normal);
  return {-normal.dot(along) / upright, -normal.dot(across) / upright};
}

SurfaceDerivatives derivatives(const ProfileSpline& profile, double u, double v) {
  const Vec2 p = profile.position(v), d = profile.derivative(v), dd = profile.second_derivative(v);
  const double sine = std::sin(u), cosine = std::cos(u);
  const Vec3 outward(sine, 0.0, cosine), forward(cosine, 0.0, -sine), axle(0.0, 1.0, 0.0);
  return {p.y() * outward + p.x() * axle,
          p.y() * forward,
          d.y() * outward + d.x() * axle,
          -p.y() * outward,
          d.y() * forward,
          dd.y() * outward + dd.x() * axle};
}

}  // namespace

RevolutionSurface::RevolutionSurface(ProfileSpline profile, double nominal_radius)
    : profile_(add_radius(profile, nominal_radius)), nominal_radius_(nominal_radius), hulls_(profile_) {
  for (const HullBox& box : hulls_.levels().front()) {
    if (!(box.range_w().low > 0.0))
      throw Error(ErrorKind::configuration, "a wheel's radius must be positive over its whole profile", {},
                  "check the nominal radius and the unit of the profile");
  }
}

Vec3 RevolutionSurface::point(double u, double v) const {
  const Vec2 p = profile_.position(v);
  return {p.y() * std::sin(u), p.x(), p.y() * std::cos(u)};
}

Box3 RevolutionSurface::bounds() const {
  Interval y = Interval::none(), r = Interval::none();
  for (const HullBox& box : hulls_.levels().back()) {
    y.include(box.range_y());
    r.include(box.range_w());
  }
  return {{-r.high, y.low, -r.high}, {r.high, y.high, r.high}};
}

std::size_t RevolutionSurface::memory_bytes() const {
  return sizeof(*this) + profile_.breaks().size_bytes() + profile_.segments().size_bytes() + hulls_.memory_bytes();
}

std::vector<ShapeParameter> RevolutionSurface::parameters() const { return node_parameters(profile_); }

std::shared_ptr<const Surface> RevolutionSurface::do_change(std::size_t parameter, double amount) const {
  const ProfileSpline changed = with_node(profile_, parameter, amount);
  return std::make_shared<RevolutionSurface>(add_radius(changed, -nominal_radius_), nominal_radius_);
}

bool RevolutionSurface::do_heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const {
  const ProfileSpline change = node_change(profile_, parameter);
  heights_by_displacement(*this, plane_grid, by, [&](const SurfacePoint& at) -> Vec3 {
    return change.position(at.v).y() * Vec3(std::sin(at.u), 0.0, std::cos(at.u));
  });
  return true;
}

std::optional<HeightsBy> RevolutionSurface::do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                                         std::span<const double> weights, std::span<double> by) const {
  std::vector<double> v, pulling;
  pull_back_by_displacement(
      *this, X_SP, points_P, weights, [&](std::size_t, const SurfacePoint& at, const Vec3& force) {
        v.push_back(at.v), pulling.push_back(std::sin(at.u) * force.x() + std::cos(at.u) * force.z());
      });
  pull_back_to_nodes(profile_, v, pulling, by);
  return HeightsBy::exact;
}

void RevolutionSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const GridLines g(plane_grid, wheel_lines_along_y(plane_grid.X_SP.rotation));
  const WheelView view(g.across, g.along, g.normal, g.origin);
  const auto dz_along = g.along_is_y ? out.dzdy : out.dzdx, dz_across = g.along_is_y ? out.dzdx : out.dzdy;
  const bool slopes = !dz_along.empty() || !dz_across.empty();
  const std::size_t tasks = (static_cast<std::size_t>(g.lines) + kRevolutionLinesPerTask - 1) / kRevolutionLinesPerTask;
  parallel_for(tasks, [&](std::size_t task) {
    ColumnHits hits(g.samples.count, Facing::down);
    const int first = static_cast<int>(task * kRevolutionLinesPerTask);
    const int last = std::min(g.lines, first + static_cast<int>(kRevolutionLinesPerTask)) - 1;
    std::vector<int> cells;
    cells_over(profile_, hulls_,
               {g.across, g.along, g.normal, g.origin, widened(g.across_at(first), g.across_at(last)),
                widened(g.samples.first, g.samples.last())},
               cells);
    for (int line = first; line <= last; ++line) {
      hits.clear();
      const RevolutionSection section(profile_, view, g.across_at(line));
      section.raster(cells, g.samples, hits);
      const std::size_t start = static_cast<std::size_t>(line) * g.across_stride;
      if (!out.z.empty())
        for (std::size_t i = 0; i < hits.n.size(); ++i) out.z[start + i * g.along_stride] = hits.n[i];
      if (!slopes) continue;
      for (std::size_t i = 0; i < hits.n.size(); ++i) {
        Vec2 slope(hits.n[i], hits.n[i]);  // NaN stays
        if (!std::isnan(hits.n[i])) slope = slopes_at(profile_, section, view, hits.v[i], g.along, g.across, g.normal);
        if (!dz_along.empty()) dz_along[start + i * g.along_stride] = slope.x();
        if (!dz_across.empty()) dz_across[start + i * g.along_stride] = slope.y();
      }
    }
  });
}

void RevolutionSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  const bool along_y = wheel_lines_along_y(X_SP.rotation);
  const Vec3 across = X_SP.rotation.col(along_y ? 0 : 1), along = X_SP.rotation.col(along_y ? 1 : 0),
             normal = X_SP.rotation.col(2);
  const WheelView view(across, along, normal, X_SP.origin);
  const auto dz_along = along_y ? out.dzdy : out.dzdx, dz_across = along_y ? out.dzdx : out.dzdy;
  const bool slopes = !dz_along.empty() || !dz_across.empty();
  const auto over = [&](const Interval& a, const Interval& s) {
    std::vector<int> cells;
    cells_over(profile_, hulls_, {across, along, normal, X_SP.origin, widened(a.low, a.high), widened(s.low, s.high)},
               cells);
    return cells;
  };
  const auto count = [](const std::vector<int>& cells) { return cells.size(); };
  for_listed_points(points_P, along_y, [&](std::span<const ListedPoint> points) {
    ColumnHits hits(1, Facing::down);
    std::vector<RevolutionSection::Ends> ends;
    const auto do_batch = [&](std::span<const ListedPoint> batch, const std::vector<int>& cells) {
      for_lines(batch, [&](ListedLine line) {
        const RevolutionSection section(profile_, view, line.front().across);
        ends.clear();
        for (const int k : cells) ends.push_back(section.ends(k));
        for (const ListedPoint& p : line) {
          hits.clear();
          section.raster(ends, one_sample(p.along), hits);
          if (!out.z.empty()) out.z[p.index] = hits.n[0];
          if (!slopes) continue;
          Vec2 slope(hits.n[0], hits.n[0]);  // NaN stays
          if (!std::isnan(hits.n[0])) slope = slopes_at(profile_, section, view, hits.v[0], along, across, normal);
          if (!dz_along.empty()) dz_along[p.index] = slope.x();
          if (!dz_across.empty()) dz_across[p.index] = slope.y();
        }
      });
    };
    for (std::size_t first = 0; first < points.size(); first += kPointsPerBatch)
      split_batch(points.subspan(first, std::min(kPointsPerBatch, points.size() - first)), over, count, do_batch);
  });
}

void RevolutionSurface::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double u = uv[i].x(), v = uv[i].y();
    const bool inside = std::isfinite(u) && v >= profile_.begin() && v <= profile_.end();
    out[i] = inside ? jet_of(derivatives(profile_, u, v)) : SurfaceJet{};
  }
}

void RevolutionSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  const bool along_y = wheel_lines_along_y(X_SP.rotation);
  const Vec3 across = X_SP.rotation.col(along_y ? 0 : 1), along = X_SP.rotation.col(along_y ? 1 : 0),
             normal = X_SP.rotation.col(2);
  const WheelView view(across, along, normal, X_SP.origin);
  ColumnHits hits(1, Facing::down);
  std::vector<int> cells;
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    out[i] = {};
    hits.clear();
    const double a = points_P[i][along_y ? 0 : 1], s = points_P[i][along_y ? 1 : 0];
    const RevolutionSection section(profile_, view, a);
    cells_over(profile_, hulls_, {across, along, normal, X_SP.origin, widened(a, a), widened(s, s)}, cells);
    section.raster(cells, {s, 1.0, 1}, hits);
    if (std::isnan(hits.n[0])) continue;
    out[i].status = hits.several[0] ? LocateStatus::ambiguous : LocateStatus::converged;
    const double v = hits.v[0];
    const Vec2 p = profile_.position(v);
    const Vec2 ab = section.a_b(p.x(), p.y());
    out[i].u = view.angle(ab.x(), ab.y());
    out[i].v = v;
    set_geometry(derivatives(profile_, out[i].u, v), out[i]);
  }
}

HeightBounds RevolutionSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const bool along_y = wheel_lines_along_y(X_SP.rotation);
  const Interval x = widened(r.x_min, r.x_max), y = widened(r.y_min, r.y_max);
  const ProfileWindow window({X_SP.rotation.col(along_y ? 0 : 1), X_SP.rotation.col(along_y ? 1 : 0),
                              X_SP.rotation.col(2), X_SP.origin, along_y ? x : y, along_y ? y : x});
  const ProfileTree tree(window, profile_, hulls_);
  const Interval n = BoundSearch(tree, facing()).range(tree.root());
  if (n.empty()) return {0.0, 0.0, true};
  return {n.low - 1e-12, n.high + 1e-12, false};
}

}  // namespace treadmark::spline
