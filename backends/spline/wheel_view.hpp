// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/core/grid.hpp"

namespace treadmark::spline {

/// True if lines along y suit a plane better: the axis across the lines should lie in the wheel's (x, z) plane.
inline bool wheel_lines_along_y(const Mat3& axes) {
  return std::hypot(axes(0, 0), axes(2, 0)) >= std::hypot(axes(0, 1), axes(2, 1));
}

/// A wheel cut by planes "across . (p - origin) = constant". A wheel point p is written as p = a e + b f + y j: e along
/// the part of across in the (x, z) plane, f in that plane at right angles to e on the side to which the normal points,
/// j along the axle. In the cutting plane a = (c - across_y y) / across_e, and b = sqrt(r^2 - a^2).
struct WheelView {
  Vec3 e, f;
  double across_e, across_y, across_origin;
  double along_e, along_f, along_y, along_origin;
  double normal_e, normal_f, normal_y, normal_origin;

  WheelView(const Vec3& across, const Vec3& along, const Vec3& normal, const Vec3& origin) {
    across_e = std::hypot(across.x(), across.z());
    e = Vec3(across.x(), 0.0, across.z()) / across_e;
    f = Vec3(-e.z(), 0.0, e.x());
    double side = normal.dot(f);
    if (std::abs(side) < 1e-12) side = f.z();
    if (side < 0.0) f = -f;
    across_y = across.y(), across_origin = across.dot(origin);
    along_e = along.dot(e), along_f = along.dot(f), along_y = along.y(), along_origin = along.dot(origin);
    normal_e = normal.dot(e), normal_f = normal.dot(f), normal_y = normal.y(), normal_origin = normal.dot(origin);
  }

  /// Angle about the axle of the point a e + b f.
  double angle(double a, double b) const { return std::atan2(a * e.x() + b * f.x(), a * e.z() + b * f.z()); }
};

/// Heights over a rectangle of the part of a wheel whose (y, r) lie in a box, without regard to the angle;
/// conservative.
struct WheelBoxBounds {
  const WheelView& view;
  Interval across, along;  ///< the rectangle

  struct Result {
    Interval a, s, n;  ///< n empty: not over the rectangle
  };
  Result of(const Interval& y, const Interval& r) const {
    Result result{};
    result.n = Interval::none();
    result.a = (1.0 / view.across_e) * (across + view.across_origin + -view.across_y * y);
    const Interval reach = magnitude(result.a);
    if (reach.low > r.high) return result;
    const Interval b{std::sqrt(std::max(0.0, r.low * r.low - reach.high * reach.high)),
                     std::sqrt(std::max(0.0, r.high * r.high - reach.low * reach.low))};
    result.s = view.along_e * result.a + view.along_y * y + view.along_f * b + -view.along_origin;
    if (result.s.overlaps(along))
      result.n = view.normal_e * result.a + view.normal_y * y + view.normal_f * b + -view.normal_origin;
    return result;
  }
};

}  // namespace treadmark::spline
