// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/solvers/vehicle/track_path.hpp"

namespace treadmark::vehicle {

/// A cubic spline through points that does not overshoot. It is twice continuously differentiable, but where its slope
/// at a point would make waves that the data do not have (beside steps and corners) the slope is limited as Huynh
/// (1993) limits it, and the second derivative jumps. Where data rise or fall throughout so does the curve. Peaks of
/// smooth data keep their height: waves of n points each are met within (2 pi / n)^4 5/384 of their amplitude, and what
/// limits do there to the second derivative stays below (2 pi / n)^2 2/3 of it. Immutable; safe to use from several
/// threads.
class LimitedSpline {
 public:
  /// x: increasing; y: as many, at least two. Errors: Error(input_data).
  LimitedSpline(std::vector<double> x, std::vector<double> y);

  double first() const { return x_.front(); }  ///< where it begins
  double last() const { return x_.back(); }    ///< where it ends
  /// Before the first and behind the last point the value there.
  Along at(double x) const;
  /// Points whose slope is limited.
  int limited() const { return limited_; }

 private:
  std::vector<double> x_, y_, slope_;
  int limited_ = 0;
};

}  // namespace treadmark::vehicle
