// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/detection/gap_field.hpp"
#include "treadmark/detection/gap_source.hpp"

namespace treadmark::detection {

/// The gap on a grid, found out only where it may be small: branch and bound (Land and Doig 1960) over the tiles of a
/// GapField with conservative bounds of both surfaces. What was found out stays for the next question. After
/// reveal(below) every point that is not known has a gap of at least `below`: proven by the bounds, not guessed. One
/// per thread.
class PrunedGap {
 public:
  /// everything: all of the grid at once, without bounds.
  PrunedGap(const BodyPair& bodies, const Grid2& grid_T, const std::optional<WheelFacets>& facets, bool everything);

  const GapField& field() const { return field_; }

  /// Makes every point with a gap below this [m] known.
  void reveal(double below);
  /// Makes the points of a box known.
  void reveal(const IndexBox& box);
  /// Least gap of the grid [m]; NaN where the bodies nowhere face each other.
  double least();

  /// Points whose heights were asked for.
  std::size_t points_known() const;

 private:
  /// A rectangle of tiles not looked at yet.
  struct Node {
    GapBounds bounds;
    int tx, ty, nx, ny;
    bool looked_closely = false;
    bool single() const { return nx == 1 && ny == 1; }
  };
  static bool later(const Node& a, const Node& b) { return a.bounds.low > b.bounds.low; }

  IndexBox box(int tx, int ty, int nx, int ny) const;
  void push(const Node& node);
  Node pop();
  /// Into smaller ones, or a closer look at a tile; nothing where only its heights are left to be found out.
  std::vector<Node> refined(const Node& node) const;
  std::vector<Node> parts(const Node& node) const;
  /// What comes of the nodes goes to the frontier, or into the list of tiles to be filled.
  void refine(const std::vector<Node>& nodes, std::vector<Node>& to_fill);
  /// Down to one tile, always into the most promising part.
  void dive(Node node);
  void fill(const std::vector<Node>& nodes);

  GapSource source_;
  GapField field_;
  std::vector<Node> frontier_;  ///< a heap, least lower bound first
  double least_known_;
};

}  // namespace treadmark::detection
