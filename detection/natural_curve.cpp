// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/natural_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::detection {

NaturalCurve::NaturalCurve(std::vector<Vec2> points) : points_(std::move(points)), bends_(points_.size(), Vec2::Zero()) {
  const std::size_t n = points_.size();
  for (std::size_t i = 0; i + 1 < n; ++i) chords_.push_back((points_[i + 1] - points_[i]).norm());
  // Tridiagonal: h_(i-1) m_(i-1) + 2 (h_(i-1) + h_i) m_i + h_i m_(i+1) = 6 (rise_i - rise_(i-1)), m = 0 at both ends.
  std::vector<double> above(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec2 right = 6.0 * ((points_[i + 1] - points_[i]) / chords_[i] - (points_[i] - points_[i - 1]) / chords_[i - 1]);
    const double pivot = 2.0 * (chords_[i - 1] + chords_[i]) - chords_[i - 1] * above[i - 1];
    above[i] = chords_[i] / pivot;
    bends_[i] = (right - chords_[i - 1] * bends_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) bends_[i] -= above[i] * bends_[i + 1];
}

Vec2 NaturalCurve::at(std::size_t i, double f) const {
  const double g = 1.0 - f, h = chords_[i] * chords_[i] / 6.0;
  return g * points_[i] + f * points_[i + 1] + h * ((g * g * g - g) * bends_[i] + (f * f * f - f) * bends_[i + 1]);
}

double NaturalCurve::least_over(double first) const {
  constexpr int kHalvings = 52;
  double least = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    double low = 0.0, high = 1.0;
    const bool rising = points_[i + 1].x() > points_[i].x();
    const double from = std::min(points_[i].x(), points_[i + 1].x()), to = std::max(points_[i].x(), points_[i + 1].x());
    if (!(first >= from && first <= to)) continue;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      ((at(i, middle).x() < first) == rising ? low : high) = middle;
    }
    least = std::fmin(least, at(i, 0.5 * (low + high)).y());
  }
  return least;
}

}  // namespace treadmark::detection
