// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <vector>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/backends/spline/slices/slice_bounds.hpp"

namespace treadmark::spline {

/// Bezier points of a planar cubic; the curve lies in their convex hull.
struct BezierCubic {
  std::array<Vec2, 4> points;

  /// From power coefficients on [0, h].
  BezierCubic(const CubicSegment& segment, double h) {
    const Vec2 c0(segment.y[0], segment.z[0]), c1(segment.y[1] * h, segment.z[1] * h);
    const Vec2 c2(segment.y[2] * h * h, segment.z[2] * h * h), c3(segment.y[3] * h * h * h, segment.z[3] * h * h * h);
    points = {c0, c0 + c1 / 3.0, c0 + (2.0 * c1 + c2) / 3.0, c0 + c1 + c2 + c3};
  }
  explicit BezierCubic(const std::array<Vec2, 4>& control_points) : points(control_points) {}

  /// Range of direction . point.
  Interval range(const Vec2& direction) const {
    Interval r = Interval::none();
    for (const Vec2& point : points) {
      const double x = direction.dot(point);
      r.include({x, x});
    }
    return r;
  }

  /// Both halves (de Casteljau).
  std::array<BezierCubic, 2> halves() const {
    const Vec2 a = 0.5 * (points[0] + points[1]), b = 0.5 * (points[1] + points[2]), c = 0.5 * (points[2] + points[3]);
    const Vec2 d = 0.5 * (a + b), e = 0.5 * (b + c), f = 0.5 * (d + e);
    return {BezierCubic({points[0], a, d, f}), BezierCubic({f, e, c, points[3]})};
  }
};

/// A pyramid of boxes around the segments of a profile; each box holds kBranch of the level below.
class ProfileHulls {
 public:
  static constexpr int kBranch = 8;

  explicit ProfileHulls(const ProfileSpline& profile);

  const std::vector<std::vector<HullBox>>& levels() const { return levels_; }
  std::size_t memory_bytes() const;

 private:
  std::vector<std::vector<HullBox>> levels_;
};

/// The pyramid as seen through a window, for BoundSearch. Window: heights(y, z) of a box, empty if it is not over the
/// window; small(y, z): no use in halving it.
template <class Window>
class ProfileTree {
 public:
  struct Node {
    int level, index;
  };
  static constexpr std::size_t kMostChildren = ProfileHulls::kBranch;

  ProfileTree(const Window& window, const ProfileSpline& profile, const ProfileHulls& hulls)
      : window_(window), profile_(profile), hulls_(hulls) {}

  Node root() const { return {static_cast<int>(hulls_.levels().size()), 0}; }
  static bool is_leaf(const Node& node) { return node.level == 0; }

  template <class Visit>
  void children(const Node& node, const Visit& visit) const {
    const std::vector<HullBox>& below = hulls_.levels()[static_cast<std::size_t>(node.level) - 1];
    const int last = std::min(static_cast<int>(below.size()), (node.index + 1) * ProfileHulls::kBranch);
    for (int i = node.index * ProfileHulls::kBranch; i < last; ++i) {
      const HullBox& box = below[static_cast<std::size_t>(i)];
      const Interval n = window_.heights({static_cast<double>(box.y), static_cast<double>(box.half_y)},
                                         {static_cast<double>(box.w), static_cast<double>(box.half_w)});
      if (!n.empty()) visit(Node{node.level - 1, i}, n);
    }
  }

  Interval leaf(const Node& node) const {
    const auto k = static_cast<std::size_t>(node.index);
    Interval n = Interval::none();
    add(BezierCubic(profile_.segments()[k], profile_.breaks()[k + 1] - profile_.breaks()[k]), 0, n);
    return n;
  }

 private:
  void add(const BezierCubic& curve, int halvings, Interval& n) const {
    constexpr int kMostHalvings = 8;
    const Range y(curve.range({1.0, 0.0})), z(curve.range({0.0, 1.0}));
    const Interval part = window_.heights(y, z);
    if (part.empty()) return;
    if (halvings < kMostHalvings && !window_.small(y, z)) {
      for (const BezierCubic& half : curve.halves()) add(half, halvings + 1, n);
      return;
    }
    n.include(part);
  }

  const Window& window_;
  const ProfileSpline& profile_;
  const ProfileHulls& hulls_;
};

/// The segments that may lie over the window, increasing.
template <class Window>
void segments_over(const ProfileTree<Window>& tree, std::vector<int>& segments) {
  using Tree = ProfileTree<Window>;
  segments.clear();
  const auto descend = [&](const auto& self, const typename Tree::Node& node) -> void {
    tree.children(node, [&](const typename Tree::Node& child, const Interval&) {
      if (Tree::is_leaf(child))
        segments.push_back(child.index);
      else
        self(self, child);
    });
  };
  descend(descend, tree.root());
}

}  // namespace treadmark::spline
