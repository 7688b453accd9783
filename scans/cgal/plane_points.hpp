// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Distinct points of a plane in an order of their own, by x, then y; what depends on this order alone does not depend
/// on the order of the input. On a cylinder the coordinates are whole numbers, so that a copy one period farther is
/// exact and looks to every predicate like its original.
struct PlanePoints {
  std::vector<Vec2> at;              ///< [units]; on a cylinder 0 <= x < period
  std::vector<std::uint32_t> input;  ///< index in the input; of equal points the first one
  double unit = 1.0;                 ///< length of 1
  double period = 0.0;               ///< [units], 0 = a plane
};

/// Errors: Error(input_data) for fewer than three points, points that are not finite or lie too far apart for the
/// period; Error(configuration) for a negative period.
PlanePoints plane_points(std::span<const Vec2> points, double period, const char* what);

/// For points that are all on a line, or fewer than three different ones.
[[noreturn]] void throw_on_a_line(const char* what);

}  // namespace treadmark::scans
