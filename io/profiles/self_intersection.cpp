// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <limits>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/clean_points.hpp"

namespace treadmark::io::profiles {
namespace {

struct Box {
  double y0 = std::numeric_limits<double>::infinity(), y1 = -y0, z0 = y0, z1 = -y0;

  void add(const Box& b) {
    y0 = std::min(y0, b.y0), y1 = std::max(y1, b.y1);
    z0 = std::min(z0, b.z0), z1 = std::max(z1, b.z1);
  }
  bool meets(const Box& b) const { return y0 <= b.y1 && b.y0 <= y1 && z0 <= b.z1 && b.z0 <= z1; }
};

/// Boxes over runs of segments, halved down to a few: a polyline is coherent in space, so most pairs part early.
class SegmentTree {
 public:
  explicit SegmentTree(const RawPoints& points) : p_(points), segments_(points.size() - 1) {
    while (leaves_ * kLeaf < segments_) leaves_ *= 2;
    boxes_.resize(2 * leaves_);
    for (std::size_t s = 0; s < segments_; ++s) boxes_[leaves_ + s / kLeaf].add(box(s));
    for (std::size_t node = leaves_ - 1; node > 0; --node) {
      boxes_[node] = boxes_[2 * node];
      boxes_[node].add(boxes_[2 * node + 1]);
    }
    budget_ = 20 * segments_ + 1'000'000;
  }

  bool search(std::size_t& first, std::size_t& second) {
    if (!inside(1)) return false;
    first = first_;
    second = second_;
    return true;
  }

 private:
  static constexpr std::size_t kLeaf = 8;

  Box box(std::size_t s) const {
    const auto [y0, y1] = std::minmax(p_.y[s], p_.y[s + 1]);
    const auto [z0, z1] = std::minmax(p_.z[s], p_.z[s + 1]);
    return {y0, y1, z0, z1};
  }

  bool inside(std::size_t node) {
    if (node >= leaves_) return leaf_pair(node, node);
    return inside(2 * node) || inside(2 * node + 1) || between(2 * node, 2 * node + 1);
  }

  // Both nodes are on the same level.
  bool between(std::size_t a, std::size_t b) {
    const std::size_t cost = a >= leaves_ ? kLeaf : 1;
    if (budget_ < cost)
      throw Error(ErrorKind::input_data, "the profile is too tangled to check for self-intersection", {p_.file, 0, 0},
                  "thin out or repair the points");
    budget_ -= cost;
    if (!boxes_[a].meets(boxes_[b])) return false;
    if (a >= leaves_) return leaf_pair(a, b);
    for (std::size_t i = 2 * a; i < 2 * a + 2; ++i)
      for (std::size_t j = 2 * b; j < 2 * b + 2; ++j)
        if (between(i, j)) return true;
    return false;
  }

  bool leaf_pair(std::size_t a, std::size_t b) {
    const std::size_t a0 = (a - leaves_) * kLeaf, b0 = (b - leaves_) * kLeaf;
    for (std::size_t i = a0; i < std::min(a0 + kLeaf, segments_); ++i)
      for (std::size_t j = std::max(b0, i + 2); j < std::min(b0 + kLeaf, segments_); ++j)
        if (box(i).meets(box(j)) && cross(i, j)) {
          first_ = i;
          second_ = j;
          return true;
        }
    return false;
  }

  double side(std::size_t a, std::size_t b, std::size_t c) const {
    return (p_.y[b] - p_.y[a]) * (p_.z[c] - p_.z[a]) - (p_.z[b] - p_.z[a]) * (p_.y[c] - p_.y[a]);
  }

  bool cross(std::size_t i, std::size_t j) const {
    return side(i, i + 1, j) * side(i, i + 1, j + 1) < 0.0 && side(j, j + 1, i) * side(j, j + 1, i + 1) < 0.0;
  }

  const RawPoints& p_;
  std::size_t segments_;
  std::size_t leaves_ = 1;
  std::vector<Box> boxes_;
  std::size_t budget_ = 0;  ///< of comparisons, in proportion to the number of segments
  std::size_t first_ = 0, second_ = 0;
};

}  // namespace

bool crosses_itself(const RawPoints& points, std::size_t& first, std::size_t& second) {
  return points.size() >= 4 && SegmentTree(points).search(first, second);
}

}  // namespace treadmark::io::profiles
