// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "treadmark/app/import/layout_line.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark::app {

double place_along(const LineFrames& line, const Vec3& point, double near) {
  constexpr int kRounds = 50;
  constexpr double kStill = 1e-10;  // [m]
  double along = near;
  // steps of the distance itself shrink by what the curve takes of it: less than a tenth for points of a rail
  for (int round = 0; round < kRounds; ++round) {
    const double step = line(along).apply_inverse(point).x();
    along += step;
    if (!std::isfinite(along)) return kNaN;
    if (std::fabs(step) < kStill * (1.0 + std::fabs(along))) return along;
  }
  return kNaN;
}

}  // namespace treadmark::app
