// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>

#include "treadmark/core/surface.hpp"

namespace treadmark {

/// A rail or wheel as the graph of one function, of which is known how steep it is at most.
struct SteepestGraph {
  /// z of a rail at (x, y), radius of a wheel at (theta, y) [m]. Asked within domain only, from any thread.
  std::function<double(double u, double y)> value;
  Rectangle domain;              ///< where it is: x_min and x_max of a rail [m], not used of a wheel, which is whole
  double low = 0.0, high = 0.0;  ///< least and greatest value [m]; of a wheel positive
  /// Two values differ by no more than so much times the distance of their places: of a rail in the plane of x and y,
  /// of a wheel in that of y and of arcs of the radius low [-].
  double slope = 0.0;
};

/// True bounds of the heights over a rectangle, for surfaces without bounds of their own (Surface::do_height_bounds),
/// by some values: where a value is far from a point for its slope, nothing lies near that point (J. C. Hart, Sphere
/// tracing, 1996). Towards the other body they lie about 1 + slope times half the rectangle's size beyond its heights;
/// on the far side those of a wheel may be looser. Thread-safe.
HeightBounds height_bounds(Facing facing, const SteepestGraph& graph, const Pose& X_SP, const Rectangle& rectangle_P);

}  // namespace treadmark
