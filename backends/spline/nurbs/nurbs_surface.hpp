// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_bounds.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_view.hpp"
#include "treadmark/backends/spline/surface_derivatives.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::spline {

/// A full-parametric surface: all three coordinates are rational tensor splines of (u, v). u grows along a rail or with
/// the angle of a wheel, v with y. Located points have u = x [m] or the angle about the axle [rad], v = the parameter
/// of the surface [m]. Heights are those of the splines to rounding. Of a wheel only the half turned towards the plane
/// is hit. A plane that sees the surface edge-on meets nothing.
class NurbsSurface final : public Surface, public Parametric {
 public:
  NurbsSurface(NurbsNet net, Body body, std::string_view backend = "nurbs")
      : net_(std::move(net)), hull_(net_), body_(body), backend_(backend) {}

  const NurbsNet& net() const { return net_; }
  /// Position and derivatives by the surface's own parameters, clamped to its borders.
  SurfaceDerivatives derivatives(double u, double v) const;
  Vec3 point(double u, double v) const { return derivatives(u, v).p; }

  std::string_view backend() const override { return backend_; }
  Facing facing() const override { return body_ == Body::rail ? Facing::up : Facing::down; }
  Box3 bounds() const override { return net_.bounds(); }
  std::size_t memory_bytes() const override { return sizeof(*this) + net_.memory_bytes() + hull_.memory_bytes(); }
  /// NurbsNet::numbers, along z of a rail or the radius of a wheel where they are.
  std::vector<ShapeParameter> parameters() const override;
  std::size_t parameter_count() const override { return net_.numbers(); }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override;
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override;
  Vec3 direction_of(std::size_t parameter) const;
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override;
  void hit_tile(const Pose& X_SP, const FacingHalf& half, const ViewArrays& view, const TileArrays& tile) const;
  SurfaceDerivatives derivatives_at(const NurbsNet::Place& place) const;

  NurbsNet net_;
  NurbsHull hull_;
  Body body_;
  std::string_view backend_;  ///< of a literal
};

/// Errors: Error(input_data) for what no spline can go through or near: gaps, fewer than 4 x 4 points, stations or
/// nodes that do not increase, radii that are not positive.
void check_points(const sampling::PointGrid& grid);
/// The mean chord length up to each lateral node along the stations [m].
std::vector<double> chord_lengths(const sampling::PointGrid& grid);

/// The cubic tensor B-spline through all points, twice continuously differentiable: in u with knots at the stations
/// (periodic if closed, else not-a-knot ends), in v with knots at the mean chord length along the stations [m] (de Boor
/// 1978). Errors: those of check_points.
NurbsNet fit_point_grid(const sampling::PointGrid& grid);

/// A chain as rational arcs (Piegl and Tiller 1997), swept from x_min to x_max or revolved all round. v is the arc
/// length at the ends of patches, u is x or, at the ends of patches, the angle. Errors: Error(configuration) for a
/// chain without segments, with bad numbers or longer than a circle, a bad range, a chain that reaches the axle.
NurbsNet sweep_chain(const ArcChain& chain, double x_min, double x_max);
NurbsNet revolve_chain(const ArcChain& chain, double nominal_radius);

}  // namespace treadmark::spline
