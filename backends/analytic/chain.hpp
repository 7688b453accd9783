// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <vector>

#include "treadmark/backends/analytic/chord_tree.hpp"
#include "treadmark/backends/analytic/graph_curve.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::analytic {

/// One segment of a chain with its start resolved: position (y, z), inclination, and arc length before it.
struct ChainSegment {
  double y = 0.0, z = 0.0, angle = 0.0;
  double length = 0.0, curvature = 0.0;
  double s = 0.0;
};

/// A point of a chain; inclination alpha = atan2(dz, dy) along increasing arc length, not wrapped.
struct ChainPoint {
  double y = 0.0, z = 0.0, angle = 0.0, curvature = 0.0;
};

/// The starts of all segments. Errors: Error(configuration) for an empty chain, a segment that is not positive,
/// non-finite numbers.
std::vector<ChainSegment> resolve(const ArcChain& chain);

/// The point at distance d from the start of a segment, 0 <= d <= length.
ChainPoint point_on(const ChainSegment& segment, double d);

/// Chords that keep to the chain within GraphCurve::kChordOff.
std::vector<Chord> chords_of(const std::vector<ChainSegment>& chain);

/// The chain as a graph z(y). Errors: Error(configuration) if it is vertical or turns back somewhere.
GraphCurve graph_of(const ArcChain& chain);

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
