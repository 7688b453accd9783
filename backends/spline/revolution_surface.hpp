// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/backends/spline/profile_tree.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::spline {

/// A round wheel: p(u, v) = (r sin u, y(v), r cos u), r = nominal radius + z(v), u = angle about the axle [rad],
/// v = arc length along the profile [m]. Only the half turned towards the plane is hit: a line through the inside of
/// the wheel to its far side is a miss. Within a profile segment of x = +-r, where the surface stands upright over the
/// plane, points may be misses too.
class RevolutionSurface final : public Surface, public Parametric {
 public:
  /// Errors: Error(configuration) unless the radius is positive everywhere.
  RevolutionSurface(ProfileSpline profile, double nominal_radius);

  const ProfileSpline& profile() const { return profile_; }
  double nominal_radius() const { return nominal_radius_; }
  Vec3 point(double u, double v) const;

  std::string_view backend() const override { return "spline"; }
  Facing facing() const override { return Facing::down; }
  bool constant_profile() const override { return true; }
  Box3 bounds() const override;
  std::size_t memory_bytes() const override;
  /// Of the points of the profile (node_change.hpp).
  std::vector<ShapeParameter> parameters() const override;
  std::size_t parameter_count() const override { return profile_.breaks().size(); }
  std::vector<double> data_v() const override { return {profile_.breaks().begin(), profile_.breaks().end()}; }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override;
  bool do_heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const override;
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override;
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;

  ProfileSpline profile_;  // (y, r)
  double nominal_radius_;
  ProfileHulls hulls_;
};

}  // namespace treadmark::spline
