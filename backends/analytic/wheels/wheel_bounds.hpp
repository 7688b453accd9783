// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/analytic/wheels/wheel_ray.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {

/// Conservative height bounds of a wheel over a rectangle: F = r - r(theta, y) is bounded over boxes (rectangle times
/// an interval of t) from its value at the middle and the range of its derivatives, and t is bisected.
class WheelBounds {
 public:
  WheelBounds(const WheelBody& body, const Pose& X_SP, const Rectangle& rectangle_P);
  HeightBounds heights() const;

 private:
  /// Bounds of F over the rectangle and t in [a, b], over that part that lies over the profile.
  struct Box {
    double f_min = 0.0, f_max = 0.0;
    bool outside = false;  ///< nowhere over the profile
    bool within = false;   ///< everywhere over the profile
    bool may_hit() const { return !outside && f_min <= 0.0 && f_max >= 0.0; }
  };
  Box box(double a, double b) const;
  bool find_top(double a, double b, double& top) const;
  bool find_bottom(double a, double b, double& bottom) const;

  const WheelBody& body_;
  const Pose& X_;
  double x_, y_, half_x_, half_y_;
  double tolerance_;
};

}  // namespace treadmark::analytic
