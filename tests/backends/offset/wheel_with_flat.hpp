// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/offset/make.hpp"

namespace treadmark::testing {

constexpr double kPi = std::numbers::pi;

inline WheelFlat rounded_flat(double length, double depth, double theta, double width = 0.0, double y = 0.0) {
  WheelFlat f;
  f.shape = WheelFlat::Shape::rounded;
  f.length = length;
  f.depth = depth;
  f.theta_center = theta;
  f.width = width;
  f.y_center = y;
  return f;
}

/// Part of a wheel round theta [rad] within +-half [m] of arc.
inline Rectangle region(double theta, double half, double R) { return {theta - half / R, theta + half / R, -1.0, 1.0}; }

/// Level plane at the place theta, y of a wheel.
inline Pose level(double theta, double y, double R) {
  Pose X;
  X.rotation.col(0) = Vec3(std::cos(theta), 0.0, -std::sin(theta));
  X.rotation.col(2) = Vec3(std::sin(theta), 0.0, std::cos(theta));
  X.origin = X.rotation.col(2) * R + Vec3(0.0, y, 0.0);
  return X;
}

inline std::vector<double> heights(const Surface& surface, const Pose& X, const Grid2& grid) {
  std::vector<double> z(grid.size());
  surface.heights({X, grid}, {z, {}, {}});
  return z;
}

inline double greatest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double d = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) != std::isnan(b[i])) return 1.0;
    if (!std::isnan(a[i])) d = std::max(d, std::fabs(a[i] - b[i]));
  }
  return d;
}

}  // namespace treadmark::testing
