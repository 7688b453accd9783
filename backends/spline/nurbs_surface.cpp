// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs_surface.hpp"

#include <cmath>
#include <limits>

#include "treadmark/backends/spline/nurbs_view.hpp"
#include "treadmark/backends/spline/point_batches.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::spline {
namespace {

// Points of a tile share a view; fixed, so that results do not depend on the number of threads.
constexpr int kTileX = 64, kTileY = 32;

void write(const HeightsOut& out, std::size_t i, bool found, const NurbsHit& hit) {
  if (!out.z.empty()) out.z[i] = found ? hit.z : kNaN;
  if (!out.dzdx.empty()) out.dzdx[i] = found ? hit.dzdx : kNaN;
  if (!out.dzdy.empty()) out.dzdy[i] = found ? hit.dzdy : kNaN;
}

// Calls use(point, found, hit) for all points of a list, in parallel.
template <class Use>
void for_hits(const NurbsNet& net, const Pose& X_SP, Facing facing, std::span<const Vec2> points_P, bool exact,
              bool all, const Use& use) {
  for_listed_points(points_P, true, [&](std::span<const ListedPoint> points) {
    Interval x = Interval::none(), y = Interval::none();
    for (const ListedPoint& p : points) {
      if (!std::isfinite(p.across) || !std::isfinite(p.along)) continue;
      x.include({p.across, p.across});
      y.include({p.along, p.along});
    }
    NurbsView view(net, X_SP, {x.low, x.high, y.low, y.high}, facing);
    NurbsHit hit;
    for (const ListedPoint& p : points) {
      const bool found = view.hit(p.across, p.along, exact, all, hit);
      use(p, found, hit);
    }
  });
}

}  // namespace

SurfaceDerivatives NurbsSurface::derivatives_at(const NurbsNet::Place& place) const {
  const PowerPatch patch(net_.patch(place.iu, place.iv));
  const PowerPatch::Jet at = patch.jet(place.s, place.t);
  const PowerPatch::Bend bend = patch.bend(place.s, place.t);
  // By the parameters themselves.
  const double per_u = 1.0 / (net_.u_break(place.iu + 1) - net_.u_break(place.iu));
  const double per_v = 1.0 / (net_.v_break(place.iv + 1) - net_.v_break(place.iv));
  const auto position = [](const Quad& q) { return Vec3(q.x(), q.y(), q.z()); };
  const double w = at.value.w(), w_u = at.by_s.w() * per_u, w_v = at.by_t.w() * per_v;
  SurfaceDerivatives d;
  d.p = position(at.value) / w;
  d.pu = (position(at.by_s) * per_u - w_u * d.p) / w;
  d.pv = (position(at.by_t) * per_v - w_v * d.p) / w;
  const double uu = per_u * per_u, uv = per_u * per_v, vv = per_v * per_v;
  d.puu = (position(bend.by_ss) * uu - 2.0 * w_u * d.pu - (bend.by_ss.w() * uu) * d.p) / w;
  d.puv = (position(bend.by_st) * uv - w_u * d.pv - w_v * d.pu - (bend.by_st.w() * uv) * d.p) / w;
  d.pvv = (position(bend.by_tt) * vv - 2.0 * w_v * d.pv - (bend.by_tt.w() * vv) * d.p) / w;
  return d;
}

SurfaceDerivatives NurbsSurface::derivatives(double u, double v) const { return derivatives_at(net_.find(u, v)); }

void NurbsSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const Grid2& g = plane_grid.grid;
  const bool slopes = !out.dzdx.empty() || !out.dzdy.empty();
  const int tiles_x = (g.nx + kTileX - 1) / kTileX, tiles_y = (g.ny + kTileY - 1) / kTileY;
  parallel_for(static_cast<std::size_t>(tiles_x) * static_cast<std::size_t>(tiles_y), [&](std::size_t tile) {
    const int ix0 = kTileX * static_cast<int>(tile % static_cast<std::size_t>(tiles_x)),
              ix1 = std::min(g.nx, ix0 + kTileX) - 1;
    const int iy0 = kTileY * static_cast<int>(tile / static_cast<std::size_t>(tiles_x)),
              iy1 = std::min(g.ny, iy0 + kTileY) - 1;
    NurbsView view(net_, plane_grid.X_SP, {g.x(ix0), g.x(ix1), g.y(iy0), g.y(iy1)}, facing());
    NurbsHit hit;
    for (int iy = iy0; iy <= iy1; ++iy)
      for (int ix = ix0; ix <= ix1; ++ix) {
        const bool found = view.hit(g.x(ix), g.y(iy), slopes, false, hit);
        write(out, g.index(ix, iy), found, hit);
      }
  });
}

void NurbsSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  const bool slopes = !out.dzdx.empty() || !out.dzdy.empty();
  for_hits(net_, X_SP, facing(), points_P, slopes, false,
           [&](const ListedPoint& p, bool found, const NurbsHit& hit) { write(out, p.index, found, hit); });
}

void NurbsSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  for_hits(net_, X_SP, facing(), points_P, true, true, [&](const ListedPoint& p, bool found, const NurbsHit& hit) {
    SurfacePoint& at = out[p.index];
    at = {};
    if (!found) return;
    at.status = hit.hides_others ? LocateStatus::ambiguous : LocateStatus::converged;
    SurfaceDerivatives d = derivatives_at({hit.iu, hit.iv, hit.s, hit.t});
    const bool wheel = body_ == Body::wheel;
    at.u = wheel ? wrap_angle(std::atan2(d.p.x(), d.p.z())) : d.p.x();
    const double low = net_.v_break(hit.iv), high = net_.v_break(hit.iv + 1);
    at.v = low + (hit.t + 0.5) * (high - low);
    // Forward x towards greater y points out of a wheel, into a rail.
    if (wheel) d.pv = -d.pv, d.puv = -d.puv;
    set_geometry(d, at);
  });
}

HeightBounds NurbsSurface::do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const {
  const Interval z = hull_.heights_over(X_SP, rectangle_P, facing());
  if (z.empty()) return {0.0, 0.0, true};
  return {z.low, z.high, false};
}

}  // namespace treadmark::spline
