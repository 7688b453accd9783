// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace treadmark::damage {

/// A broken line through points, x increasing; straight on behind the last one, level before the first.
inline double on_line(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  const auto above = std::ranges::upper_bound(x, at);
  const auto k = std::min(static_cast<std::size_t>(above - x.begin()), x.size() - 1);
  return y[k - 1] + (at - x[k - 1]) * (y[k] - y[k - 1]) / (x[k] - x[k - 1]);
}

}  // namespace treadmark::damage
