// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::displacement {

/// Natural coordinates of a point of the surface frame and the direction e in which offsets act: e_z at x, y of a rail,
/// e_r at theta, y of a wheel. Moving a point along e changes neither u nor y.
struct NaturalPoint {
  double y = 0.0;
  double r = 1.0;              ///< wheel: distance from the axle [m]
  Vec3 e = Vec3::UnitZ();      ///< direction of the offset
  Vec3 along = Vec3::UnitX();  ///< unit direction of growing u
  double du_along = 1.0;       ///< |grad u|: 1, or 1/r
  double de_along = 0.0;       ///< de/dq = de_along * along * along^T: 0, or 1/r

  NaturalPoint() = default;
  NaturalPoint(Body body, const Vec3& q_S) : y(q_S.y()), x_(q_S.x()) {
    if (body == Body::rail) return;
    r = std::sqrt(q_S.x() * q_S.x() + q_S.z() * q_S.z());
    const double sin = q_S.x() / r, cos = q_S.z() / r;
    e = {sin, 0.0, cos};
    along = {cos, 0.0, -sin};
    du_along = de_along = 1.0 / r;
  }

  double u() const { return de_along == 0.0 ? x_ : std::atan2(e.x(), e.z()); }

  /// Gradient at q of B(q - d e), from the gradient M of B and the offset d with its derivatives.
  Vec3 pull_back(const Vec3& M, double d, double d_u, double d_y) const {
    const double Me = M.dot(e), Ma = M.dot(along);
    Vec3 g = M - along * (d_u * du_along * Me + d * de_along * Ma);
    g.y() -= d_y * Me;
    return g;
  }

 private:
  double x_ = 0.0;
};

}  // namespace treadmark::displacement
