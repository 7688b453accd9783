// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::detection {

/// A plane curve through points: natural cubic splines of both coordinates over the length of the chords (Ahlberg,
/// Nilson, Walsh 1967).
class NaturalCurve {
 public:
  /// Two points or more, no two neighbours the same.
  explicit NaturalCurve(std::vector<Vec2> points);

  /// The least second coordinate over a value of the first one; NaN where there is none.
  double least_over(double first) const;

 private:
  Vec2 at(std::size_t segment, double f) const;

  std::vector<Vec2> points_, bends_;  ///< bends: second derivatives
  std::vector<double> chords_;
};

/// Second derivatives of the natural cubic spline through points at a parameter whose steps are given (Ahlberg, Nilson,
/// Walsh 1967). Point: a vector of any dimension. steps: one less than points, positive.
template <class Point>
std::vector<Point> natural_bends(std::span<const Point> points, std::span<const double> steps) {
  const std::size_t n = points.size();
  std::vector<Point> bends(n, Point::Zero());
  // Tridiagonal: h_(i-1) m_(i-1) + 2 (h_(i-1) + h_i) m_i + h_i m_(i+1) = 6 (rise_i - rise_(i-1)), m = 0 at both ends.
  std::vector<double> above(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Point right = 6.0 * ((points[i + 1] - points[i]) / steps[i] - (points[i] - points[i - 1]) / steps[i - 1]);
    const double pivot = 2.0 * (steps[i - 1] + steps[i]) - steps[i - 1] * above[i - 1];
    above[i] = steps[i] / pivot;
    bends[i] = (right - steps[i - 1] * bends[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) bends[i] -= above[i] * bends[i + 1];
  return bends;
}

/// Point of the spline between two points a step apart; f from 0 to 1.
template <class Point>
Point natural_point(const Point& a, const Point& b, const Point& bend_a, const Point& bend_b, double step, double f) {
  const double g = 1.0 - f, h = step * step / 6.0;
  return g * a + f * b + h * ((g * g * g - g) * bend_a + (f * f * f - f) * bend_b);
}

}  // namespace treadmark::detection
