// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/spline/nurbs_bounds.hpp"
#include "treadmark/backends/spline/nurbs_net.hpp"
#include "treadmark/backends/spline/surface_derivatives.hpp"
#include "treadmark/core/profile.hpp"

namespace treadmark::spline {

/// A full-parametric surface: all three coordinates are rational tensor splines of (u, v). u grows along a rail or with
/// the angle of a wheel, v with y. Located points have u = x [m] or the angle about the axle [rad], v = the parameter
/// of the surface [m]. Heights are those of the splines to rounding. Of a wheel only the half turned towards the plane
/// is hit. A plane that sees the surface edge-on meets nothing.
class NurbsSurface final : public Surface {
 public:
  NurbsSurface(NurbsNet net, Body body) : net_(std::move(net)), hull_(net_), body_(body) {}

  const NurbsNet& net() const { return net_; }
  /// Position and derivatives by the surface's own parameters, clamped to its borders.
  SurfaceDerivatives derivatives(double u, double v) const;
  Vec3 point(double u, double v) const { return derivatives(u, v).p; }

  std::string_view backend() const override { return "nurbs"; }
  Facing facing() const override { return body_ == Body::rail ? Facing::up : Facing::down; }
  Box3 bounds() const override { return net_.bounds(); }
  std::size_t memory_bytes() const override { return sizeof(*this) + net_.memory_bytes() + hull_.memory_bytes(); }

 private:
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;
  SurfaceDerivatives derivatives_at(const NurbsNet::Place& place) const;

  NurbsNet net_;
  NurbsHull hull_;
  Body body_;
};

}  // namespace treadmark::spline
