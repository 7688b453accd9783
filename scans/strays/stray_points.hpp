// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

enum class Stray : std::uint8_t {
  no,
  outlier,  ///< much farther from its neighbours than points usually are
  cluster,  ///< part of a group of points apart from the large ones
};

/// All lengths in the unit of the points; 0 = from the data.
struct StraySettings {
  int neighbours = 12;  ///< of the distance that is judged
  double outlier_distance =
      0.0;  ///< mean distance to the neighbours beyond which a point is an outlier; 0 = 4 times its median
  double cluster_gap = 0.0;     ///< groups farther apart are different clusters; 0 = 6 times the median spacing
  double least_cluster = 0.01;  ///< clusters with fewer points than this part of the largest one are stray
};

struct StrayResult {
  std::vector<Stray> of_point;
  double spacing = 0.0;  ///< median over the points of the mean distance to the six nearest ones
  std::size_t outliers = 0, cluster_points = 0, clusters = 0;  ///< clusters: stray ones
};

/// Points that belong to no large connected surface, among points thinned to an even spacing (about 10^5 to 10^6 of
/// them). Outliers are found first and bridge no gaps between clusters; a surface in several large parts is kept.
/// Deterministic, and independent of the order of the points. Errors: Error(input_data) for fewer than 100 points, ones
/// that are not finite, or most of them equal; Error(configuration) for settings that mean nothing.
StrayResult find_strays(std::span<const Vec3> points, const StraySettings& settings);

}  // namespace treadmark::scans
