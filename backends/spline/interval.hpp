// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::spline {

/// Closed interval for conservative bounds.
struct Interval {
  double low, high;

  double width() const { return high - low; }
  bool overlaps(const Interval& other) const { return low <= other.high && other.low <= high; }
  void include(const Interval& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  friend Interval operator+(const Interval& a, const Interval& b) { return {a.low + b.low, a.high + b.high}; }
  friend Interval operator+(const Interval& a, double shift) { return {a.low + shift, a.high + shift}; }
  friend Interval operator*(double factor, const Interval& a) {
    return factor >= 0.0 ? Interval{factor * a.low, factor * a.high} : Interval{factor * a.high, factor * a.low};
  }
  static Interval none() { return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}; }
  bool empty() const { return !(low <= high); }
};

/// Bounds are meant for real numbers; this covers the rounding of their own evaluation and the slack at edges [m].
inline Interval widened(double low, double high) {
  constexpr double kSlack = 1e-9;
  return {low - kSlack, high + kSlack};
}

/// Least and greatest |x|.
inline Interval magnitude(const Interval& a) {
  const double low = a.low > 0.0 ? a.low : a.high < 0.0 ? -a.high : 0.0;
  return {low, std::max(std::abs(a.low), std::abs(a.high))};
}

}  // namespace treadmark::spline
