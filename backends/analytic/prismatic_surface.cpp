// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/prismatic_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>

#include "treadmark/backends/analytic/arc_row.hpp"
#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/recent.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::analytic {

namespace {

/// The plane frame seen in the y-z plane of the rail. A point (x, y) of the plane lies at w = w0 + wx x + wy y and
/// a = a0 + ax x + ay y along the projected normal, whose length is m; the height is t = (h(w) - a)/m.
struct Projection {
  double d_y = 0.0, d_z = 1.0, m = 0.0;
  double w0 = 0.0, wx = 0.0, wy = 0.0, a0 = 0.0, ax = 0.0, ay = 0.0;

  explicit Projection(const Pose& X) {
    const double n_y = X.rotation(1, 2), n_z = X.rotation(2, 2);
    m = std::hypot(n_y, n_z);
    if (degenerate()) return;
    d_y = n_y / m;
    d_z = n_z / m;
    const auto across = [&](double y, double z) { return y * d_z - z * d_y; };
    const auto along = [&](double y, double z) { return y * d_y + z * d_z; };
    w0 = across(X.origin.y(), X.origin.z());
    wx = across(X.rotation(1, 0), X.rotation(2, 0));
    wy = across(X.rotation(1, 1), X.rotation(2, 1));
    a0 = along(X.origin.y(), X.origin.z());
    ax = along(X.rotation(1, 0), X.rotation(2, 0));
    ay = along(X.rotation(1, 1), X.rotation(2, 1));
  }
  /// The normal runs along the rail: it never meets the surface in one point.
  bool degenerate() const { return m < 1e-9; }
};

/// Writes the heights of single points.
class PointWriter {
 public:
  PointWriter(const Projection& projection, const ChainView& view, const HeightsOut& out)
      : p_(projection), view_(view), out_(out), slopes_(!out.dzdx.empty() || !out.dzdy.empty()) {}

 protected:
  /// Entry i for a point at x in the row with w_row and a_row; interval: a guess, and where the point was found.
  void write_point(std::size_t i, double x, double w_row, double a_row, int& interval) const {
    const double w = w_row + p_.wx * x;
    const int found = view_.find(w, interval);
    if (found >= 0) interval = found;
    double h = 0.0, dh = 0.0;
    evaluate(w, found, h, dh);
    if (!out_.z.empty()) out_.z[i] = (h - (a_row + p_.ax * x)) / p_.m;
    if (!out_.dzdx.empty()) out_.dzdx[i] = (dh * p_.wx - p_.ax) / p_.m;
    if (!out_.dzdy.empty()) out_.dzdy[i] = (dh * p_.wy - p_.ay) / p_.m;
  }
  void evaluate(double w, int interval, double& h, double& dh) const {
    if (interval < 0)
      h = dh = kNaN;
    else if (slopes_)
      h = view_.height_and_slope(w, interval, dh);
    else
      h = view_.height(w, interval);
  }

  const Projection& p_;
  const ChainView& view_;
  const HeightsOut& out_;
  bool slopes_;
};

/// A list of points, in parts that may run in parallel.
class ListWriter : PointWriter {
 public:
  using PointWriter::PointWriter;

  void write(std::span<const Vec2> points, std::size_t begin, std::size_t end) const {
    int interval = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double y = points[i].y();
      write_point(i, points[i].x(), p_.w0 + p_.wy * y, p_.a0 + p_.ay * y, interval);
    }
  }
};

/// One row of the grid; rows of a plane that is not turned about its normal have one w, hence one height, for all x.
class RowWriter : PointWriter {
 public:
  RowWriter(const Projection& projection, const ChainView& view, const Grid2& grid, const HeightsOut& out)
      : PointWriter(projection, view, out), g_(grid) {
    constexpr double kSameW = 1e-15;  // [m]
    const double spread = std::fabs(p_.wx) * std::max(std::fabs(g_.x(0)), std::fabs(g_.x(g_.nx - 1)));
    one_w_ = spread <= kSameW;
  }

  void write(int iy) const {
    const std::size_t begin = g_.index(0, iy);
    const double y = g_.y(iy), w_row = p_.w0 + p_.wy * y, a_row = p_.a0 + p_.ay * y;
    int interval = 0;
    if (one_w_) {
      double h = 0.0, dh = 0.0;
      interval = view_.find(w_row, interval);
      evaluate(w_row, interval, h, dh);
      if (!out_.z.empty()) {
        const double z0 = (h - a_row) / p_.m, zx = -p_.ax / p_.m;
        double* z = out_.z.data() + begin;
        for (int ix = 0; ix < g_.nx; ++ix) z[ix] = z0 + zx * g_.x(ix);
      }
      const auto n = static_cast<std::size_t>(g_.nx);
      if (!out_.dzdx.empty())
        std::fill_n(out_.dzdx.begin() + static_cast<std::ptrdiff_t>(begin), n, (dh * p_.wx - p_.ax) / p_.m);
      if (!out_.dzdy.empty())
        std::fill_n(out_.dzdy.begin() + static_cast<std::ptrdiff_t>(begin), n, (dh * p_.wy - p_.ay) / p_.m);
      return;
    }
    if (out_.z.empty()) {
      for (int ix = 0; ix < g_.nx; ++ix)
        write_point(begin + static_cast<std::size_t>(ix), g_.x(ix), w_row, a_row, interval);
      return;
    }
    for (int ix = 0, last = 0; ix < g_.nx; ix = last + 1) {
      interval = view_.find(w_row + p_.wx * g_.x(ix), std::max(interval, 0));
      last = interval < 0 ? ix : run_end(ix, w_row, interval);
      if (interval < 0)
        write_point(begin + static_cast<std::size_t>(ix), g_.x(ix), w_row, a_row, interval);
      else
        write_run(begin, ix, last, w_row, a_row, interval);
    }
  }

 private:
  /// The last of the points from ix on that one interval holds.
  int run_end(int ix, double w_row, int interval) const {
    const double low = view_.w_min(interval), high = view_.w_max(interval);
    const auto holds = [&](int i) {
      const double w = w_row + p_.wx * g_.x(i);
      return w >= low && w <= high;
    };
    const double steps = (((p_.wx > 0.0 ? high : low) - w_row) / p_.wx - g_.x0) / g_.dx;  // NaN: one point
    int last = std::max(ix, to_whole<int>(steps < g_.nx ? std::max(steps, -1.0) : steps >= g_.nx ? g_.nx - 1 : -1));
    while (last > ix && !holds(last)) --last;
    while (last + 1 < g_.nx && holds(last + 1)) ++last;
    return last;
  }
  void write_run(std::size_t begin, int first, int last, double w_row, double a_row, int interval) const {
    const ArcGraph& arc = view_.arc(interval);
    double* const dx = out_.dzdx.empty() ? nullptr : out_.dzdx.data() + begin;
    double* const dy = out_.dzdy.empty() ? nullptr : out_.dzdy.data() + begin;
    double* const slope = dx != nullptr ? dx : dy;
    kernel_.heights({arc.x0, arc.h0, arc.s0, arc.c0, arc.k, w_row, p_.wx, a_row, p_.ax, 1.0 / p_.m, g_.x0, g_.dx},
                    first, last + 1, out_.z.data() + begin, slope);
    for (int ix = first; slope != nullptr && ix <= last; ++ix) {
      const double dh = slope[ix];
      if (dx != nullptr) dx[ix] = (dh * p_.wx - p_.ax) / p_.m;
      if (dy != nullptr) dy[ix] = (dh * p_.wy - p_.ay) / p_.m;
    }
  }

  const Grid2& g_;
  const ArcRowKernel& kernel_ = fastest_kernel<ArcRowKernel>();
  bool one_w_ = false;
};

}  // namespace

PrismaticSurface::PrismaticSurface(const ArcChain& chain)
    : chain_(resolve(chain)), chords_(chords_of(chain_)), id_(owner_number()) {
  angle_min_ = std::numeric_limits<double>::infinity();
  angle_max_ = -angle_min_;
  for (const ChainSegment& seg : chain_)
    for (const double angle : {seg.angle, seg.angle + seg.curvature * seg.length}) {
      angle_min_ = std::min(angle_min_, angle);
      angle_max_ = std::max(angle_max_, angle);
    }
}

namespace {

/// A place of a chain: a segment, and how far along it.
struct ChainPlace {
  std::size_t segment = 0;
  double along = 0.0;
};

/// Where it is least inclined.
ChainPlace crown_of(const std::vector<ChainSegment>& chain) {
  ChainPlace crown;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const ChainSegment& s = chain[k];
    const double level = s.curvature == 0.0 ? 0.0 : std::clamp(-s.angle / s.curvature, 0.0, s.length);
    for (const double along : {level, s.length})
      if (const double lean = std::fabs(s.angle + s.curvature * along); lean < least) least = lean, crown = {k, along};
  }
  return crown;
}

}  // namespace

std::vector<ShapeParameter> PrismaticSurface::parameters() const {
  constexpr double kFar = 5e-8;  // [m] by which the ends move
  const double total = chain_.back().s + chain_.back().length;
  std::vector<ShapeParameter> all;
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const ChainSegment& s = chain_[k];
    const ChainPoint middle = point_on(s, 0.5 * s.length);
    const std::string name = "segment_" + std::to_string(k);
    const Vec3 place(0.0, middle.y, middle.z);
    all.push_back({name + "_curvature", "1/m", kFar / (s.length * total), place});
    all.push_back({name + "_length", "m", kFar, place});
  }
  return all;
}

std::shared_ptr<const Surface> PrismaticSurface::do_change(std::size_t parameter, double amount) const {
  ArcChain chain{chain_.front().y, chain_.front().z, chain_.front().angle, {}};
  for (const ChainSegment& s : chain_) chain.segments.push_back({s.length, s.curvature});
  ArcChain::Segment& changed = chain.segments[parameter / 2];
  (parameter % 2 == 0 ? changed.curvature : changed.length) += amount;
  const ChainPlace crown = crown_of(chain_);
  const ChainPoint is = point_on(resolve(chain)[crown.segment], crown.along),
                   was = point_on(chain_[crown.segment], crown.along);
  const double turn = was.angle - is.angle, c = std::cos(turn), s = std::sin(turn);
  const double y = chain.start_y - is.y, z = chain.start_z - is.z;
  chain.start_y = was.y + c * y - s * z, chain.start_z = was.z + s * y + c * z;
  chain.start_angle += turn;
  return std::make_shared<PrismaticSurface>(chain);
}

std::shared_ptr<const ChainView> PrismaticSurface::view(double d_y, double d_z) const {
  thread_local Recent<std::tuple<std::uint64_t, double, double>, ChainView> views;
  return views.of({id_, d_y, d_z}, [&] { return std::make_shared<const ChainView>(chain_, d_y, d_z); });
}

bool PrismaticSurface::graph(double d_y, double d_z) const {
  constexpr double kUpright = 0.5 * std::numbers::pi - 1e-9;
  const double turn = std::atan2(d_y, d_z);
  return angle_min_ + turn > -kUpright && angle_max_ + turn < kUpright;
}

Box3 PrismaticSurface::bounds() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low[2] = {kInfinity, kInfinity}, high[2] = {-kInfinity, -kInfinity};
  const auto include = [&](const ChainPoint& p) {
    low[0] = std::min(low[0], p.y), high[0] = std::max(high[0], p.y);
    low[1] = std::min(low[1], p.z), high[1] = std::max(high[1], p.z);
  };
  for (const ChainSegment& seg : chain_) {
    include(point_on(seg, 0.0));
    include(point_on(seg, seg.length));
    if (seg.curvature == 0.0) continue;
    // extremes of y and z lie where the inclination is a multiple of 90 degrees
    const double quarter = std::acos(0.0), a = seg.angle, b = a + seg.curvature * seg.length;
    // a turn has all of them
    double q = std::ceil(std::min(a, b) / quarter);
    for (int left = 4; left >= 0 && q * quarter <= std::max(a, b); --left, q += 1.0)
      include(point_on(seg, std::clamp((q * quarter - a) / seg.curvature, 0.0, seg.length)));
  }
  return {{-kInfinity, low[0], low[1]}, {kInfinity, high[0], high[1]}};
}

void PrismaticSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const Projection projection(plane_grid.X_SP);
  const Grid2& g = plane_grid.grid;
  if (projection.degenerate()) {
    for (const auto array : {out.z, out.dzdx, out.dzdy}) std::fill(array.begin(), array.end(), kNaN);
    return;
  }
  const auto shared = this->view(projection.d_y, projection.d_z);
  const ChainView& view = *shared;
  const RowWriter rows(projection, view, g, out);
  constexpr std::size_t kWorthThreads = 50'000;
  if (g.size() < kWorthThreads)
    for (int iy = 0; iy < g.ny; ++iy) rows.write(iy);
  else
    parallel_for(static_cast<std::size_t>(g.ny), [&](std::size_t iy) { rows.write(static_cast<int>(iy)); });
}

void PrismaticSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  const Projection projection(X_SP);
  if (projection.degenerate()) {
    for (const auto array : {out.z, out.dzdx, out.dzdy}) std::fill(array.begin(), array.end(), kNaN);
    return;
  }
  const auto shared = this->view(projection.d_y, projection.d_z);
  const ChainView& view = *shared;
  const ListWriter list(projection, view, out);
  constexpr std::size_t kPointsPerTask = 20'000;
  parallel_for((points_P.size() + kPointsPerTask - 1) / kPointsPerTask, [&](std::size_t task) {
    list.write(points_P, task * kPointsPerTask, std::min(points_P.size(), (task + 1) * kPointsPerTask));
  });
}

void PrismaticSurface::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double u = uv[i].x(), v = uv[i].y();
    out[i] = {};
    const ChainSegment& last = chain_.back();
    if (!std::isfinite(u) || !(v >= chain_.front().s && v <= last.s + last.length)) continue;
    const auto after = std::upper_bound(chain_.begin() + 1, chain_.end(), v,
                                        [](double at, const ChainSegment& s) { return at < s.s; });
    const ChainSegment& segment = *(after - 1);
    const ChainPoint q = point_on(segment, std::min(v - segment.s, segment.length));
    const double sine = std::sin(q.angle), cosine = std::cos(q.angle);
    out[i] = {{u, q.y, q.z}, Vec3::UnitX(), {0.0, cosine, sine},
              Vec3::Zero(),  Vec3::Zero(),  segment.curvature * Vec3(0.0, -sine, cosine),
              -1.0};
  }
}

void PrismaticSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  const Projection p(X_SP);
  std::fill(out.begin(), out.end(), SurfacePoint{});
  if (p.degenerate()) return;
  const auto shared = this->view(p.d_y, p.d_z);
  const ChainView& view = *shared;
  int interval = 0;
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    const double x = points_P[i].x(), y = points_P[i].y();
    const double w = p.w0 + p.wx * x + p.wy * y;
    const int found = view.find(w, interval);
    if (found < 0) continue;
    interval = found;
    const ChainView::Hit hit = view.hit(w, found);
    const ChainSegment& seg = chain_[static_cast<std::size_t>(hit.segment)];
    const ChainPoint q = point_on(seg, hit.distance);
    const double t = (view.height(w, found) - (p.a0 + p.ax * x + p.ay * y)) / p.m;
    SurfacePoint& o = out[i];
    o.status = hit.hides_others ? LocateStatus::ambiguous : LocateStatus::converged;
    o.position_S = X_SP.apply({x, y, t});
    o.u = o.position_S.x();
    o.v = seg.s + hit.distance;
    o.normal_S = {0.0, std::sin(q.angle), -std::cos(q.angle)};
    o.curvature_1 = std::max(seg.curvature, 0.0);
    o.curvature_2 = std::min(seg.curvature, 0.0);
  }
}

HeightBounds PrismaticSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const Projection p(X_SP);
  if (p.degenerate()) return {0.0, 0.0, true};
  const double hx = 0.5 * (r.x_max - r.x_min), hy = 0.5 * (r.y_max - r.y_min), xm = r.x_min + hx, ym = r.y_min + hy;
  constexpr double kRounding = 1e-12;  // [m]
  const double w = p.w0 + p.wx * xm + p.wy * ym, w_half = std::fabs(p.wx) * hx + std::fabs(p.wy) * hy + kRounding;
  const double a = p.a0 + p.ax * xm + p.ay * ym, a_half = std::fabs(p.ax) * hx + std::fabs(p.ay) * hy + kRounding;
  const auto bounds = [&](double low, double high) {
    return HeightBounds{(low - a - a_half) / p.m, (high - a + a_half) / p.m, false};
  };
  if (!graph(p.d_y, p.d_z)) {
    const auto range = view(p.d_y, p.d_z)->range(w - w_half, w + w_half);
    return range ? bounds(range->first, range->second) : HeightBounds{0.0, 0.0, true};
  }
  const TurnedChain turned(p.d_y, p.d_z);
  const double coarse = 1e-6 + 0.02 * (hx + hy);
  const double least = turned.least(chords_, w - w_half, w + w_half, coarse);
  if (!std::isfinite(least)) return {0.0, 0.0, true};
  return bounds(least, turned.greatest(chords_, w - w_half, w + w_half, coarse));
}

}  // namespace treadmark::analytic
