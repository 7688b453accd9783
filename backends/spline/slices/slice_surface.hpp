// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/spline/slices/slice_geometry.hpp"
#include "treadmark/backends/spline/slices/slice_hulls.hpp"
#include "treadmark/backends/spline/slices/slice_net.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::spline {

/// A half-parametric surface: (y, w) is a tensor spline of (u, v), the third coordinate is u itself. v runs from 1 to
/// positions() in steps of about 0.5 mm.
/// Misses: where parts are missing (also in a cell with one such end, and up to one cell before x = +-r of a wheel); a
/// plane whose normal runs along a rail. Only the half of a wheel turned towards the plane is hit.
template <class Geometry>
class SliceSurface final : public Surface, public Parametric {
 public:
  /// Wheel: w of the net is the height over nominal_radius. Errors: Error(configuration) unless its radius is positive.
  SliceSurface(SliceNet net, double nominal_radius);

  const SliceNet& net() const { return net_; }
  Vec3 point(double u, double v) const;

  std::string_view backend() const override { return "spline"; }
  Facing facing() const override;
  Box3 bounds() const override;
  std::size_t memory_bytes() const override;
  std::vector<double> data_v() const override;
  /// SliceNet::numbers: z of a rail, the radius of a wheel at the stations, and how they go on along them.
  std::vector<ShapeParameter> parameters() const override;
  std::size_t parameter_count() const override { return net_.numbers(); }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override;
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override;
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;
  void do_grid_bounds(const Pose& X_SP, const RectangleGrid& rectangles_P, std::span<HeightBounds> out) const override;

  SliceNet net_;  ///< of a wheel with its radius
  double nominal_radius_;
  Geometry geometry_;
  SliceHulls hulls_;
};

using SliceRail = SliceSurface<RailGeometry>;
using SliceWheel = SliceSurface<WheelGeometry>;

extern template class SliceSurface<RailGeometry>;
extern template class SliceSurface<WheelGeometry>;

}  // namespace treadmark::spline
