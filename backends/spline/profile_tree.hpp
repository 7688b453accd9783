// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/profile_hull.hpp"
#include "treadmark/backends/spline/slice_bounds.hpp"

namespace treadmark::spline {

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
