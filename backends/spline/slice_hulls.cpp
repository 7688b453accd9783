// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slice_hulls.hpp"

#include <limits>

namespace treadmark::spline {

SliceHulls::SliceHulls(const SliceNet& net)
    : cells_(static_cast<std::size_t>(net.cells())), coarse_per_group_((cells_ + kCellsPerGroup - 1) / kCellsPerGroup),
      spans_(net.spans()) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto spans = static_cast<std::size_t>(net.spans());
  for (std::size_t first = 0; first < spans; first += kSpansPerGroup) {
    const std::size_t end = std::min(spans, first + kSpansPerGroup);
    Interval u{net.span_start(static_cast<int>(first)), net.span_end(static_cast<int>(end) - 1)};
    if (!net.closed() && first == 0) u.low = -kInfinite;
    if (!net.closed() && end == spans) u.high = kInfinite;
    u_.push_back(u);
    const std::size_t group = coarse_.size();
    coarse_.resize(group + coarse_per_group_);
    for (std::size_t cell = 0; cell < cells_; ++cell) {
      Box box;
      for (std::size_t span = first; span < end; ++span) {
        Box part;
        if (net.hull(static_cast<int>(span), static_cast<int>(cell), net.span_start(static_cast<int>(span)),
                     net.span_end(static_cast<int>(span)), part.y, part.w)) box.include(part);
      }
      fine_.push_back(box);
      coarse_[group + cell / kCellsPerGroup].include(box);
      all_.include(box);
    }
  }
}

}  // namespace treadmark::spline
