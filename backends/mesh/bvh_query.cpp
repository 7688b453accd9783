// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <array>
#include <cmath>
#include <limits>

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark::mesh {

namespace {

/// Visits the leaves that a line may meet. enter(outermost): whether a node that reaches out to there is wanted.
template <class Enter, class Leaf>
void descend(const std::vector<BvhNode>& nodes, const PlaneLines& l, double x, double y, double margin,
             const Enter& enter, const Leaf& leaf) {
  constexpr std::size_t kDepth = 64;  // levels: 32-bit numbers are halved
  double size[3][3], base[3];
  for (int i = 0; i < 3; ++i) {
    base[i] = i == 0 ? -x : i == 1 ? -y : 0.0;
    for (int j = 0; j < 3; ++j) {
      size[j][i] = std::fabs(l.rotation[j][i]);
      base[i] -= l.rotation[j][i] * l.origin[j];
    }
  }
  std::array<std::uint32_t, kDepth> stack;
  std::size_t open = 0;
  stack[open++] = 0;
  while (open > 0) {
    const std::uint32_t number = stack[--open];
    const BvhNode& node = nodes[number];
    const double *m = node.middle, *h = node.half;
    const auto middle = [&](int i) {
      return base[i] + l.rotation[0][i] * m[0] + l.rotation[1][i] * m[1] + l.rotation[2][i] * m[2];
    };
    const auto half = [&](int i) { return size[0][i] * h[0] + size[1][i] * h[1] + size[2][i] * h[2]; };
    if (std::fabs(middle(0)) > half(0) + margin || std::fabs(middle(1)) > half(1) + margin) continue;
    if (!enter(l.side * middle(2) + half(2) + kBoxRounding)) continue;
    if (node.right != 0) {
      stack[open++] = node.right;
      stack[open++] = number + 1;
    } else {
      leaf(node);
    }
  }
}

}  // namespace

LineHit Bvh::outermost(const PlaneView& view, double x, double y) const {
  LineHit inside, beside;
  double depth = -kInfinity, depth_beside = -kInfinity;
  const auto better = [&](const LineHit& h, const LineHit& best, double best_depth) {
    const double d = view.side * h.z;
    if (std::fabs(d - best_depth) <= kSameHeight && h.cover != best.cover) return h.cover == Cover::front;
    return d > best_depth;
  };
  ProjectedTriangle triangle;
  const auto leaf = [&](const Node& node) {
    for (std::uint32_t k = node.begin; k < node.begin + node.count; ++k) {
      triangle.load(mesh_, view, k);
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
  };
  descend(
      nodes_, view.lines(), x, y, kRimTolerance + kBoxRounding, [&](double out) { return out >= depth; }, leaf);
  return inside.triangle != kNone ? inside : beside;
}

bool Bvh::hides_others(const PlaneView& view, double x, double y, const LineHit& hit) const {
  constexpr double kApart = 1e-9;  // [m] neighbours of the hit give the same height
  bool found = false;
  ProjectedTriangle triangle;
  const auto leaf = [&](const Node& node) {
    for (std::uint32_t k = node.begin; k < node.begin + node.count && !found; ++k) {
      if (k == hit.triangle) continue;
      triangle.load(mesh_, view, k);
      const auto e = triangle.edges(x, y, view.side);
      found =
          ProjectedTriangle::cover(e) == Cover::front && view.side * (hit.z - triangle.hit(e, Cover::front).z) > kApart;
    }
  };
  descend(
      nodes_, view.lines(), x, y, kBoxRounding, [&](double) { return !found; }, leaf);
  return found;
}

}  // namespace treadmark::mesh
