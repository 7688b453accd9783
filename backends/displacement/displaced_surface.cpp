// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/displaced_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/backends/displacement/base_heights.hpp"
#include "treadmark/backends/displacement/displaced_band.hpp"
#include "treadmark/backends/displacement/displaced_points.hpp"
#include "treadmark/backends/displacement/natural_point.hpp"
#include "treadmark/backends/displacement/reach.hpp"
#include "treadmark/backends/displacement/shape.hpp"
#include "treadmark/backends/displacement/upright_rail.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/core/surface_change.hpp"

namespace treadmark::displacement {

namespace {

/// Ends of the whole surface; fields are not asked about infinities.
constexpr double kFar = 1e30;
/// Grids coarser than this [m], or with fewer points, say too little about the base between their points.
constexpr double kCoarsest = 2.5e-3;
constexpr std::size_t kFewest = 16;

class DisplacedSurface final : public Surface, public Parametric {
 public:
  DisplacedSurface(std::shared_ptr<const Surface> base, std::shared_ptr<const OffsetField> field, Body body,
                   std::string backend)
      : base_(std::move(base)), field_(std::move(field)), body_(body), backend_(std::move(backend)) {
    const Box3 b = base_->bounds();
    const double pi = std::numbers::pi;
    y_min_ = std::max(b.min.y(), -kFar), y_max_ = std::min(b.max.y(), kFar);
    const Rectangle everywhere{body == Body::wheel ? -pi : std::max(b.min.x(), -kFar),
                               body == Body::wheel ? pi : std::min(b.max.x(), kFar), y_min_, y_max_};
    range_ = field_->range(everywhere);
    if (!std::isfinite(range_.low) || !std::isfinite(range_.high))
      throw Error(ErrorKind::configuration, "offsets of a surface must be bounded");
    max_offset_ = greatest(range_);
    rail_low_ = b.min.z(), rail_high_ = b.max.z();
  }

  std::string_view backend() const override { return backend_; }
  Facing facing() const override { return base_->facing(); }
  bool constant_profile() const override { return base_->constant_profile() && field_->constant_along(); }
  bool constant_between(double u_min, double u_max) const override {
    return base_->constant_between(u_min, u_max) &&
           (field_->constant_along() || field_->range({u_min, u_max, y_min_, y_max_}).zero());
  }
  std::vector<double> data_v() const override { return base_->data_v(); }
  std::size_t memory_bytes() const override { return sizeof(*this) + base_->memory_bytes() + field_->memory_bytes(); }
  /// Those of the base, then those of the field, which give way where both have a name.
  std::vector<ShapeParameter> parameters() const override {
    std::vector<ShapeParameter> all = base_->parameters();
    std::set<std::string> taken;
    for (const ShapeParameter& one : all) taken.insert(one.name);
    for (ShapeParameter& one : field_->parameters()) {
      while (taken.contains(one.name)) one.name += "_above";
      all.push_back(std::move(one));
    }
    return all;
  }
  std::size_t parameter_count() const override { return base_->parameter_count() + field_->parameter_count(); }
  Box3 bounds() const override {
    Box3 b = base_->bounds();
    if (body_ == Body::rail) {
      b.min.z() += range_.low, b.max.z() += range_.high;
    } else {
      const double grown = std::max(0.0, range_.high);
      b.min.x() -= grown, b.max.x() += grown, b.min.z() -= grown, b.max.z() += grown;
    }
    return b;
  }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override;
  bool do_heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const override;
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override;
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override;
  bool exact_derivatives() const override { return has_exact_derivatives(*base_); }
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;

  bool rail_heights(const Pose& X_SP, const Rectangle& r, Interval& t) const;
  View view(const Pose& X_SP) const { return {*base_, *field_, body_, X_SP}; }
  /// Whether no offset reaches any height over the rectangle.
  bool undisturbed(const View& view, const Rectangle& r) const {
    const HeightBounds near = base_->height_bounds(view.X_SP, enlarged(r, max_offset_));
    return near.empty ||
           field_->range(view.natural_box(r, {near.z_min - max_offset_, near.z_max + max_offset_})).zero();
  }

  std::shared_ptr<const Surface> base_;
  std::shared_ptr<const OffsetField> field_;
  Body body_;
  std::string backend_;
  OffsetRange range_;
  double max_offset_ = 0.0;
  double y_min_ = 0.0, y_max_ = 0.0;         ///< of the base [m]
  double rail_low_ = 0.0, rail_high_ = 0.0;  ///< of the base [m]
};

/// Arrays for everything: the caller's where there are some.
struct Arrays {
  std::vector<double> own[3];
  std::span<double> z, dzdx, dzdy;
  Arrays(const HeightsOut& out, std::size_t n) {
    const auto take = [&](std::span<double> given, std::vector<double>& spare) {
      if (given.size() == n) return given;
      spare.resize(n);
      return std::span<double>(spare);
    };
    z = take(out.z, own[0]);
    dzdx = take(out.dzdx, own[1]);
    dzdy = take(out.dzdy, own[2]);
  }
  void put(const PlanePoint& p) { z[p.index] = p.z, dzdx[p.index] = p.dzdx, dzdy[p.index] = p.dzdy; }
};

void DisplacedSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const Grid2& g = plane_grid.grid;
  const View seen = view(plane_grid.X_SP);
  const Rectangle whole{g.x(0), g.x(g.nx - 1), g.y(0), g.y(g.ny - 1)};
  if (is_upright_rail(body_, plane_grid.X_SP)) {
    base_->heights(plane_grid, out);
    const UprightRail upright(*field_, plane_grid.X_SP);
    if (!upright.undisturbed(whole)) upright.add(plane_grid, out);
    return;
  }
  if (undisturbed(seen, whole)) return base_->heights(plane_grid, out);
  if (std::max(g.dx, g.dy) > kCoarsest || g.size() < kFewest) {
    std::vector<Vec2> points;
    points.reserve(g.size());
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) points.push_back({g.x(ix), g.y(iy)});
    return do_heights_at(plane_grid.X_SP, points, out);
  }
  std::vector<double> spare(out.z.empty() ? g.size() : 0);
  const HeightsOut all{out.z.empty() ? std::span<double>(spare) : out.z, out.dzdx, out.dzdy};
  const BaseHeights base(*base_, plane_grid, all);
  const auto band = [&](std::size_t which) {
    const int first = static_cast<int>(which) * DisplacedBand::kRows;
    DisplacedBand(seen, max_offset_, g, base, all).solve(first, std::min(first + DisplacedBand::kRows, g.ny));
  };
  const std::size_t bands = static_cast<std::size_t>((g.ny + DisplacedBand::kRows - 1) / DisplacedBand::kRows);
  constexpr std::size_t kWorthThreads = 1000;
  if (g.size() < kWorthThreads)
    for (std::size_t b = 0; b < bands; ++b) band(b);
  else
    parallel_for(bands, band);
}

void DisplacedSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  const std::size_t n = points_P.size();
  if (n == 0) return;
  if (is_upright_rail(body_, X_SP)) {
    base_->heights_at(X_SP, points_P, out);
    return UprightRail(*field_, X_SP).add(points_P, out);
  }
  const View seen = view(X_SP);
  Arrays all(out, n);
  base_->heights_at(X_SP, points_P, {all.z, all.dzdx, all.dzdy});
  std::vector<PlanePoint> points;
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i)
    points.push_back({i, points_P[i].x(), points_P[i].y(), all.z[i], all.dzdx[i], all.dzdy[i]});
  DisplacedPoints(seen, max_offset_).solve(points);
  for (const PlanePoint& p : points) all.put(p);
}

void DisplacedSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  Rectangle whole{kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (const Vec2& p : points_P)
    whole = {std::min(whole.x_min, p.x()), std::max(whole.x_max, p.x()), std::min(whole.y_min, p.y()),
             std::max(whole.y_max, p.y())};
  if (points_P.empty() || undisturbed(view(X_SP), whole)) return base_->locate(X_SP, points_P, out);
  std::fill(out.begin(), out.end(), SurfacePoint{});
  const std::size_t n = points_P.size();
  std::vector<double> z(n), dzdx(n), dzdy(n);
  heights_at(X_SP, points_P, {z, dzdx, dzdy});
  std::vector<std::size_t> hit;
  std::vector<Vec2> moved;
  std::vector<Vec3> position;
  std::vector<OffsetJet> offset;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(z[i])) continue;
    const Vec3 q = X_SP.apply({points_P[i].x(), points_P[i].y(), z[i]});
    const NaturalPoint at(body_, q);
    const OffsetJet d = field_->jet(at.u(), at.y);
    const Vec3 e = X_SP.rotation.transpose() * at.e;
    hit.push_back(i);
    moved.push_back({points_P[i].x() - d.value * e.x(), points_P[i].y() - d.value * e.y()});
    position.push_back(q);
    offset.push_back(d);
  }
  std::vector<SurfacePoint> below(hit.size());
  base_->locate(X_SP, moved, below);
  for (std::size_t k = 0; k < hit.size(); ++k) {
    const NaturalPoint at(body_, position[k]);
    SurfacePoint& p = out[hit[k]];
    if (below[k].status == LocateStatus::outside) {  // on the rim, where rounding decides
      const double side = body_ == Body::wheel ? 1.0 : -1.0;
      p.position_S = position[k];
      p.normal_S = side * (X_SP.rotation * Vec3(-dzdx[hit[k]], -dzdy[hit[k]], 1.0)).normalized();
      p.u = at.u();
      p.v = kNaN;
      p.status = LocateStatus::converged;
      continue;
    }
    fill_shape(*base_, body_, position[k], position[k] - offset[k].value * at.e, below[k], offset[k], p);
    p.v = below[k].v;
    p.arc_length = below[k].arc_length;
    p.status = below[k].status == LocateStatus::ambiguous ? LocateStatus::ambiguous : LocateStatus::converged;
  }
}

std::shared_ptr<const Surface> DisplacedSurface::do_change(std::size_t parameter, double amount) const {
  const std::size_t of_base = base_->parameter_count();
  if (parameter < of_base)
    return std::make_shared<DisplacedSurface>(base_->changed(parameter, amount), field_, body_, backend_);
  std::shared_ptr<const OffsetField> field = field_->changed(parameter - of_base, amount);
  return field ? std::make_shared<DisplacedSurface>(base_, std::move(field), body_, backend_) : nullptr;
}

/// Offsets act along e, which leaves u and y as they are.
bool DisplacedSurface::do_heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const {
  const std::size_t of_base = base_->parameter_count();
  if (parameter < of_base) return false;
  heights_by_displacement(*this, plane_grid, by, [&](const SurfacePoint& p) -> Vec3 {
    const NaturalPoint at(body_, p.position_S);
    return field_->by(parameter - of_base, at.u(), at.y) * at.e;
  });
  return true;
}

/// A point is q + d e, where q is the base's: what pulls at it pulls at q too, whose motion changes d and e.
std::optional<HeightsBy> DisplacedSurface::do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                                        std::span<const double> weights, std::span<double> by) const {
  const std::size_t of_base = base_->parameter_count();
  std::vector<Vec2> below;
  std::vector<Vec3> forces;
  pull_back_by_displacement(
      *this, X_SP, points_P, weights, [&](std::size_t i, const SurfacePoint& at, const Vec3& force) {
        const NaturalPoint p(body_, at.position_S);
        if (of_base < by.size()) field_->pull_back(p.u(), p.y, force.dot(p.e), by.subspan(of_base));
        if (of_base == 0) return;
        const OffsetJet d = field_->jet(p.u(), p.y);
        const NaturalPoint q(body_, at.position_S - d.value * p.e);
        Vec3 pulling =
            force + q.along * (d.d_u * q.du_along * force.dot(q.e) + d.value * q.de_along * force.dot(q.along));
        pulling.y() += d.d_y * force.dot(q.e);
        const Vec3 back = d.value * (X_SP.rotation.transpose() * p.e);
        below.emplace_back(points_P[i].x() - back.x(), points_P[i].y() - back.y());
        forces.push_back(pulling);
      });
  if (of_base == 0) return HeightsBy::exact;
  std::vector<SurfacePoint> at(below.size());
  base_->locate(X_SP, below, at);
  std::vector<double> of_heights(below.size(), 0.0);
  const Vec3 up = X_SP.rotation.col(2);
  for (std::size_t k = 0; k < at.size(); ++k)
    if (at[k].status != LocateStatus::outside) of_heights[k] = forces[k].dot(at[k].normal_S) * up.dot(at[k].normal_S);
  return base_->pull_back(X_SP, below, of_heights, by.first(of_base));
}

/// p = q + d e with the base's q(u, v) and the offset d at the station and y of q: neither changes along e.
void DisplacedSurface::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  evaluate(*base_, uv, out);
  for (SurfaceJet& jet : out) {
    if (!jet.found()) continue;
    const NaturalPoint at(body_, jet.p);
    // the station, x of a rail or the angle of a wheel, and its derivatives by u and v
    const Vec3 grad = at.du_along * at.along;
    const double s_u = grad.dot(jet.pu), s_v = grad.dot(jet.pv);
    const bool turns = at.de_along != 0.0;
    const auto second = [&](const Vec3& a, const Vec3& b, const Vec3& ab) {
      if (!turns) return grad.dot(ab);
      // Hessian of the angle: -(e along^T + along e^T)/r^2
      return grad.dot(ab) - (a.dot(at.e) * b.dot(at.along) + a.dot(at.along) * b.dot(at.e)) / (at.r * at.r);
    };
    const double s_uu = second(jet.pu, jet.pu, jet.puu), s_uv = second(jet.pu, jet.pv, jet.puv),
                 s_vv = second(jet.pv, jet.pv, jet.pvv);
    const double y_u = jet.pu.y(), y_v = jet.pv.y();
    const OffsetJet d = field_->jet(at.u(), at.y);
    const double d_u = d.d_u * s_u + d.d_y * y_u, d_v = d.d_u * s_v + d.d_y * y_v;
    const auto second_offset = [&](double s_a, double s_b, double y_a, double y_b, double s_ab, double y_ab) {
      return d.d_uu * s_a * s_b + d.d_uy * (s_a * y_b + s_b * y_a) + d.d_yy * y_a * y_b + d.d_u * s_ab + d.d_y * y_ab;
    };
    // derivatives of e by the station
    const Vec3 e_1 = turns ? at.along : Vec3::Zero(), e_2 = turns ? Vec3(-at.e) : Vec3::Zero();
    const auto second_shift = [&](double d_a, double d_b, double d_ab, double s_a, double s_b, double s_ab) -> Vec3 {
      return d_ab * at.e + (d_a * s_b + d_b * s_a + d.value * s_ab) * e_1 + d.value * s_a * s_b * e_2;
    };
    jet.puu += second_shift(d_u, d_u, second_offset(s_u, s_u, y_u, y_u, s_uu, jet.puu.y()), s_u, s_u, s_uu);
    jet.puv += second_shift(d_u, d_v, second_offset(s_u, s_v, y_u, y_v, s_uv, jet.puv.y()), s_u, s_v, s_uv);
    jet.pvv += second_shift(d_v, d_v, second_offset(s_v, s_v, y_v, y_v, s_vv, jet.pvv.y()), s_v, s_v, s_vv);
    jet.p += d.value * at.e;
    jet.pu += d_u * at.e + d.value * s_u * e_1;
    jet.pv += d_v * at.e + d.value * s_v * e_1;
  }
}

HeightBounds DisplacedSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const View seen = view(X_SP);
  Interval t;
  if (!rail_heights(X_SP, r, t)) {
    const HeightBounds near = base_->height_bounds(X_SP, enlarged(r, max_offset_));
    if (near.empty) return near;
    t = {near.z_min - max_offset_, near.z_max + max_offset_};
  }
  const Rectangle uy = seen.natural_box(r, t);
  const OffsetRange offsets = seen.offsets(uy);
  if (offsets.zero()) return base_->height_bounds(X_SP, r);
  const View::Directions e = seen.directions(uy);
  const HeightBounds source = base_->height_bounds(X_SP, View::moved_back(r, offsets, e));
  if (source.empty) return source;
  Interval shift = View::along_normal(offsets, e);
  if (body_ == Body::rail) {  // what is known of the heights now is more than before
    const Rectangle here =
        seen.natural_box(r, {std::max(t.low, source.z_min + shift.low), std::min(t.high, source.z_max + shift.high)});
    shift = View::along_normal(seen.offsets(here), e);
  }
  return {source.z_min + shift.low, source.z_max + shift.high, false};
}

/// Heights over r between which a rail lies, from its box alone; false if they say too little.
bool DisplacedSurface::rail_heights(const Pose& X_SP, const Rectangle& r, Interval& t) const {
  constexpr double kLeastUp = 0.5, kThickest = 0.5, kSlack = 1e-9;  // [m]
  const Vec3 up = X_SP.rotation.row(2).transpose();
  const double low = rail_low_ + range_.low - kSlack, high = rail_high_ + range_.high + kSlack;
  if (body_ != Body::rail || !(up.z() > kLeastUp) || !(high - low < kThickest)) return false;
  const Interval over = Interval{up.x(), up.x()} * Interval{r.x_min, r.x_max},
                 across = Interval{up.y(), up.y()} * Interval{r.y_min, r.y_max};
  const double rounding = 1e-12 * (1.0 + std::fabs(X_SP.origin.z()) + std::fabs(over.low) + std::fabs(over.high));
  t = {(low - X_SP.origin.z() - over.high - across.high - rounding) / up.z(),
       (high - X_SP.origin.z() - over.low - across.low + rounding) / up.z()};
  return std::isfinite(t.low) && std::isfinite(t.high);
}

}  // namespace

std::shared_ptr<const Surface> make_displaced_surface(std::shared_ptr<const Surface> base,
                                                      std::shared_ptr<const OffsetField> field, Body body,
                                                      std::string backend) {
  if (!base || !field) throw Error(ErrorKind::configuration, "a displaced surface needs a base and offsets");
  if ((base->facing() == Facing::down) != (body == Body::wheel))
    throw Error(ErrorKind::configuration, body == Body::wheel
                                              ? "offsets of a wheel need a base that faces down, as wheels do"
                                              : "offsets of a rail need a base that faces up, as rails do");
  return std::make_shared<DisplacedSurface>(std::move(base), std::move(field), body, std::move(backend));
}

}  // namespace treadmark::displacement
