// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/detection/natural_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::detection {

NaturalCurve::NaturalCurve(std::vector<Vec2> points) : points_(std::move(points)) {
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) chords_.push_back((points_[i + 1] - points_[i]).norm());
  bends_ = natural_bends<Vec2>(points_, chords_);
}

Vec2 NaturalCurve::at(std::size_t i, double f) const {
  return natural_point(points_[i], points_[i + 1], bends_[i], bends_[i + 1], chords_[i], f);
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
