// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <functional>
#include <limits>

#include "treadmark/core/pose.hpp"

namespace treadmark::testing {

/// > 0 outside of the material, < 0 inside, NaN where there is nothing.
using Outside = std::function<double(const Vec3&)>;

/// Height of the outermost sign change along the normal of a plane, in fine steps and by bisection; NaN if there is
/// none. wheel: from above along -z, else from below along +z. slant: cosine between line and normal there.
struct Crossing {
  double z = std::numeric_limits<double>::quiet_NaN(), slant = 0.0;
  Vec3 gradient = Vec3::Zero();
};

inline Crossing first_crossing(const Outside& outside, const Pose& X, double x, double y, bool wheel, double reach,
                               double step) {
  const auto f = [&](double t) { return outside(X.apply({x, y, wheel ? -t : t})); };
  double before = f(-reach);
  for (double t = -reach + step; t < reach; t += step) {
    const double now = f(t);
    if ((before > 0.0 && now <= 0.0)) {
      double a = t - step, b = t;
      for (int k = 0; k < 60; ++k) {
        const double m = 0.5 * (a + b);
        (f(m) > 0.0 ? a : b) = m;
      }
      Crossing hit;
      hit.z = wheel ? -b : b;
      const Vec3 p = X.apply({x, y, hit.z});
      for (int k = 0; k < 3; ++k) {
        const Vec3 e = Vec3::Unit(k) * 1e-7;
        hit.gradient[k] = (outside(p + e) - outside(p - e)) / 2e-7;
      }
      hit.slant = std::fabs(hit.gradient.normalized().dot(X.rotation.col(2)));
      return hit;
    }
    before = now;
  }
  return {};
}

}  // namespace treadmark::testing
