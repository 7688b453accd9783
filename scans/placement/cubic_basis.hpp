// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>

namespace treadmark::scans {

/// Values of the four uniform cubic B-splines that are not zero at t in [0, 1) of an interval.
inline std::array<double, 4> cubic_basis(double t) {
  const double o = 1.0 - t;
  return {o * o * o / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0, (4.0 - 6.0 * o * o + 3.0 * o * o * o) / 6.0,
          t * t * t / 6.0};
}

}  // namespace treadmark::scans
