// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/chord_tree.hpp"

namespace treadmark::analytic {

namespace {

double distance(double y, double h, const Chord& c) {
  const double dy = c.y_b - c.y_a, dh = c.h_b - c.h_a, length_2 = dy * dy + dh * dh;
  const double along = length_2 > 0.0 ? std::clamp(((y - c.y_a) * dy + (h - c.h_a) * dh) / length_2, 0.0, 1.0) : 0.0;
  return std::hypot(y - c.y_a - along * dy, h - c.h_a - along * dh);
}

}  // namespace

ChordTree::ChordTree(const std::vector<Chord>& leaves) {
  if (leaves.empty()) return;
  nodes_.reserve(2 * leaves.size() - 1);
  build(leaves, 0, leaves.size());
}

void ChordTree::build(const std::vector<Chord>& leaves, std::size_t begin, std::size_t end) {
  Node node;
  node.chord = {leaves[begin].y_a, leaves[begin].h_a, leaves[end - 1].y_b, leaves[end - 1].h_b, 0.0};
  node.y_low = std::numeric_limits<double>::infinity();
  node.y_high = -node.y_low;
  constexpr double kRounding = 1e-15;  // [m]
  for (std::size_t i = begin; i < end; ++i) {
    const Chord& leaf = leaves[i];
    // both ends near the chord: so is all between them
    const double away = std::max(distance(leaf.y_a, leaf.h_a, node.chord), distance(leaf.y_b, leaf.h_b, node.chord));
    node.chord.off = std::max(node.chord.off, away + leaf.off + kRounding);
    node.y_low = std::min({node.y_low, leaf.y_a - leaf.off, leaf.y_b - leaf.off});
    node.y_high = std::max({node.y_high, leaf.y_a + leaf.off, leaf.y_b + leaf.off});
  }
  const std::size_t at = nodes_.size();
  nodes_.push_back(node);
  if (end - begin > 1) {
    const std::size_t middle = begin + (end - begin) / 2;
    build(leaves, begin, middle);
    build(leaves, middle, end);
  }
  nodes_[at].next = nodes_.size();
}

}  // namespace treadmark::analytic
