// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/core/surface.hpp"

namespace treadmark::spline {

/// Closed interval for conservative bounds.
struct Interval {
  double low, high;

  double width() const { return high - low; }
  bool overlaps(const Interval& other) const { return low <= other.high && other.low <= high; }
  void include(const Interval& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  friend Interval operator+(const Interval& a, const Interval& b) { return {a.low + b.low, a.high + b.high}; }
  friend Interval operator+(const Interval& a, double shift) { return {a.low + shift, a.high + shift}; }
  friend Interval operator*(double factor, const Interval& a) {
    return factor >= 0.0 ? Interval{factor * a.low, factor * a.high} : Interval{factor * a.high, factor * a.low};
  }
  static Interval none() { return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}; }
  bool empty() const { return !(low <= high); }
};

/// Bounds are meant for real numbers; this covers the rounding of their own evaluation and the slack at edges [m].
inline Interval widened(double low, double high) {
  constexpr double kSlack = 1e-9;
  return {low - kSlack, high + kSlack};
}

/// Least and greatest |x|.
inline Interval magnitude(const Interval& a) {
  const double low = a.low > 0.0 ? a.low : a.high < 0.0 ? -a.high : 0.0;
  return {low, std::max(std::abs(a.low), std::abs(a.high))};
}

/// Range of the heights of all leaves of a tree of boxes, by branch and bound: one end, then the other, the most
/// promising child first; a box that widens the range by a small part only is taken as it is.
/// Tree: Node; kMostChildren; children(node, visit(child, heights)), in which it leaves out boxes that are not over the
/// window; is_leaf(node); leaf(node): heights, may be empty.
template <class Tree>
class BoundSearch {
 public:
  /// facing: the end towards the other body is found closely, the other end roughly.
  BoundSearch(const Tree& tree, Facing facing)
      : tree_(tree),
        room_low_(facing == Facing::up ? kClose : kRough),
        room_high_(facing == Facing::up ? kRough : kClose) {}

  Interval range(const typename Tree::Node& root) {
    // The close end first: the range found with it serves the other.
    if (room_low_ < room_high_) {
      descend<true>(root);
      descend<false>(root);
    } else {
      descend<false>(root);
      descend<true>(root);
    }
    return {found_low_, found_high_};
  }

 private:
  static constexpr double kClose = 0.15, kRough = 0.5;  // of the range

  struct Candidate {
    Interval heights;
    typename Tree::Node node;
  };

  // Whether the boxes add nothing to that end.
  template <bool low>
  bool settled(const Interval& n) {
    const double room = (low ? room_low_ : room_high_) * std::max(0.0, sure_.width());
    if constexpr (low) {
      if (n.low >= found_low_) return true;
      if (n.low < sure_.low - room) return false;
      found_low_ = n.low;
    } else {
      if (n.high <= found_high_) return true;
      if (n.high > sure_.high + room) return false;
      found_high_ = n.high;
    }
    return true;
  }

  void include(const Interval& n) {
    if (n.empty()) return;
    sure_.include(n);
    found_low_ = std::min(found_low_, n.low);
    found_high_ = std::max(found_high_, n.high);
  }

  template <bool low>
  void descend(const typename Tree::Node& node) {
    std::array<Candidate, Tree::kMostChildren> candidates;
    std::size_t count = 0, best = 0;
    tree_.children(node, [&](const typename Tree::Node& child, const Interval& heights) {
      if (low ? heights.low >= found_low_ : heights.high <= found_high_) return;
      if (count > 0 && before<low>(heights, candidates[best].heights)) best = count;
      candidates[count++] = {heights, child};
    });
    if (count == 0) return;
    std::swap(candidates[0], candidates[best]);
    for (std::size_t i = 0; i < count; ++i) {
      if (settled<low>(candidates[i].heights)) continue;
      if (tree_.is_leaf(candidates[i].node))
        include(tree_.leaf(candidates[i].node));
      else
        descend<low>(candidates[i].node);
    }
  }

  template <bool low>
  static bool before(const Interval& a, const Interval& b) {
    return low ? a.low < b.low : a.high > b.high;
  }

  const Tree& tree_;
  double room_low_, room_high_;
  Interval sure_ = Interval::none();
  double found_low_ = Interval::none().low, found_high_ = Interval::none().high;
};

}  // namespace treadmark::spline
