// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <limits>

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/backends/mesh/clip.hpp"

namespace treadmark::mesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = kBoxRounding;
constexpr std::size_t kDepth = 64;   ///< levels of the hierarchy: 32-bit numbers are halved

class Stack {
 public:
  void push(std::uint32_t node) { entries_[size_++] = node; }
  std::uint32_t pop() { return entries_[--size_]; }
  bool empty() const { return size_ == 0; }

 private:
  std::array<std::uint32_t, kDepth> entries_;
  std::size_t size_ = 0;
};

}  // namespace

/// The box of a node in the plane frame.
struct Bvh::Extent {
  Vec3 middle, half;
  Extent(const Node& node, const PlaneView& view)
      : middle(view.to_plane(Eigen::Map<const Vec3>(node.middle))),
        half(view.rotation.cwiseAbs().transpose() * Eigen::Map<const Vec3>(node.half)) {}
  bool over(double x, double y, double margin) const {
    return std::fabs(middle.x() - x) <= half.x() + margin && std::fabs(middle.y() - y) <= half.y() + margin;
  }
  double outermost(double side) const { return side * middle.z() + half.z() + kRounding; }
};

LineHit Bvh::outermost(const PlaneView& view, double x, double y) const {
  LineHit inside, beside;
  double depth = -kInfinity, depth_beside = -kInfinity;
  const auto better = [&](const LineHit& h, const LineHit& best, double best_depth) {
    const double d = view.side * h.z;
    if (std::fabs(d - best_depth) <= kSameHeight && h.cover != best.cover) return h.cover == Cover::front;
    return d > best_depth;
  };
  Stack stack;
  stack.push(0);
  ProjectedTriangle triangle;
  while (!stack.empty()) {
    const std::uint32_t i = stack.pop();
    const Node& node = nodes_[i];
    const Extent extent(node, view);
    if (!extent.over(x, y, kRimTolerance + kRounding) || extent.outermost(view.side) < depth) continue;
    if (node.right != 0) {
      stack.push(node.right);
      stack.push(i + 1);
      continue;
    }
    for (std::uint32_t k = node.begin; k < node.begin + node.count; ++k) {
      triangle.load(mesh_, view, order_[k]);
      const auto e = triangle.edges(x, y, view.side);
      const Cover cover = ProjectedTriangle::cover(e);
      if (cover != Cover::none) {
        const LineHit h = triangle.hit(e, cover);
        if (!better(h, inside, depth)) continue;
        inside = h;
        depth = view.side * h.z;
      } else if (inside.triangle == kNone) {
        const LineHit h = triangle.near_hit(x, y, view.side);
        if (h.triangle == kNone || !better(h, beside, depth_beside)) continue;
        beside = h;
        depth_beside = view.side * h.z;
      }
    }
  }
  return inside.triangle != kNone ? inside : beside;
}

bool Bvh::hides_others(const PlaneView& view, double x, double y, const LineHit& hit) const {
  constexpr double kApart = 1e-9;  // [m] neighbours of the hit give the same height
  Stack stack;
  stack.push(0);
  ProjectedTriangle triangle;
  while (!stack.empty()) {
    const std::uint32_t i = stack.pop();
    const Node& node = nodes_[i];
    if (!Extent(node, view).over(x, y, kRounding)) continue;
    if (node.right != 0) {
      stack.push(node.right);
      stack.push(i + 1);
      continue;
    }
    for (std::uint32_t k = node.begin; k < node.begin + node.count; ++k) {
      triangle.load(mesh_, view, order_[k]);
      const auto e = triangle.edges(x, y, view.side);
      if (order_[k] == hit.triangle || ProjectedTriangle::cover(e) != Cover::front) continue;
      if (view.side * (hit.z - triangle.hit(e, Cover::front).z) > kApart) return true;
    }
  }
  return false;
}

HeightBounds Bvh::bounds(const PlaneView& view, const Rectangle& r, double largest_margin,
                         const std::function<double(std::uint32_t)>& margin) const {
  const double x = 0.5 * (r.x_min + r.x_max), y = 0.5 * (r.y_min + r.y_max);
  constexpr double kMargin = kRimTolerance + kRounding;
  const double half_x = 0.5 * (r.x_max - r.x_min) + kMargin, half_y = 0.5 * (r.y_max - r.y_min) + kMargin;
  const Vec3 outwards = view.side * view.direction();
  double low = kInfinity, high = -kInfinity;
  Stack stack;
  stack.push(0);
  ProjectedTriangle triangle;
  while (!stack.empty()) {
    const std::uint32_t i = stack.pop();
    const Node& node = nodes_[i];
    const Extent extent(node, view);
    if (std::fabs(extent.middle.x() - x) > extent.half.x() + half_x ||
        std::fabs(extent.middle.y() - y) > extent.half.y() + half_y)
      continue;
    // a node that shows insides only, or that cannot widen the range
    double towards = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double o = outwards[static_cast<int>(k)];
      towards += std::max(o * static_cast<double>(node.normal_low[k]), o * static_cast<double>(node.normal_high[k]));
    }
    if (towards < 0.0) continue;
    const double reach = extent.half.z() + largest_margin + kRounding;
    if (extent.middle.z() - reach >= low && extent.middle.z() + reach <= high) continue;
    if (node.right != 0) {
      stack.push(node.right);
      stack.push(i + 1);
      continue;
    }
    for (std::uint32_t k = node.begin; k < node.begin + node.count; ++k) {
      triangle.load(mesh_, view, order_[k]);
      const auto e = triangle.edges(x, y, view.side);
      if (e[0] + e[1] + e[2] <= 0.0) continue;
      const auto range = heights_over(triangle.q, x, y, half_x, half_y);
      if (!range) continue;
      const double m = margin(order_[k]) + kRounding;
      low = std::min(low, range->first - m);
      high = std::max(high, range->second + m);
    }
  }
  if (low > high) return {0.0, 0.0, true};
  return {low, high, false};
}

}  // namespace treadmark::mesh
