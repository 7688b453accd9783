// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/chain_view.hpp"
#include "treadmark/backends/analytic/chord_tree.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::analytic {

/// A chain of arcs and lines extruded along x without end: a rail. Every query is in closed form: a line along the
/// plane normal meets the surface where its projection to the y-z plane meets the chain. u = x [m], v = arc length
/// along the chain [m].
class PrismaticSurface final : public Surface, public Parametric {
 public:
  explicit PrismaticSurface(const ArcChain& chain);

  std::string_view backend() const override { return "analytic"; }
  Facing facing() const override { return Facing::up; }
  bool constant_profile() const override { return true; }
  Box3 bounds() const override;
  std::size_t memory_bytes() const override {
    return sizeof(*this) + chain_.capacity() * sizeof(ChainSegment) + chords_.memory_bytes();
  }
  /// Curvature and length of every segment, the others following it; the crown stays where it is.
  std::vector<ShapeParameter> parameters() const override;
  std::size_t parameter_count() const override { return 2 * chain_.size(); }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override;
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;

  /// The chain seen along (d_y, d_z). The views used last are kept by every thread, because neighbouring calls share
  /// one.
  std::shared_ptr<const ChainView> view(double d_y, double d_z) const;
  /// Whether the chain seen along (d_y, d_z) hides nothing of itself.
  bool graph(double d_y, double d_z) const;

  std::vector<ChainSegment> chain_;
  ChordTree chords_;
  std::uint64_t id_;  ///< of this surface alone
  double angle_min_ = 0.0, angle_max_ = 0.0;
};

}  // namespace treadmark::analytic
