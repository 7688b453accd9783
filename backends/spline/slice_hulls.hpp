// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/slice_net.hpp"

namespace treadmark::spline {

/// Boxes of (y, w) around parts of a slice net, from control points, in two levels: groups of u-spans by single v-cells,
/// and by groups of cells. Empty intervals where there is no surface. Also bounds of derivatives.
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

  /// Bounds of derivatives (u in its unit, v in cells), greatest of both fields.
  struct Twist {
    float uuu = 0.0F, uuv = 0.0F, uuvv = 0.0F, uvv = 0.0F, uvvv = 0.0F, vv = 0.0F, vvv = 0.0F;
  };

  explicit SliceHulls(const SliceNet& net);

  /// Over a cell and the group of spans that holds the span.
  const Twist& twist(int span, int cell) const {
    return twist_[static_cast<std::size_t>(span) / kSpansPerGroup * cells_ + static_cast<std::size_t>(cell)];
  }

  const Box& all() const { return all_; }
  std::size_t memory_bytes() const { return (fine_.size() + coarse_.size()) * sizeof(Box) + twist_.size() * sizeof(Twist) + u_.size() * sizeof(Interval); }

  /// Spans of a group: first_span(group) .. first_span(group + 1) - 1.
  int first_span(std::size_t group) const {
    return group < u_.size() ? static_cast<int>(group * kSpansPerGroup) : spans_;
  }
  /// u of a span; the outer ones of a rail go on for ever.
  Interval span_range(const SliceNet& net, int span) const {
    return {span == 0 ? u_.front().low : net.span_start(span), span + 1 == spans_ ? u_.back().high : net.span_end(span)};
  }

  /// For all groups of spans with wanted_u(interval): calls visit(box, group, -1) for every group of cells, and, where that
  /// returns true, visit(box, group, cell) for each cell of it.
  template <class WantedU, class Visit>
  void visit(const WantedU& wanted_u, const Visit& visit) const {
    for (std::size_t g = 0; g < u_.size(); ++g) {
      if (!wanted_u(u_[g])) continue;
      for (std::size_t c = 0; c < coarse_per_group_; ++c) {
        const Box& coarse = coarse_[g * coarse_per_group_ + c];
        if (coarse.empty() || !visit(coarse, g, -1)) continue;
        const std::size_t end = std::min(cells_, (c + 1) * kCellsPerGroup);
        for (std::size_t k = c * kCellsPerGroup; k < end; ++k)
          if (const Box& fine = fine_[g * cells_ + k]; !fine.empty()) visit(fine, g, static_cast<int>(k));
      }
    }
  }

 private:
  static constexpr std::size_t kSpansPerGroup = 4, kCellsPerGroup = 16;

  std::size_t cells_, coarse_per_group_;
  int spans_;
  std::vector<Interval> u_;  // of each group of spans
  std::vector<Box> fine_, coarse_;
  std::vector<Twist> twist_;
  Box all_;
};

}  // namespace treadmark::spline
