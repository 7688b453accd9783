// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::app {

/// How much lower than a sound wheel a damaged one lies over the track. A wheel of which no sound shape is known, as
/// one that was measured all around, is compared with itself half a turn later. Safe to use from any number of threads.
class DefectDepth {
 public:
  /// sound: null where it is not known.
  DefectDepth(std::shared_ptr<const Surface> wheel, std::shared_ptr<const Surface> sound)
      : wheel_(std::move(wheel)), sound_(std::move(sound)) {}

  /// Depths along z of the track at the points of a grid in the track's plane, positive where material is gone [m]; NaN
  /// beside the wheel. placement: as wheelrail::Pair gives it, that of a left-hand pair in true axes.
  std::vector<double> over(const Grid2& grid_T, const wheelrail::Placement& placement, wheelrail::Side side) const;

 private:
  std::shared_ptr<const Surface> wheel_, sound_;
};

}  // namespace treadmark::app
