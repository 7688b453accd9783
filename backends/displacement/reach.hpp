// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>

#include "treadmark/backends/displacement/offset_field.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::displacement {

struct Interval {
  double low = 0.0, high = 0.0;
};

/// A base, its offsets and the plane they are seen from, with conservative answers about boxes (x, y, t) of the plane
/// frame P.
struct View {
  const Surface& base;
  const OffsetField& field;
  Body body;
  Pose X_SP;

  double side() const { return body == Body::wheel ? 1.0 : -1.0; }  ///< sign of t towards the other body

  /// All (u, y) of a rectangle of P times the heights [t_low, t_high].
  Rectangle natural_box(const Rectangle& r, const Interval& t) const;

  /// The field's range, narrowed by its value in the middle and its Lipschitz constants.
  OffsetRange offsets(const Rectangle& uy) const;

  /// Direction of the offset, in P, over a range of u.
  struct Directions {
    Interval e[3];
  };
  Directions directions(const Rectangle& uy) const;

  /// Where points go that lie over r and are moved back by the offsets of range.
  static Rectangle moved_back(const Rectangle& r, const OffsetRange& range, const Directions& e);
  static Interval along_normal(const OffsetRange& range, const Directions& e);

  /// How far a point at most goes along u [m] per height along the normal of P, in a box of (u, y) that holds the point
  /// q.
  double tilt_along(const Rectangle& uy, const Vec3& q_S) const;
  /// Bound of |d(offset * e)/dt| along the normal of P in a box of (u, y) that holds the point q.
  double rate(const OffsetRange& offsets, const Rectangle& uy, const Vec3& q_S) const;
};

Interval operator*(const Interval& a, const Interval& b);
Rectangle enlarged(const Rectangle& r, double by);
double greatest(const OffsetRange& range);
/// How far points at most go aside that are moved back from r to moved.
struct Reach {
  double x, y;
};
inline Reach reach(const Rectangle& r, const Rectangle& moved) {
  return {std::max(r.x_min - moved.x_min, moved.x_max - r.x_max),
          std::max(r.y_min - moved.y_min, moved.y_max - r.y_max)};
}
/// [m] Sideways, below which points and their moved-back places are the same.
inline constexpr double kNoReach = 1e-12;

}  // namespace treadmark::displacement
