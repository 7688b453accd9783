// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

/// Radii of a round wheel at equal steps of its own y, and their slopes; NaN where it has none. Immutable.
struct SampledProfile {
  double first = 0.0, step = 0.0;  ///< [m]
  double angle = 0.0;              ///< where on the wheel [rad]
  std::vector<double> radius, slope;

  int count() const { return static_cast<int>(radius.size()); }
  double y(std::size_t i) const { return first + static_cast<double>(i) * step; }
};

/// At an angle [rad], from y = first on.
SampledProfile sample_profile(const Surface& wheel, double angle, double first, double step, int count);

/// The profile of a wheel that is round, or round but for some defects, as the contact locus wants it; null for others.
std::shared_ptr<const SampledProfile> whole_profile(const Surface& wheel);

}  // namespace treadmark::detection
