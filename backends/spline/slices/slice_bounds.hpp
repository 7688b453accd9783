// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstring>
#include <numbers>
#include <type_traits>
#include <vector>

#include "treadmark/backends/spline/slices/slice_geometry.hpp"
#include "treadmark/backends/spline/slices/slice_hulls.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// A rectangle of a plane, by its ranges across and along the grid lines that suit the plane. axes: unit vectors in the
/// surface frame.
struct PlaneWindow {
  Vec3 across_axis, along_axis, normal, origin;
  Interval across, along;
};

/// A range by its middle and half width: sums need no case distinctions.
struct Range {
  double middle, half;
  explicit Range(const Interval& a) : middle(0.5 * (a.low + a.high)), half(0.5 * (a.high - a.low)) {}
  Range(double at, double reach) : middle(at), half(reach) {}
  Interval interval() const { return {middle - half, middle + half}; }
  bool overlaps(const Range& other) const { return std::abs(middle - other.middle) <= half + other.half; }
};

/// What boxes around parts of a rail may have to do with a window; all answers are conservative.
class RailWindow {
 public:
  explicit RailWindow(const PlaneWindow& window);

  bool exists() const { return exists_; }  ///< false: the plane has no lines that suit
  Interval u(const Range& y, const Range& w) const {
    return u_.of(y, w).interval();
  }  ///< that the window can see of the box
  /// Heights of the box over the window, empty if it is not.
  Interval heights(const Range& y, const Range& w) const {
    return s_.of(y, w).overlaps(along_) ? n_.of(y, w).interval() : Interval::none();
  }
  Range along_of(const Range& y, const Range& w) const { return s_.of(y, w); }
  /// Turns to be added to u.
  static constexpr int kTurns = 0;

 private:
  // A linear function of (y, w), known up to half.
  struct Linear {
    double at_zero, half, by_y, by_w;
    Range of(const Range& y, const Range& w) const {
      return {at_zero + by_y * y.middle + by_w * w.middle, half + std::abs(by_y) * y.half + std::abs(by_w) * w.half};
    }
  };
  bool exists_;
  Linear u_{}, s_{}, n_{};
  Range along_;
};

/// The same for a wheel.
class WheelWindow {
 public:
  explicit WheelWindow(const PlaneWindow& window);

  bool exists() const { return true; }
  Interval u(const Range& y, const Range& r) const;
  Interval heights(const Range& y, const Range& r) const {
    const Range b = b_of(y, r);
    if (b.half < 0.0 || !s_.of(y, b).overlaps(along_)) return Interval::none();
    return n_.of(y, b).interval();
  }
  Range along_of(const Range& y, const Range& r) const { return s_.of(y, b_of(y, r)); }
  static constexpr int kTurns = 2;

 private:
  // half < 0: out of reach
  Range b_of(const Range& y, const Range& r) const {
    const Range a = a_of(y);
    const double size = std::abs(a.middle), far = size + a.half, near = std::max(0.0, size - a.half);
    const double r_high = r.middle + r.half, r_low = r.middle - r.half;
    if (near > r_high) return {0.0, -1.0};
    return Range(Interval{std::sqrt(std::max(0.0, r_low * r_low - far * far)),
                          std::sqrt(std::max(0.0, r_high * r_high - near * near))});
  }
  // Linear in y and b, after a has been put in.
  struct Linear {
    double at_zero, half, by_y, by_b;
    Range of(const Range& y, const Range& b) const {
      return {at_zero + by_y * y.middle + by_b * b.middle, half + std::abs(by_y) * y.half + std::abs(by_b) * b.half};
    }
  };
  Range a_of(const Range& y) const { return {a_.at_zero + a_.by_y * y.middle, a_.half + std::abs(a_.by_y) * y.half}; }

  Linear a_{}, s_{}, n_{};
  Range along_;
  double sense_, u_middle_;
};

template <class Geometry>
using WindowOn = std::conditional_t<std::is_same_v<Geometry, WheelGeometry>, WheelWindow, RailWindow>;

/// The pyramid of boxes as seen through a window, for BoundSearch.
template <class Window>
class SliceTree {
 public:
  struct Node {
    int level, row, column;
    double turn;  // to be added to the window's u
  };
  static constexpr std::size_t kMostChildren = 48;  // the root's in every turn, else 4 x 4 or 8

  SliceTree(const Window& window, const SliceNet& net, const SliceHulls& hulls)
      : window_(window), net_(net), hulls_(hulls) {}

  Node root() const { return {static_cast<int>(hulls_.levels().size()), 0, 0, 0.0}; }
  static bool is_leaf(const Node& node) { return node.level == 0; }

  /// skip(child): whether nobody wants to know of it.
  template <class Visit>
  void children(const Node& node, const Visit& visit) const {
    children(node, visit, [](const Node&) { return false; });
  }
  template <class Visit, class Skip>
  void children(const Node& node, const Visit& visit, const Skip& skip) const {
    const auto level_count = static_cast<int>(hulls_.levels().size());
    const SliceHulls::Level& below = hulls_.levels()[static_cast<std::size_t>(node.level) - 1];
    if (node.level == level_count) {
      const Interval u = window_.u(range_y(hulls_.all()), range_w(hulls_.all()));
      for (int turn = -Window::kTurns; turn <= Window::kTurns; ++turn)
        boxes(below, node.level - 1, u, turn * 2.0 * std::numbers::pi, 0, below.rows, 0, below.columns, visit, skip);
      return;
    }
    const SliceHulls::Level& level = hulls_.levels()[static_cast<std::size_t>(node.level)];
    const HullBox& box = level.box(node.row, node.column);
    const int row = node.row * level.rows_below, column = node.column * level.columns_below;
    boxes(below, node.level - 1, window_.u(range_y(box), range_w(box)), node.turn, row,
          std::min(below.rows, row + level.rows_below), column, std::min(below.columns, column + level.columns_below),
          visit, skip);
  }

  /// Only what the window sees of each span.
  Interval leaf(const Node& node) const {
    Interval heights = Interval::none();
    const HullBox& box = hulls_.levels().front().box(node.row, node.column);
    const Range y = range_y(box), w = range_w(box);
    const Interval u = window_.u(y, w) + node.turn, row = hulls_.levels().front().u[static_cast<std::size_t>(node.row)];
    if (u.low <= row.low && u.high >= row.high) return window_.heights(y, w);
    for (int span = hulls_.first_span(node.row); span < hulls_.first_span(node.row + 1); ++span) {
      const Interval all = hulls_.span_range(net_, span), part{std::max(u.low, all.low), std::min(u.high, all.high)};
      if (part.empty()) continue;
      Interval seen_y, seen_w;
      if (!net_.hull(span, node.column, part.low, part.high, seen_y, seen_w)) continue;
      if (const Interval n = window_.heights(Range(seen_y), Range(seen_w)); !n.empty()) heights.include(n);
    }
    return heights;
  }

 private:
  static Range range_y(const HullBox& box) { return {static_cast<double>(box.y), static_cast<double>(box.half_y)}; }
  static Range range_w(const HullBox& box) { return {static_cast<double>(box.w), static_cast<double>(box.half_w)}; }

  template <class Visit, class Skip>
  void boxes(const SliceHulls::Level& level, int index, const Interval& u, double turn, int first_row, int last_row,
             int first_column, int last_column, const Visit& visit, const Skip& skip) const {
    for (int row = first_row; row < last_row; ++row) {
      if (!level.u[static_cast<std::size_t>(row)].overlaps(u + turn)) continue;
      for (int column = first_column; column < last_column; ++column) {
        const HullBox& box = level.box(row, column);
        const Node child{index, row, column, turn};
        if (box.empty() || skip(child)) continue;
        const Interval heights = window_.heights(range_y(box), range_w(box));
        if (!heights.empty()) visit(child, heights);
      }
    }
  }

  const Window& window_;
  const SliceNet& net_;
  const SliceHulls& hulls_;
};

/// Calls use(range along the lines, heights) for boxes that may be over the window: for one that is small and level
/// beside a length, else for the finest ones in it.
template <class Window, class Use>
void for_small_boxes(const Window& window, const SliceNet& net, const SliceHulls& hulls, double length,
                     const Use& use) {
  constexpr double kSmall = 0.25, kLevel = 0.05;
  using Tree = SliceTree<Window>;
  const Tree tree(window, net, hulls);
  const auto descend = [&](const auto& self, const typename Tree::Node& node) -> void {
    tree.children(node, [&](const typename Tree::Node& child, const Interval& heights) {
      const HullBox& box = hulls.levels()[static_cast<std::size_t>(child.level)].box(child.row, child.column);
      const Range y(box.range_y()), w(box.range_w()), s = window.along_of(y, w);
      if (!Tree::is_leaf(child) && (w.half > kLevel * length || s.half > kSmall * length)) return self(self, child);
      use(s.interval(), heights);
    });
  };
  descend(descend, tree.root());
}

/// Marks the cells that may lie over the window, and a few beside them where boxes of the second level count as a
/// whole: for a single line a cell costs less than its test.
template <class Window>
void mark_cells_over(const Window& window, const SliceNet& net, const SliceHulls& hulls, bool single_line,
                     std::vector<char>& marks) {
  if (!window.exists()) return;
  using Tree = SliceTree<Window>;
  const Tree tree(window, net, hulls);
  const auto& levels = hulls.levels();
  const int whole = single_line ? std::min(1, static_cast<int>(levels.size()) - 1) : 0;
  const auto width = static_cast<std::size_t>(whole == 0 ? 1 : levels[1].columns_below);
  const auto cells = static_cast<std::size_t>(levels.front().columns);
  const auto descend = [&](const auto& self, const typename Tree::Node& node) -> void {
    tree.children(
        node,
        [&](const typename Tree::Node& child, const Interval&) {
          if (child.level != whole) return self(self, child);
          const std::size_t first = static_cast<std::size_t>(child.column) * width;
          std::memset(marks.data() + first, 1, std::min(width, cells - first));
        },
        [&](const typename Tree::Node& child) {
          return child.level == whole && marks[static_cast<std::size_t>(child.column) * width];
        });
  };
  descend(descend, tree.root());
}

}  // namespace treadmark::spline
