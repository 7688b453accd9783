// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark {

/// Arc length of the place nearest to a point on the line through points (y, z) of arc lengths s, two at least [m].
inline double arc_at(std::span<const double> s, std::span<const double> y, std::span<const double> z,
                     const Vec2& point) {
  double arc = s.front(), least = kInfinity;
  for (std::size_t i = 1; i < y.size(); ++i) {
    const Vec2 from(y[i - 1], z[i - 1]), along = Vec2(y[i], z[i]) - from, to = point - from;
    const double t = std::clamp(to.dot(along) / std::max(along.squaredNorm(), 1e-30), 0.0, 1.0);
    if (const double d = (to - t * along).norm(); d < least) least = d, arc = s[i - 1] + t * (s[i] - s[i - 1]);
  }
  return arc;
}

}  // namespace treadmark
