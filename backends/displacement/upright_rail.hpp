// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/displacement/offset_field.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::displacement {

/// Whether offsets act along the normal of the plane: a rail in a plane that is at most yawed. Every line then keeps
/// its place, and the offset is simply added.
bool is_upright_rail(Body body, const Pose& X_SP);

/// Adds offsets to a base's heights and slopes of such a plane, at points (x[i], y[i]). Arrays of n, or empty.
class UprightRail {
 public:
  UprightRail(const OffsetField& field, const Pose& X_SP) : field_(field), X_(X_SP) {}
  void add(const PlaneGrid& plane_grid, const HeightsOut& out) const;
  void add(std::span<const Vec2> points_P, const HeightsOut& out) const;
  /// Whether there is no offset over a rectangle of P.
  bool undisturbed(const Rectangle& r) const;

 private:
  static constexpr std::size_t kMany = 128;
  void add_many(const double* x, const double* y, std::size_t n, const HeightsOut& out, std::size_t at) const;

  const OffsetField& field_;
  const Pose& X_;
};

}  // namespace treadmark::displacement
