// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/spline/profile_tree.hpp"

namespace treadmark::spline {

ProfileHulls::ProfileHulls(const ProfileSpline& profile) {
  std::vector<HullBox> finest;
  for (std::size_t k = 0; k < profile.segments().size(); ++k) {
    const BezierCubic points(profile.segments()[k], profile.breaks()[k + 1] - profile.breaks()[k]);
    finest.emplace_back(points.range({1.0, 0.0}), points.range({0.0, 1.0}));
  }
  levels_.push_back(std::move(finest));
  while (levels_.back().size() > kBranch) {
    std::vector<HullBox> level;
    for (std::size_t first = 0; first < levels_.back().size(); first += kBranch) {
      Interval y = Interval::none(), z = Interval::none();
      for (std::size_t i = first; i < std::min(levels_.back().size(), first + kBranch); ++i) {
        y.include(levels_.back()[i].range_y());
        z.include(levels_.back()[i].range_w());
      }
      level.emplace_back(y, z);
    }
    levels_.push_back(std::move(level));
  }
}

std::size_t ProfileHulls::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& level : levels_) bytes += level.size() * sizeof(HullBox);
  return bytes;
}

}  // namespace treadmark::spline
