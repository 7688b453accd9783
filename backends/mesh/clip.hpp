// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "treadmark/core/pose.hpp"

namespace treadmark::mesh {

/// Least and greatest z of the part of a triangle over the rectangle round (x, y); nothing if it lies beside.
inline std::optional<std::pair<double, double>> heights_over(const std::array<Vec3, 3>& triangle, double x, double y,
                                                             double half_x, double half_y) {
  // one side after the other cuts off what lies beyond it (Sutherland & Hodgman 1974); each adds at most one corner
  std::array<Vec3, 8> corners, kept;
  std::size_t count = 3;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = triangle[k] - Vec3(x, y, 0.0);
  const auto cut = [&](int axis, double sign, double half) {
    std::size_t n = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 &a = corners[k], &b = corners[(k + 1) % count];
      const double beyond_a = sign * a[axis] - half, beyond_b = sign * b[axis] - half;
      if (beyond_a <= 0.0) kept[n++] = a;
      if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0))
        kept[n++] = a + (b - a) * (beyond_a / (beyond_a - beyond_b));
    }
    corners = kept;
    count = n;
  };
  cut(0, 1.0, half_x);
  cut(0, -1.0, half_x);
  cut(1, 1.0, half_y);
  cut(1, -1.0, half_y);
  if (count == 0) return std::nullopt;
  double low = corners[0].z(), high = low;
  for (std::size_t k = 1; k < count; ++k) low = std::min(low, corners[k].z()), high = std::max(high, corners[k].z());
  return std::pair(low, high);
}

}  // namespace treadmark::mesh
