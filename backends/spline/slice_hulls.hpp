// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/slice_net.hpp"

namespace treadmark::spline {

/// Boxes of (y, w) around parts of a slice net, from control points, in two levels: groups of u-spans by single v-cells,
/// and by groups of cells. Empty intervals where there is no surface.
class SliceHulls {
 public:
  struct Box {
    Interval y = Interval::none(), w = Interval::none();
    bool empty() const { return y.empty(); }
    void include(const Box& other) {
      y.include(other.y);
      w.include(other.w);
    }
  };

  explicit SliceHulls(const SliceNet& net);

  const Box& all() const { return all_; }
  std::size_t memory_bytes() const { return (fine_.size() + coarse_.size()) * sizeof(Box) + u_.size() * sizeof(Interval); }

  /// Calls visit(box) for the boxes of all parts whose u overlaps one for which wanted_u(interval) holds; visit returns true
  /// for a group of cells to be asked again for each cell.
  template <class WantedU, class Visit>
  void visit(const WantedU& wanted_u, const Visit& visit) const {
    for (std::size_t g = 0; g < u_.size(); ++g) {
      if (!wanted_u(u_[g])) continue;
      for (std::size_t c = 0; c < coarse_per_group_; ++c) {
        const Box& coarse = coarse_[g * coarse_per_group_ + c];
        if (coarse.empty() || !visit(coarse, false)) continue;
        const std::size_t end = std::min(cells_, (c + 1) * kCellsPerGroup);
        for (std::size_t k = c * kCellsPerGroup; k < end; ++k)
          if (const Box& fine = fine_[g * cells_ + k]; !fine.empty()) visit(fine, true);
      }
    }
  }

 private:
  static constexpr std::size_t kSpansPerGroup = 4, kCellsPerGroup = 16;

  std::size_t cells_, coarse_per_group_;
  std::vector<Interval> u_;  // of each group of spans
  std::vector<Box> fine_, coarse_;
  Box all_;
};

}  // namespace treadmark::spline
