// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_view.hpp"
#include "treadmark/backends/spline/point_batches.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/surface_change.hpp"

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
  const NurbsNet::Range range = net_.range(place.iu, place.iv);
  const double per_u = 1.0 / (range.u1 - range.u0), per_v = 1.0 / (range.v1 - range.v0);
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

Vec3 NurbsSurface::direction_of(std::size_t parameter) const {
  if (body_ == Body::rail) return Vec3::UnitZ();
  const Vec3 p = net_.number_place(parameter);
  return Vec3(p.x(), 0.0, p.z()).normalized();
}

std::vector<ShapeParameter> NurbsSurface::parameters() const {
  constexpr double kWidth = 0.5e-3;  // [m] of patches, or less
  const bool wheel = body_ == Body::wheel;
  std::vector<ShapeParameter> all(net_.numbers());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Vec3 place = net_.number_place(k);
    all[k] = {"control_" + std::to_string(k), "m", step_over(kWidth), place};
    if (!net_.by_corners()) continue;
    struct Kind {
      const char *ending, *unit;
      double per;  ///< of a length of the surface
    };
    const double per_u = wheel ? std::hypot(place.x(), place.z()) / kWidth : 1.0 / kWidth, per_v = 1.0 / kWidth;
    const Kind kinds[] = {{"", "m", 1.0},
                          {"_u", wheel ? "m/rad" : "1", per_u},
                          {"_v", "1", per_v},
                          {"_uv", wheel ? "1/rad" : "1/m", per_u * per_v}};
    const Kind& kind = kinds[k % 4];
    all[k].name = "corner_" + std::to_string(k / 4) + kind.ending;
    all[k].unit = kind.unit, all[k].step *= kind.per;
  }
  return all;
}

std::shared_ptr<const Surface> NurbsSurface::do_change(std::size_t parameter, double amount) const {
  return std::make_shared<NurbsSurface>(net_.with_number(parameter, amount * direction_of(parameter)), body_, backend_);
}

std::optional<HeightsBy> NurbsSurface::do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                                    std::span<const double> weights, std::span<double> by) const {
  struct Found {
    bool found = false;
    NurbsNet::Place place{};
  };
  std::vector<Found> hits(points_P.size());
  for_hits(net_, X_SP, facing(), points_P, true, false, [&](const ListedPoint& p, bool found, const NurbsHit& hit) {
    hits[p.index] = {found, {hit.iu, hit.iv, hit.s, hit.t}};
  });
  const Vec3 up = X_SP.rotation.col(2);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].found) continue;
    const SurfaceDerivatives d = derivatives_at(hits[i].place);
    const Vec3 normal = d.pu.cross(d.pv), force = weights[i] / up.dot(normal) * normal;
    net_.each_number(hits[i].place, [&](std::size_t k, double share) { by[k] += share * force.dot(direction_of(k)); });
  }
  return HeightsBy::exact;
}

void NurbsSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const Grid2& g = plane_grid.grid;
  const bool slopes = !out.dzdx.empty() || !out.dzdy.empty();
  // The kernels write heights, and slopes both or none.
  std::vector<double> unasked_z(out.z.empty() ? g.size() : 0), unasked_dx(slopes && out.dzdx.empty() ? g.size() : 0),
      unasked_dy(slopes && out.dzdy.empty() ? g.size() : 0);
  double* const z = out.z.empty() ? unasked_z.data() : out.z.data();
  double* const dx = !slopes ? nullptr : out.dzdx.empty() ? unasked_dx.data() : out.dzdx.data();
  double* const dy = !slopes ? nullptr : out.dzdy.empty() ? unasked_dy.data() : out.dzdy.data();
  for (double* const field : {z, dx, dy})
    if (field != nullptr) std::fill_n(field, g.size(), kNaN);

  const FacingHalf half(plane_grid.X_SP, facing());
  const ViewArrays view = view_arrays(plane_grid.X_SP, half);
  const int tiles_x = (g.nx + kTileX - 1) / kTileX, tiles_y = (g.ny + kTileY - 1) / kTileY;
  parallel_for(static_cast<std::size_t>(tiles_x) * static_cast<std::size_t>(tiles_y), [&](std::size_t tile) {
    const int ix0 = kTileX * static_cast<int>(tile % static_cast<std::size_t>(tiles_x)),
              iy0 = kTileY * static_cast<int>(tile / static_cast<std::size_t>(tiles_x));
    const int nx = std::min(kTileX, g.nx - ix0), ny = std::min(kTileY, g.ny - iy0);
    const auto from = [&](double* field) { return field == nullptr ? nullptr : field + g.index(ix0, iy0); };
    hit_tile(plane_grid.X_SP, half, view,
             {g.x0, g.y0, g.dx, g.dy, ix0, iy0, nx, ny, static_cast<long>(g.nx), from(z), from(dx), from(dy)});
  });
}

void NurbsSurface::hit_tile(const Pose& X_SP, const FacingHalf& half, const ViewArrays& view,
                            const TileArrays& tile) const {
  constexpr std::size_t kBatch = 64;
  const auto& kernels = fastest_kernel<NurbsKernel>();
  const Rectangle over{tile.x0 + tile.ix0 * tile.dx, tile.x0 + (tile.ix0 + tile.nx - 1) * tile.dx,
                       tile.y0 + tile.iy0 * tile.dy, tile.y0 + (tile.iy0 + tile.ny - 1) * tile.dy};
  std::vector<PatchIndex> left;
  std::array<PatchIndex, kBatch> batch;
  std::array<PatchCorners, kBatch> corners;
  std::array<char, kBatch> not_settled;
  std::size_t count = 0;
  const auto flush = [&] {
    kernels.hit_corners(view, corners.data(), static_cast<int>(count), tile, not_settled.data());
    for (std::size_t k = 0; k < count; ++k)
      if (not_settled[k] != 0) left.push_back(batch[k]);
    count = 0;
  };
  for_patches_over(net_, X_SP, over, half, [&](int iu, int iv, const Vec3&, const Vec3&) {
    if (!net_.by_corners()) return left.push_back({iu, iv});
    batch[count] = {iu, iv};
    corners[count] = net_.corners(iu, iv);
    if (++count == kBatch) flush();
  });
  flush();
  if (!left.empty()) NurbsView(net_, X_SP, over, facing(), left).hit_tile(view, tile);
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
    const NurbsNet::Range range = net_.range(hit.iu, hit.iv);
    at.v = range.v0 + (hit.t + 0.5) * (range.v1 - range.v0);
    // Forward x towards greater y points out of a wheel, into a rail.
    if (wheel) d.pv = -d.pv, d.puv = -d.puv;
    set_geometry(d, at);
  });
}

namespace {

/// The u that located points have, x of a rail or the angle of a wheel, by the surface's own parameters.
struct Station {
  double value, by_u, by_v, by_uu, by_uv, by_vv;
};

Station station_at(const SurfaceDerivatives& d, bool wheel) {
  if (!wheel) return {d.p.x(), d.pu.x(), d.pv.x(), d.puu.x(), d.puv.x(), d.pvv.x()};
  const double x = d.p.x(), z = d.p.z(), r2 = x * x + z * z;
  const auto first = [&](const Vec3& a) { return (z * a.x() - x * a.z()) / r2; };
  const auto second = [&](const Vec3& a, const Vec3& b, const Vec3& ab) {
    return (b.z() * a.x() - b.x() * a.z() + z * ab.x() - x * ab.z()) / r2 -
           first(a) * 2.0 * (x * b.x() + z * b.z()) / r2;
  };
  return {std::atan2(x, z),         first(d.pu), first(d.pv), second(d.pu, d.pu, d.puu), second(d.pu, d.pv, d.puv),
          second(d.pv, d.pv, d.pvv)};
}

/// By (station, v) instead of (u, v).
SurfaceJet by_station(const SurfaceDerivatives& d, const Station& g, double outward) {
  const double u_g = 1.0 / g.by_u, u_v = -g.by_v * u_g;
  const double u_gg = -g.by_uu * u_g * u_g * u_g, u_gv = -(g.by_uu * u_v + g.by_uv) * u_g * u_g,
               u_vv = -(g.by_uu * u_v * u_v + 2.0 * g.by_uv * u_v + g.by_vv) * u_g;
  return {d.p,
          d.pu * u_g,
          d.pv + d.pu * u_v,
          d.puu * (u_g * u_g) + d.pu * u_gg,
          d.puu * (u_g * u_v) + d.puv * u_g + d.pu * u_gv,
          d.pvv + 2.0 * u_v * d.puv + (u_v * u_v) * d.puu + d.pu * u_vv,
          outward};
}

}  // namespace

void NurbsSurface::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  constexpr int kMost = 20;
  constexpr double kSettled = 1e-14;  // [m] or [rad]
  constexpr double kAtEnd = 1e-12;    // by which a place may lie beyond the borders
  const bool wheel = body_ == Body::wheel;
  const NurbsNet::Range all = net_.range();
  for (std::size_t i = 0; i < uv.size(); ++i) {
    out[i] = {};
    const double v = uv[i].y();
    if (!std::isfinite(uv[i].x()) || !(v >= all.v0 - kAtEnd && v <= all.v1 + kAtEnd)) continue;
    // the parameter is the station but for a little, of wheels up to whole turns
    const auto into_range = [&](double station) {
      return wheel ? station - 2.0 * kPi * std::floor((station - all.u0 + kAtEnd) / (2.0 * kPi)) : station;
    };
    const double wanted = into_range(uv[i].x());
    double u = wanted;
    for (int k = 0; k < kMost; ++k) {
      const SurfaceDerivatives d = derivatives(u, v);
      const Station g = station_at(d, wheel);
      const double off = wheel ? wrap_angle(wanted - g.value) : wanted - g.value;
      const double next = std::clamp(u + off / g.by_u, all.u0, all.u1);
      const bool there = std::fabs(off) <= kSettled || (next == u && std::fabs(off) <= kAtEnd);
      if (there || k + 1 == kMost) {
        if (std::fabs(off) <= kAtEnd) out[i] = by_station(d, g, wheel ? 1.0 : -1.0);
        break;
      }
      if (next == u) break;
      u = next;
    }
  }
}

HeightBounds NurbsSurface::do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const {
  const Interval z = hull_.heights_over(X_SP, rectangle_P, facing());
  if (z.empty()) return {0.0, 0.0, true};
  return {z.low, z.high, false};
}

namespace {

// Slopes of interpolating cubic splines with given knots.
class SplineSlopes {
 public:
  /// period = 0: not periodic.
  SplineSlopes(std::span<const double> knots, double period)
      : closed_(period > 0.0), size_(static_cast<int>(knots.size())), lu_(size_, closed_ ? 2 : 1), rhs_(knots.size()) {
    for (int i = 0; i < size_; ++i) {
      const bool last = i + 1 == size_;
      if (last && !closed_) break;
      h_.push_back(last ? period - (knots[static_cast<std::size_t>(i)] - knots[0])
                        : knots[static_cast<std::size_t>(i) + 1] - knots[static_cast<std::size_t>(i)]);
    }
    for (int i = 0; i < size_; ++i) {
      if (!closed_ && (i == 0 || i + 1 == size_)) continue;
      const double before = step(i - 1), after = step(i);
      lu_.at(place(i), place(next(i, -1))) += after;
      lu_.at(place(i), place(i)) += 2.0 * (before + after);
      lu_.at(place(i), place(next(i, 1))) += before;
    }
    if (!closed_) {
      lu_.at(0, 0) = step(1);
      lu_.at(0, 1) = step(0) + step(1);
      lu_.at(size_ - 1, size_ - 1) = step(size_ - 3);
      lu_.at(size_ - 1, size_ - 2) = step(size_ - 2) + step(size_ - 3);
    }
    lu_.factor();
  }

  /// values(i) -> value at knot i; set(i, slope).
  template <class Values, class Set>
  void solve(const Values& values, const Set& set) {
    check_cancelled();
    const auto rise = [&](int i) { return (values(next(i, 1)) - values(next(i, 0))) / step(i); };
    for (int i = 0; i < size_; ++i) {
      double& b = rhs_[static_cast<std::size_t>(place(i))];
      if (!closed_ && i == 0)
        b = end(step(0), step(1), rise(0), rise(1));
      else if (!closed_ && i + 1 == size_)
        b = end(step(size_ - 2), step(size_ - 3), rise(size_ - 2), rise(size_ - 3));
      else
        b = 3.0 * (step(i) * rise(i - 1) + step(i - 1) * rise(i));
    }
    lu_.solve(rhs_);
    for (int i = 0; i < size_; ++i) set(i, rhs_[static_cast<std::size_t>(place(i))]);
  }

 private:
  // Not-a-knot: the cubics of the outer two intervals are one.
  static double end(double outer, double inner, double outer_rise, double inner_rise) {
    return ((3.0 * outer + 2.0 * inner) * inner * outer_rise + outer * outer * inner_rise) / (outer + inner);
  }
  int next(int i, int by) const { return closed_ ? (i + by + size_) % size_ : i + by; }
  double step(int i) const { return h_[static_cast<std::size_t>(next(i, 0))]; }
  // A ring folded flat, so that neighbours stay within two places.
  int place(int i) const {
    if (!closed_) return i;
    return 2 * i < size_ ? 2 * i : 2 * (size_ - i) - 1;
  }

  bool closed_;
  int size_;
  std::vector<double> h_;
  BandedLu lu_;
  std::vector<double> rhs_;
};

void require_points(bool good, const char* message, const char* advice = "") {
  if (!good) throw Error(ErrorKind::input_data, message, {}, advice);
}

}  // namespace

void check_points(const sampling::PointGrid& grid) {
  require_points(grid.u.size() >= 4 && grid.y.size() >= 4, "a surface through points needs at least 4 x 4 of them");
  require_points(grid.h.size() == grid.u.size() * grid.y.size(),
                 "a point grid has another number of heights than of points");
  for (const auto* values : {&grid.u, &grid.y}) {
    for (const double x : *values) require_points(std::isfinite(x), "a coordinate of a point grid is not finite");
    for (std::size_t i = 0; i + 1 < values->size(); ++i)
      require_points((*values)[i] < (*values)[i + 1], "the stations and nodes of a point grid must increase");
  }
  require_points(!grid.closed || grid.body == Body::wheel, "only a wheel can be closed");
  require_points(grid.body == Body::rail || grid.u.back() - grid.u.front() < 2.0 * std::numbers::pi * (1.0 + 1e-12),
                 "the stations of a wheel cover more than one turn");
  require_points(!grid.closed || grid.u.back() - grid.u.front() < 2.0 * std::numbers::pi * (1.0 - 1e-9),
                 "the last station of a closed wheel repeats the first");
  for (const double h : grid.h) {
    require_points(!std::isnan(h), "a full-parametric spline surface cannot have gaps",
                   "use another backend, or cut the gaps off");
    require_points(std::isfinite(h), "a coordinate of a point grid is not finite");
    require_points(grid.body == Body::rail || h > 0.0, "a wheel's radius must be positive at all points");
  }
}

std::vector<double> chord_lengths(const sampling::PointGrid& grid) {
  const std::size_t nu = grid.u.size(), nv = grid.y.size();
  std::vector<double> v(nv, 0.0);
  for (std::size_t j = 0; j + 1 < nv; ++j) {
    double chords = 0.0;
    for (std::size_t i = 0; i < nu; ++i) chords += (grid.point(i, j + 1) - grid.point(i, j)).norm();
    v[j + 1] = v[j] + chords / static_cast<double>(nu);
  }
  return v;
}

NurbsNet fit_point_grid(const sampling::PointGrid& grid) {
  check_points(grid);
  const std::size_t nu = grid.u.size(), nv = grid.y.size();
  std::vector<NurbsNet::Corner> corners(nu * nv);
  for (std::size_t i = 0; i < nu; ++i)
    for (std::size_t j = 0; j < nv; ++j) corners[grid.index(i, j)].p = grid.point(i, j);
  std::vector<double> u = grid.u, v = chord_lengths(grid);

  SplineSlopes along_u(u, grid.closed ? 2.0 * std::numbers::pi : 0.0), along_v(v, 0.0);
  using Corner = NurbsNet::Corner;
  const auto by_u = [&](Vec3 Corner::*from, Vec3 Corner::*to) {
    for (std::size_t j = 0; j < nv; ++j)
      for (int k = 0; k < 3; ++k)
        along_u.solve(
            [&](int i) { return (corners[grid.index(static_cast<std::size_t>(i), j)].*from)[k]; },
            [&](int i, double slope) { (corners[grid.index(static_cast<std::size_t>(i), j)].*to)[k] = slope; });
  };
  for (std::size_t i = 0; i < nu; ++i)
    for (int k = 0; k < 3; ++k)
      along_v.solve([&](int j) { return corners[grid.index(i, static_cast<std::size_t>(j))].p[k]; },
                    [&](int j, double slope) { corners[grid.index(i, static_cast<std::size_t>(j))].p_v[k] = slope; });
  by_u(&Corner::p, &Corner::p_u);
  by_u(&Corner::p_v, &Corner::p_uv);
  if (grid.closed) u.push_back(u.front() + 2.0 * std::numbers::pi);
  return NurbsNet(std::move(u), std::move(v), std::move(corners));
}

}  // namespace treadmark::spline
