// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/detection/contact_program/natural_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/roots.hpp"

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
    const bool rising = points_[i + 1].x() > points_[i].x();
    const double from = std::min(points_[i].x(), points_[i + 1].x()), to = std::max(points_[i].x(), points_[i + 1].x());
    if (!(first >= from && first <= to)) continue;
    const auto before = [&](double f) { return (at(i, f).x() < first) == rising; };
    least = std::fmin(least, at(i, bisect(0.0, 1.0, before, kHalvings).middle()).y());
  }
  return least;
}

}  // namespace treadmark::detection
