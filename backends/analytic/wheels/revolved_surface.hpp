// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/analytic/wheels/wheel_ray.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::analytic {

/// A profile z(y) revolved about the axle, with flats taken off: a wheel. u = theta [rad], v = y [m].
/// Only the half of the wheel that faces the plane's +z is seen.
class RevolvedSurface final : public Surface, public Parametric {
 public:
  RevolvedSurface(GraphCurve curve, double nominal_radius, const std::vector<WheelFlat>& flats)
      : body_(std::move(curve), nominal_radius, flats) {}

  std::string_view backend() const override { return "analytic"; }
  Facing facing() const override { return Facing::down; }
  bool constant_profile() const override { return body_.flats.empty(); }
  bool constant_between(double u_min, double u_max) const override {
    return !body_.flats.touches(0.5 * (u_min + u_max), 0.5 * (u_max - u_min));
  }
  Box3 bounds() const override {
    return {{-body_.r_max, body_.curve.y_min(), -body_.r_max}, {body_.r_max, body_.curve.y_max(), body_.r_max}};
  }
  std::size_t memory_bytes() const override {
    return sizeof(*this) + body_.chords.memory_bytes() + body_.hull.memory_bytes() + body_.flats.memory_bytes() +
           static_cast<std::size_t>(body_.curve.piece_count()) * sizeof(PolynomialGraph);
  }
  /// How much each arc, line or polynomial of the profile bends: 1 more is 1/m more of d2r/dy2 between its ends, the
  /// profile beyond following it, with the tape circle y = 0 held. Then the amount of all flats: 1 is all once more.
  std::vector<ShapeParameter> parameters() const override;
  std::size_t parameter_count() const override {
    return static_cast<std::size_t>(body_.curve.piece_count()) + (body_.flats.empty() ? 0 : 1);
  }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override;
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override;
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;

  WheelBody body_;
};

}  // namespace treadmark::analytic
