// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// Cubics y, z in (s - s_k) on one interval between breaks; [power].
struct CubicSegment {
  double y[4] = {0, 0, 0, 0};
  double z[4] = {0, 0, 0, 0};
};

/// A profile as a parametric piecewise cubic curve (y(s), z(s)), s = chord length of the data points [m].
/// Outside [begin(), end()] positions stay at the end values and derivatives at those of the end.
/// Immutable, so safe to use from any number of threads.
class ProfileSpline {
 public:
  /// breaks strictly increasing, one more than segments; kinks: the breaks in the interior with a jump of the tangent.
  ProfileSpline(std::vector<double> breaks, std::vector<CubicSegment> segments, std::vector<double> kinks = {});

  double begin() const { return breaks_.front(); }
  double end() const { return breaks_.back(); }
  std::span<const double> breaks() const { return breaks_; }
  std::span<const CubicSegment> segments() const { return segments_; }
  std::span<const double> kinks() const { return kinks_; }

  /// The segment with s in [s_k, s_(k+1)), clamped to the range.
  int find_segment(double s) const;

  Vec2 position(double s) const;           ///< (y, z) [m]
  Vec2 derivative(double s) const;         ///< [-], at a break the value of the segment to its right
  Vec2 second_derivative(double s) const;  ///< [1/m]
  /// Inclination atan2(dz/ds, dy/ds) [rad].
  double inclination(double s) const;

 private:
  std::vector<double> breaks_;
  std::vector<CubicSegment> segments_;
  std::vector<double> kinks_;
};

}  // namespace treadmark::spline
