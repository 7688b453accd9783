// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/displacement/natural_point.hpp"
#include "treadmark/backends/displacement/reach.hpp"

namespace treadmark::displacement {

/// The line over (x, y) along the normal of P, and the function whose outermost zero is its height:
/// F(t) = t - d e_z - h(x - d e_x, y - d e_y), d and e at the point of height t, h the heights of the base.
class DisplacedLine {
 public:
  DisplacedLine(const View& view, double x, double y) : view_(view), x_(x), y_(y) {}

  struct Sample {
    double F = 0.0, dF = 0.0;
    double dzdx = 0.0, dzdy = 0.0;  ///< slopes of the displaced surface, if F = 0
    double steepness = 1.0;         ///< |grad(t - h)|
  };
  /// F is NaN where the point moved back is not over the base.
  Sample at(double t) const;

  /// Outermost zero, found by bisection with rigorous bounds of F over intervals down to kFinest, or until the points
  /// moved back stay within 2 kFinest; NaN if there is none.
  /// It needs no guess and no smoothness, and costs 10 to 1000 calls of the base.
  double search(double max_offset) const;
  static constexpr double kFinest = 1e-6;  ///< [m]

 private:
  struct Search {
    double finest;
    int budget;
  };
  /// Whether F can be 0 there; aside: size of the rectangle in which the points moved back lie.
  bool may_vanish(const Interval& t, double& aside) const;
  double search_interval(double outer, double inner, Search& search) const;
  double polish(double outer, double inner) const;

  const View& view_;
  double x_, y_;
};

}  // namespace treadmark::displacement
