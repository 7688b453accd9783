// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/core/grid.hpp"

namespace treadmark {

/// Height offsets on a regular grid over a base surface: dz(x, y) on a rail, dr(theta, y) on a wheel [m].
/// Grid2's x is u (x [m] or theta [rad]), its y the profile coordinate y [m]; NaN = no data there (taken as no offset).
struct OffsetMap {
  std::string name;  ///< where it comes from, for messages
  Grid2 grid;
  std::vector<float> offset;  ///< row-major as every Grid2 field
};

}  // namespace treadmark
