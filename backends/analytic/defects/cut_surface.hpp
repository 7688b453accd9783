// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "treadmark/backends/analytic/defects/cutter.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {

/// A rail of any backend less the volumes that cutters remove. A line keeps the base's hit where that lies outside of
/// the volumes, and otherwise ends where it leaves them: on a swept section or on a wall at one of its ends. u = x [m]
/// where material was removed; lateral parameters and data are those of the base, met by the same line.
class CutSurface final : public Surface {
 public:
  CutSurface(std::shared_ptr<const Surface> base, std::vector<Cutter> cutters)
      : base_(std::move(base)), cutters_(std::move(cutters)) {}

  std::string_view backend() const override { return base_->backend(); }
  Facing facing() const override { return Facing::up; }
  std::vector<double> data_v() const override { return base_->data_v(); }
  Box3 bounds() const override;
  std::size_t memory_bytes() const override;

 private:
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;

  std::shared_ptr<const Surface> base_;
  std::vector<Cutter> cutters_;
};

/// Conservative height bounds of what cutters leave of a base, from those of the base over the same rectangle. A line
/// that leaves the volume of a cutter does so through its section or a wall above an end of it, which are looked at
/// along the normal; how the path moves and rolls over the rectangle is taken as a thickness.
HeightBounds cut_bounds(std::span<const Cutter> cutters, const Pose& X_SP, const Rectangle& rectangle_P,
                        const HeightBounds& base);

}  // namespace treadmark::analytic
