// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/backends/analytic/chord_tree.hpp"
#include "treadmark/backends/analytic/defects/flat_depth.hpp"
#include "treadmark/backends/analytic/graph_curve.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {

/// Height bounds of a wheel from chords of its profile. Looked at along the plane's normal, a point of the wheel has
/// the coordinates sigma (square to the normal and to the axle), y and tau = sqrt(r^2 - sigma^2), measured along the
/// normal's part square to the axle. Over a rectangle sigma and the depth of flats keep to intervals; each of their
/// ends gives one plane curve (y, tau), which is turned into the plane frame.
class WheelHull {
 public:
  explicit WheelHull(const GraphCurve& curve);

  /// Nothing where the rectangle comes so near to the horizon of the wheel that its curves are too steep for this.
  std::optional<HeightBounds> heights(double nominal_radius, const FlatDepth& flats, const Pose& X_SP,
                                      const Rectangle& rectangle_P) const;
  std::size_t memory_bytes() const { return chords_.memory_bytes() + bins_.capacity() * sizeof(Bin); }

 private:
  struct Bin {
    double low, high;
  };
  /// Range of the profile's z over [y_low, y_high]; low > high if that is beside the profile.
  Bin range(double y_low, double y_high) const;

  ChordTree chords_;
  double y_min_, y_max_, bins_per_length_;
  std::vector<Bin> bins_;
  Bin all_;
};

}  // namespace treadmark::analytic
