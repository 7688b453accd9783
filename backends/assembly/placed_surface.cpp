// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/assembly/placed_surface.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::assembly {
namespace {

Mat3 half_turn() { return Vec3(1.0, -1.0, -1.0).asDiagonal(); }

/// Box round a box of another frame; sides may be infinite.
Box3 moved(const Box3& box, const Pose& X) {
  Box3 out{X.origin, X.origin};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double c = X.rotation(i, j);
      if (c == 0.0) continue;
      out.min[i] += std::min(c * box.min[j], c * box.max[j]);
      out.max[i] += std::max(c * box.min[j], c * box.max[j]);
    }
  return out;
}

/// What both kinds share: where the surface stands.
class Placed : public Surface, public Parametric {
 public:
  Placed(std::shared_ptr<const Surface> surface, const Pose& X_SB)
      : surface_(std::move(surface)), X_SB_(X_SB), X_BS_(X_SB.inverse()) {
    if (surface_ == nullptr) throw Error(ErrorKind::configuration, "there is no surface to be placed");
  }
  std::string_view backend() const override { return surface_->backend(); }
  Box3 bounds() const override { return moved(surface_->bounds(), X_SB_); }
  std::size_t memory_bytes() const override { return sizeof(*this) + surface_->memory_bytes(); }
  std::vector<double> data_v() const override { return surface_->data_v(); }
  std::vector<ShapeParameter> parameters() const override {
    std::vector<ShapeParameter> all = surface_->parameters();
    for (ShapeParameter& one : all) one.place_S = X_SB_.apply(one.place_S);
    return all;
  }
  std::size_t parameter_count() const override { return surface_->parameter_count(); }
  bool exact_derivatives() const override { return has_exact_derivatives(*surface_); }

 protected:
  const Surface& surface() const { return *surface_; }
  const Pose& X_SB() const { return X_SB_; }
  Pose seen_from_own(const Pose& X_SP) const { return X_BS_ * X_SP; }
  void to_result_frame(std::span<SurfacePoint> points) const {
    for (SurfacePoint& p : points) {
      if (p.status == LocateStatus::outside) continue;
      p.position_S = X_SB_.apply(p.position_S);
      p.normal_S = X_SB_.rotation * p.normal_S;
      if (X_SB_.rotation(1, 1) < 0.0) p.arc_length = -p.arc_length;
    }
  }

 private:
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override {
    evaluate(*surface_, uv, out);
    for (SurfaceJet& jet : out) {
      jet.p = X_SB_.apply(jet.p);
      for (Vec3* d : {&jet.pu, &jet.pv, &jet.puu, &jet.puv, &jet.pvv}) *d = X_SB_.rotation * *d;
    }
  }

  std::shared_ptr<const Surface> surface_;
  Pose X_SB_, X_BS_;
};

class MovedSurface final : public Placed {
 public:
  using Placed::Placed;
  Facing facing() const override { return surface().facing(); }
  /// Shifted across and upright, or rolled, a rail stays prismatic; a wheel would no longer turn about its axle.
  bool constant_profile() const override { return keeps_profile() && surface().constant_profile(); }
  bool constant_between(double u_min, double u_max) const override {
    const double before = facing() == Facing::up ? X_SB().origin.x() : 0.0;
    return keeps_profile() && surface().constant_between(u_min - before, u_max - before);
  }

 private:
  bool keeps_profile() const {
    const Mat3& R = X_SB().rotation;
    const bool along = R == Mat3::Identity() || (facing() == Facing::up && R.col(0) == Vec3::UnitX());
    const bool centred = facing() == Facing::up || (X_SB().origin.x() == 0.0 && X_SB().origin.z() == 0.0);
    return along && centred;
  }
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override {
    return std::make_shared<MovedSurface>(surface().changed(parameter, amount), X_SB());
  }
  bool do_heights_by(std::size_t parameter, const PlaneGrid& g, std::span<double> by) const override {
    return surface().heights_by(parameter, {seen_from_own(g.X_SP), g.grid}, by) == HeightsBy::exact;
  }
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override {
    return surface().pull_back(seen_from_own(X_SP), points_P, weights, by);
  }
  void do_heights(const PlaneGrid& g, const HeightsOut& out) const override {
    surface().heights({seen_from_own(g.X_SP), g.grid}, out);
  }
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override {
    surface().heights_at(seen_from_own(X_SP), points_P, out);
  }
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override {
    surface().locate(seen_from_own(X_SP), points_P, out);
    to_result_frame(out);
  }
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& r) const override {
    return surface().height_bounds(seen_from_own(X_SP), r);
  }
  void do_grid_bounds(const Pose& X_SP, const RectangleGrid& r, std::span<HeightBounds> out) const override {
    surface().height_bounds(seen_from_own(X_SP), r, out);
  }
};

/// Heights are asked for from a plane Q that is turned over as well: x_Q = x_P, y_Q = -y_P, z_Q = -z_P.
class TurnedSurface final : public Placed {
 public:
  TurnedSurface(std::shared_ptr<const Surface> surface, double radius)
      : Placed(std::move(surface), {Vec3(0.0, 0.0, radius), half_turn()}) {}
  Facing facing() const override { return surface().facing() == Facing::up ? Facing::down : Facing::up; }

 private:
  Pose turned(const Pose& X_SP) const {
    Pose X_BQ = seen_from_own(X_SP);
    X_BQ.rotation.col(1) *= -1.0;
    X_BQ.rotation.col(2) *= -1.0;
    return X_BQ;
  }
  static Rectangle turned(const Rectangle& r) { return {r.x_min, r.x_max, -r.y_max, -r.y_min}; }
  static HeightBounds turned(const HeightBounds& b) { return b.empty ? b : HeightBounds{-b.z_max, -b.z_min, false}; }
  static std::vector<Vec2> turned(std::span<const Vec2> points_P) {
    std::vector<Vec2> points_Q(points_P.size());
    std::transform(points_P.begin(), points_P.end(), points_Q.begin(),
                   [](const Vec2& p) { return Vec2(p.x(), -p.y()); });
    return points_Q;
  }
  /// Slopes across keep their sign: both z and y change theirs.
  static void turn_values(const HeightsOut& out) {
    for (double& z : out.z) z = -z;
    for (double& slope : out.dzdx) slope = -slope;
  }

  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override {
    return std::make_shared<TurnedSurface>(surface().changed(parameter, amount), X_SB().origin.z());
  }
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override {
    std::vector<double> turned_weights(weights.begin(), weights.end());
    for (double& weight : turned_weights) weight = -weight;
    return surface().pull_back(turned(X_SP), turned(points_P), turned_weights, by);
  }
  void do_heights(const PlaneGrid& plane, const HeightsOut& out) const override {
    Grid2 g = plane.grid;
    g.y0 = -g.y(g.ny - 1);
    surface().heights({turned(plane.X_SP), g}, out);
    turn_values(out);
    const auto nx = static_cast<std::ptrdiff_t>(g.nx);
    for (const auto field : {out.z, out.dzdx, out.dzdy}) {
      if (field.empty()) continue;
      for (std::ptrdiff_t low = 0, high = g.ny - 1; low < high; ++low, --high)
        std::swap_ranges(field.begin() + low * nx, field.begin() + (low + 1) * nx, field.begin() + high * nx);
    }
  }
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override {
    surface().heights_at(turned(X_SP), turned(points_P), out);
    turn_values(out);
  }
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override {
    surface().locate(turned(X_SP), turned(points_P), out);
    to_result_frame(out);
  }
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& r) const override {
    return turned(surface().height_bounds(turned(X_SP), turned(r)));
  }
  void do_grid_bounds(const Pose& X_SP, const RectangleGrid& r, std::span<HeightBounds> out) const override {
    RectangleGrid q = r;
    q.first = turned(r.at(0, r.ny - 1));
    surface().height_bounds(turned(X_SP), q, out);
    for (HeightBounds& b : out) b = turned(b);
    for (int iy = 0; iy < r.ny - 1 - iy; ++iy)
      std::swap_ranges(out.begin() + static_cast<std::ptrdiff_t>(r.index(0, iy)),
                       out.begin() + static_cast<std::ptrdiff_t>(r.index(0, iy) + r.index(0, 1)),
                       out.begin() + static_cast<std::ptrdiff_t>(r.index(0, r.ny - 1 - iy)));
  }
};

}  // namespace

std::shared_ptr<const Surface> place_surface(std::shared_ptr<const Surface> surface, const Pose& X_SB) {
  return std::make_shared<MovedSurface>(std::move(surface), X_SB);
}

std::shared_ptr<const Surface> turn_over(std::shared_ptr<const Surface> surface, double radius) {
  return std::make_shared<TurnedSurface>(std::move(surface), radius);
}

}  // namespace treadmark::assembly
