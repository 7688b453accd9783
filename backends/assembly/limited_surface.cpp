// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/assembly/limited_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::assembly {
namespace {

class LimitedSurface final : public Surface, public Parametric {
 public:
  LimitedSurface(std::shared_ptr<const Surface> rail, double x_min, double x_max)
      : rail_(std::move(rail)), x_min_(x_min), x_max_(x_max) {
    if (rail_ == nullptr) throw Error(ErrorKind::configuration, "there is no surface to be limited");
    if (!(x_min < x_max)) throw Error(ErrorKind::configuration, "a limited surface must have some length");
  }

  std::string_view backend() const override { return rail_->backend(); }
  Facing facing() const override { return rail_->facing(); }
  std::vector<double> data_v() const override { return rail_->data_v(); }
  std::vector<ShapeParameter> parameters() const override { return rail_->parameters(); }
  std::size_t parameter_count() const override { return rail_->parameter_count(); }
  std::size_t memory_bytes() const override { return sizeof(*this) + rail_->memory_bytes(); }
  Box3 bounds() const override {
    Box3 box = rail_->bounds();
    box.min.x() = std::max(box.min.x(), x_min_);
    box.max.x() = std::min(box.max.x(), x_max_);
    return box;
  }

 private:
  bool inside(double x) const { return x >= x_min_ && x <= x_max_; }

  /// Takes away what lies beyond the ends. point: index -> place (x, y) in P.
  template <class Point>
  void cut(const Pose& X_SP, std::span<const double> z, const HeightsOut& out, Point point) const {
    for (std::size_t i = 0; i < z.size(); ++i) {
      const Vec2 p = point(i);
      const bool here = !std::isnan(z[i]) && inside(X_SP.apply({p.x(), p.y(), z[i]}).x());
      if (!out.z.empty()) out.z[i] = here ? z[i] : kNaN;
      if (here) continue;
      if (!out.dzdx.empty()) out.dzdx[i] = kNaN;
      if (!out.dzdy.empty()) out.dzdy[i] = kNaN;
    }
  }

  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override {
    return std::make_shared<LimitedSurface>(rail_->changed(parameter, amount), x_min_, x_max_);
  }
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override {
    return rail_->pull_back(X_SP, points_P, weights, by);
  }
  void do_heights(const PlaneGrid& plane, const HeightsOut& out) const override {
    const Grid2& g = plane.grid;
    std::vector<double> z(g.size());
    rail_->heights(plane, {z, out.dzdx, out.dzdy});
    const auto nx = static_cast<std::size_t>(g.nx);
    cut(plane.X_SP, z, out,
        [&](std::size_t i) { return Vec2(g.x(static_cast<int>(i % nx)), g.y(static_cast<int>(i / nx))); });
  }
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override {
    std::vector<double> z(points_P.size());
    rail_->heights_at(X_SP, points_P, {z, out.dzdx, out.dzdy});
    cut(X_SP, z, out, [&](std::size_t i) { return points_P[i]; });
  }
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override {
    rail_->locate(X_SP, points_P, out);
    for (SurfacePoint& p : out)
      if (p.status != LocateStatus::outside && !inside(p.position_S.x())) p = {};
  }
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override {
    evaluate(*rail_, uv, out);
    for (SurfaceJet& jet : out)
      if (!inside(jet.p.x())) jet = {};
  }
  bool exact_derivatives() const override { return has_exact_derivatives(*rail_); }
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& r) const override {
    return rail_->height_bounds(X_SP, r);
  }
  void do_grid_bounds(const Pose& X_SP, const RectangleGrid& r, std::span<HeightBounds> out) const override {
    rail_->height_bounds(X_SP, r, out);
  }

  std::shared_ptr<const Surface> rail_;
  double x_min_, x_max_;
};

}  // namespace

std::shared_ptr<const Surface> limit_along(std::shared_ptr<const Surface> rail, double x_min, double x_max) {
  return std::make_shared<LimitedSurface>(std::move(rail), x_min, x_max);
}

}  // namespace treadmark::assembly
