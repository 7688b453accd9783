// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/backends/analytic/arc_graph.hpp"
#include "treadmark/backends/analytic/chain.hpp"

namespace treadmark::analytic {

/// A chain looked at along a direction of its plane: the height h of its outermost (least h) hit over the lateral
/// position w. With the direction d = (d_y, d_z): h = y d_y + z d_z, w = y d_z - z d_y; d = (0, 1) gives w = y, h = z.
class ChainView {
 public:
  /// d must have unit length.
  ChainView(const std::vector<ChainSegment>& chain, double d_y, double d_z);

  /// Interval of the view that holds w, or -1; guess is an earlier answer.
  int find(double w, int guess) const;
  /// The arc that is seen over an interval, and where the interval ends.
  const ArcGraph& arc(int interval) const { return piece(interval); }
  double w_min(int interval) const { return intervals_[static_cast<std::size_t>(interval)].w_min; }
  double w_max(int interval) const { return intervals_[static_cast<std::size_t>(interval)].w_max; }
  double height(double w, int interval) const { return piece(interval).height(w); }
  double height_and_slope(double w, int interval, double& slope) const {
    return piece(interval).height_and_slope(w, slope);
  }

  /// Where on the chain the visible hit lies: its segment, distance from the segment's start, and whether it hides
  /// others.
  struct Hit {
    int segment = 0;
    double distance = 0.0;
    bool hides_others = false;
  };
  Hit hit(double w, int interval) const;

  /// Least and greatest visible height over [w_min, w_max]; nothing if the chain is nowhere over it.
  std::optional<std::pair<double, double>> range(double w_min, double w_max) const;

 private:
  struct Piece {
    ArcGraph graph;
    int segment = 0;
    double angle_start = 0.0;  ///< inclination at the segment's start, relative to the view
    int half_turn = 0;         ///< inclinations of the piece lie within 90 degrees of half_turn * pi
  };
  struct Interval {
    double w_min, w_max;
    int piece;  ///< -1: nothing here
    int covering;
  };
  const ArcGraph& piece(int interval) const {
    return pieces_[static_cast<std::size_t>(intervals_[static_cast<std::size_t>(interval)].piece)].graph;
  }
  const std::vector<ChainSegment>* chain_;
  std::vector<Piece> pieces_;
  std::vector<Interval> intervals_;
};

}  // namespace treadmark::analytic
