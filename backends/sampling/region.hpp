// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>

namespace treadmark::sampling {

/// The part of a surface that is sampled: u is x [m] of a rail, theta [rad] of a wheel; y [m].
/// A wheel's range of a whole turn or more, or an infinite one, means the closed wheel.
struct Region {
  double u_min = -std::numeric_limits<double>::infinity(), u_max = std::numeric_limits<double>::infinity();
  double y_min = -std::numeric_limits<double>::infinity(), y_max = std::numeric_limits<double>::infinity();
};

}  // namespace treadmark::sampling
