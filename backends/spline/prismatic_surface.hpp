// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>

#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/backends/spline/profile_tree.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::spline {

/// A rail of constant cross-section: p(u, v) = (u, y(v), z(v)), u = x unlimited, v = arc length along the profile [m].
/// Heights are those of one plane curve for a plane in any position. A plane whose normal runs along x meets nothing.
class PrismaticSurface final : public Surface, public Parametric {
 public:
  explicit PrismaticSurface(ProfileSpline profile);

  const ProfileSpline& profile() const { return profile_; }
  Vec3 point(double u, double v) const;

  std::string_view backend() const override { return "spline"; }
  Facing facing() const override { return Facing::up; }
  bool constant_profile() const override { return true; }
  Box3 bounds() const override;
  std::size_t memory_bytes() const override;
  /// Of the points of the profile (node_change.hpp).
  std::vector<ShapeParameter> parameters() const override;
  std::size_t parameter_count() const override { return profile_.breaks().size(); }

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
  void do_grid_bounds(const Pose& X_SP, const RectangleGrid& rectangles_P, std::span<HeightBounds> out) const override;

  std::uint64_t id_;  ///< of no other surface, ever
  ProfileSpline profile_;
  ProfileHulls hulls_;
};

}  // namespace treadmark::spline
