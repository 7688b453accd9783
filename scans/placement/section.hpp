// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// A lateral section as a smooth curve over its arc length s, in coordinates (y, v): y lateral, v out of the material
/// (the radius of a wheel, -z of a rail). Runs with increasing y. [m]
class Section {
 public:
  Section() = default;
  /// Through points with increasing y, by cubic splines over the chord length, then over the arc length.
  /// Errors: Error(input_data) for fewer than 4 points or y that do not increase.
  explicit Section(std::span<const Vec2> points);

  struct Point {
    Vec2 position;           ///< (y, v)
    Vec2 normal;             ///< unit, out of the material
    double curvature = 0.0;  ///< [1/m], > 0 where the material is convex
  };
  Point at(double s) const;
  double length() const { return length_; }
  double y_min() const { return y_.front(); }
  double y_max() const { return y_.back(); }
  /// s at which the curve passes y, clamped to its ends.
  double s_at(double y) const;
  double v_at(double y) const { return at(s_at(y)).position.y(); }

  struct Foot {
    double s = 0.0;
    double distance = 0.0;  ///< along the normal, > 0 out of the material
  };
  /// The nearest point of the curve if it is not an end and nearer than farthest.
  std::optional<Foot> foot(const Vec2& point, double farthest) const;

 private:
  double length_ = 0.0, step_ = 0.0;
  std::vector<double> y_, v_, ddy_, ddv_;  ///< values and second derivatives at even steps of s
};

}  // namespace treadmark::scans
