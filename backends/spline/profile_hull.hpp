// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/profile_spline.hpp"

namespace treadmark::spline {

/// Bezier points of a planar cubic; the curve lies in their convex hull.
struct BezierCubic {
  std::array<Vec2, 4> points;

  /// From power coefficients on [0, h].
  BezierCubic(const CubicSegment& segment, double h) {
    const Vec2 c0(segment.y[0], segment.z[0]), c1(segment.y[1] * h, segment.z[1] * h);
    const Vec2 c2(segment.y[2] * h * h, segment.z[2] * h * h), c3(segment.y[3] * h * h * h, segment.z[3] * h * h * h);
    points = {c0, c0 + c1 / 3.0, c0 + (2.0 * c1 + c2) / 3.0, c0 + c1 + c2 + c3};
  }
  explicit BezierCubic(const std::array<Vec2, 4>& control_points) : points(control_points) {}

  /// Range of direction . point.
  Interval range(const Vec2& direction) const {
    Interval r = Interval::none();
    for (const Vec2& point : points) {
      const double x = direction.dot(point);
      r.include({x, x});
    }
    return r;
  }

  /// Both halves (de Casteljau).
  std::array<BezierCubic, 2> halves() const {
    const Vec2 a = 0.5 * (points[0] + points[1]), b = 0.5 * (points[1] + points[2]), c = 0.5 * (points[2] + points[3]);
    const Vec2 d = 0.5 * (a + b), e = 0.5 * (b + c), f = 0.5 * (d + e);
    return {BezierCubic({points[0], a, d, f}), BezierCubic({f, e, c, points[3]})};
  }
};

}  // namespace treadmark::spline
