// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::scans {

/// Where a point lies on a wheel or rail: u round the wheel [rad] or along the rail [m], y across, v out of the
/// material (the radius, or -z).
struct Natural {
  double u = 0.0, y = 0.0, v = 0.0;
};

inline Natural natural(Body body, const Vec3& p_S) {
  if (body == Body::rail) return {p_S.x(), p_S.y(), -p_S.z()};
  return {std::atan2(p_S.x(), p_S.z()), p_S.y(), std::hypot(p_S.x(), p_S.z())};
}

/// The direction (across, out) of a section at station u, in the surface frame.
inline Vec3 direction(Body body, double u, const Vec2& across_out) {
  if (body == Body::rail) return {0.0, across_out.x(), -across_out.y()};
  return {across_out.y() * std::sin(u), across_out.x(), across_out.y() * std::cos(u)};
}

/// Inverse of natural().
inline Vec3 from_natural(Body body, const Natural& n) {
  return Vec3(body == Body::rail ? n.u : 0.0, 0.0, 0.0) + direction(body, n.u, {n.y, n.v});
}

}  // namespace treadmark::scans
