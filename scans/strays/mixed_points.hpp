// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "treadmark/model/shape/point_cloud.hpp"

namespace treadmark::scans {

struct MixedPoints {
  std::vector<std::uint8_t> of_point;  ///< 1: mixed
  std::size_t count = 0;
  bool in_order = false;  ///< points follow each other as the scanner saw them; else none are looked for
};

/// Points between two surfaces, which a scanner sees where its spot meets both, and the edges beside them: the step to
/// the point before or behind, one beam farther, leads along the beam (within 10 degrees) and is far longer than steps
/// along it usually are, and no more than three such steps follow each other, as on a surface that is seen at a grazing
/// angle. Needs the places of the scanner; points without are left. Deterministic.
MixedPoints find_mixed_points(const PointCloud& cloud);

}  // namespace treadmark::scans
