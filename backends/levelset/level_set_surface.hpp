// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/backends/levelset/distance_field.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::levelset {

/// The zero of a field of distances as a wheel or rail. A line first meets the place where it enters the material; a
/// line that meets the inside first misses, so that an open sector never shows its far side. Along the line the field
/// is a polynomial in every cell, whose roots are counted and none passed over, however the surface is folded.
/// Immutable, thread-safe.
class LevelSetSurface final : public Surface, public Parametric {
 public:
  LevelSetSurface(DistanceField field, Facing facing, std::string backend);

  std::string_view backend() const override { return backend_; }
  Facing facing() const override { return facing_; }
  Box3 bounds() const override { return box_; }
  std::size_t memory_bytes() const override { return sizeof(*this) + field_.memory_bytes(); }
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override;

 private:
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;

  /// The field at a crossing, with derivatives in the frame of the surface: distances [m], per m and per m^2.
  CellJet jet(DistanceField::Reader& reader, const LatticeView& view, const Crossing& at, double x, double y) const;

  DistanceField field_;
  Facing facing_;
  std::string backend_;
  Box3 box_;
};

}  // namespace treadmark::levelset
