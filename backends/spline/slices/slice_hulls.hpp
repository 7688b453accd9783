// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/slices/slice_net.hpp"

namespace treadmark::spline {

/// Ranges of (y, w) by middle and half width, rounded outwards; half_y < 0: empty.
struct HullBox {
  float y = 0.0F, w = 0.0F, half_y = -1.0F, half_w = -1.0F;

  HullBox() = default;
  HullBox(const Interval& range_y, const Interval& range_w);
  bool empty() const { return half_y < 0.0F; }
  Interval range_y() const {
    return {static_cast<double>(y) - static_cast<double>(half_y), static_cast<double>(y) + static_cast<double>(half_y)};
  }
  Interval range_w() const {
    return {static_cast<double>(w) - static_cast<double>(half_w), static_cast<double>(w) + static_cast<double>(half_w)};
  }
};

/// A pyramid of boxes of (y, w) around parts of a slice net, from control points. The finest boxes hold a group of
/// u-spans and one v-cell; every box of a level above holds several of the level below. Also bounds of derivatives.
class SliceHulls {
 public:
  static constexpr int kSpansPerGroup = 4;

  struct Level {
    int rows = 0, columns = 0;              ///< along u and v
    int rows_below = 1, columns_below = 1;  ///< of the level below in one box
    std::vector<Interval> u;                ///< of each row; the outer ones of a rail go on for ever
    std::vector<HullBox> boxes;             ///< by rows
    const HullBox& box(int row, int column) const {
      return boxes[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
    }
  };

  explicit SliceHulls(const SliceNet& net);

  /// Bounds of derivatives over a cell and the group of spans that holds the span, `which` after another, `stride`
  /// apart; u in its unit, v in cells, greatest of both fields: uuu, uuv, uuvv, uvv, uvvv, vvv, vv.
  const float* twist(int span, int cell) const {
    return twist_.data() + static_cast<std::size_t>(span / kSpansPerGroup) * 7 * stride_ +
           static_cast<std::size_t>(cell);
  }
  long twist_stride() const { return static_cast<long>(stride_); }

  bool empty() const { return !(all_y_.low <= all_y_.high); }
  const Interval& all_y() const { return all_y_; }
  const Interval& all_w() const { return all_w_; }
  const HullBox& all() const { return all_; }
  std::size_t memory_bytes() const;

  /// From the finest (rows: groups of spans, columns: cells) to the coarsest.
  const std::vector<Level>& levels() const { return levels_; }
  /// Spans of a group: first_span(group) .. first_span(group + 1) - 1.
  int first_span(int group) const { return std::min(group * kSpansPerGroup, spans_); }
  /// u of a span; the outer ones of a rail go on for ever.
  Interval span_range(const SliceNet& net, int span) const {
    const std::vector<Interval>& u = levels_.front().u;
    return {span == 0 ? u.front().low : net.span_start(span), span + 1 == spans_ ? u.back().high : net.span_end(span)};
  }

 private:
  std::size_t stride_;
  int spans_;
  std::vector<Level> levels_;
  std::vector<float> twist_;
  Interval all_y_ = Interval::none(), all_w_ = Interval::none();
  HullBox all_;
};

}  // namespace treadmark::spline
