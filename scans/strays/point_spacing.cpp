// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/point_spacing.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/median.hpp"
#include "treadmark/scans/strays/neighbours.hpp"

namespace treadmark::scans {

double median(std::vector<double> values) { return median_of(values); }

double median_spacing(std::span<const Vec3> points) {
  std::vector<double> spacing(points.size());
  for_each_neighbourhood(points, kSpacingNeighbours, [&](std::uint32_t i, std::span<const Neighbour> near) {
    double sum = 0.0;
    for (const Neighbour& n : near) sum += std::sqrt(n.squared_distance);
    spacing[i] = sum / static_cast<double>(near.size());
  });
  return median_of(spacing);
}

}  // namespace treadmark::scans
