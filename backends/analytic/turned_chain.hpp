// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>

#include "treadmark/backends/analytic/chord_tree.hpp"

namespace treadmark::analytic {

/// A plane curve looked at along the direction d of unit length: w = y d_z - z d_y across, h = y d_y + z d_z along it.
/// Bounds of h over a window of w, of visible and hidden points.
class TurnedChain {
 public:
  TurnedChain(double d_y, double d_z) : map_{d_y, d_z, 1.0} {}

  double greatest(const ChordTree& chords, double w_low, double w_high, double coarse) const {
    return chords.greatest(map_, -kInfinity, kInfinity, w_low, w_high, coarse);
  }
  double least(const ChordTree& chords, double w_low, double w_high, double coarse) const {
    return -chords.greatest(Map{map_.d_y, map_.d_z, -1.0}, -kInfinity, kInfinity, w_low, w_high, coarse);
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  struct Map {
    double d_y, d_z, side;
    static constexpr bool look_early = true;
    ChordTree::Image operator()(double y, double z) const { return {y * d_z - z * d_y, side * (y * d_y + z * d_z)}; }
    double off(const Chord& c) const { return c.off; }
  };
  Map map_;
};

}  // namespace treadmark::analytic
