// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

struct Neighbour {
  std::uint32_t index;
  double squared_distance;
};

/// Calls visit(i, the `count` points nearest to point i without itself, nearest first) for every point, on any thread;
/// fewer neighbours where there are no more points. Of equally near points the one with the lower index comes first,
/// except that which of them is the last one let in is unspecified but repeatable.
void for_each_neighbourhood(std::span<const Vec3> points, int count,
                            const std::function<void(std::uint32_t, std::span<const Neighbour>)>& visit);

}  // namespace treadmark::scans
