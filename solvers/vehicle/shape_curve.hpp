// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

namespace treadmark::vehicle {

/// A smooth curve through points: quadratic pieces, two between neighbours, with continuous slope (Schumaker 1983).
/// Between two points whose slopes embrace the chord's the slope is monotone, so that kinks in the data make no
/// overshoot. Beyond the ends it runs on straight. Immutable: any number of threads.
class ShapeCurve {
 public:
  struct Point {
    double value = 0.0, slope = 0.0;
  };

  /// x: increasing, at least two. Errors: Error(configuration) for other sizes or order.
  ShapeCurve(std::vector<double> x, std::vector<double> value, std::vector<double> slope);
  /// Slopes such that the curve rises and falls only where the data do (Fritsch and Butland 1984).
  static ShapeCurve monotone(std::vector<double> x, std::vector<double> value);

  Point at(double x) const;

 private:
  std::vector<double> x_, value_, slope_;
};

}  // namespace treadmark::vehicle
