// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::sampling {

/// The part of a surface that is sampled: u is x [m] of a rail, theta [rad] of a wheel; y [m].
/// A wheel's range of a whole turn or more, or an infinite one, means the closed wheel.
struct Region {
  /// [m] or [rad]
  double u_min = -std::numeric_limits<double>::infinity(), u_max = std::numeric_limits<double>::infinity();
  /// [m]
  double y_min = -std::numeric_limits<double>::infinity(), y_max = std::numeric_limits<double>::infinity();
};

/// Points of a surface on stations u (x [m] or theta [rad]) times lateral nodes y: where a longitudinal station crosses
/// a lateral node, the height z (rail) or the radius r (wheel). NaN = no surface there.
struct PointGrid {
  Body body = Body::rail;
  std::vector<double> u;  ///< strictly increasing; a closed wheel ends one step before u.front() + 2 pi
  std::vector<double> y;  ///< strictly increasing [m]; dense where the section is steep
  std::vector<double> h;  ///< z or r [m]; index = iu * y.size() + iy
  std::vector<double>
      own_y;             ///< where nodes follow sections that move aside: y of each point instead, as h; else empty
  double stagger = 0.0;  ///< added to u at odd lateral nodes: half a step makes nearly equilateral triangles
  bool closed = false;   ///< wheel only: the last station neighbours the first

  /// Where the value of a point stands in h.
  std::size_t index(std::size_t iu, std::size_t iy) const { return iu * y.size() + iy; }
  /// Whether there is a surface.
  bool present(std::size_t iu, std::size_t iy) const { return !std::isnan(h[index(iu, iy)]); }
  /// In the surface frame.
  Vec3 point(std::size_t iu, std::size_t iy) const {
    const double value = h[index(iu, iy)], at = u[iu] + (iy % 2 == 1 ? stagger : 0.0);
    const double across = own_y.empty() ? y[iy] : own_y[index(iu, iy)];
    return body == Body::rail ? Vec3(at, across, value) : Vec3(value * std::sin(at), across, value * std::cos(at));
  }
};

}  // namespace treadmark::sampling
