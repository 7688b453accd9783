// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/shape_curve.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

void require_points(const std::vector<double>& x, std::size_t values) {
  if (x.size() < 2 || values != x.size() || std::ranges::adjacent_find(x, std::greater_equal<>{}) != x.end())
    throw Error(ErrorKind::configuration, "a curve needs two points or more, in increasing order");
}

/// Harmonic mean of the neighbouring chords' slopes, weighted by their lengths; 0 at an extremum.
double mean_slope(double before, double after, double length_before, double length_after) {
  if (!(before * after > 0.0)) return 0.0;
  const double share = (length_before + 2.0 * length_after) / (3.0 * (length_before + length_after));
  return before * after / (share * after + (1.0 - share) * before);
}

}  // namespace

ShapeCurve::ShapeCurve(std::vector<double> x, std::vector<double> value, std::vector<double> slope)
    : x_(std::move(x)), value_(std::move(value)), slope_(std::move(slope)) {
  require_points(x_, value_.size());
  require_points(x_, slope_.size());
}

ShapeCurve ShapeCurve::monotone(std::vector<double> x, std::vector<double> value) {
  require_points(x, value.size());
  const std::size_t last = x.size() - 1;
  const auto chord = [&](std::size_t i) { return (value[i + 1] - value[i]) / (x[i + 1] - x[i]); };
  std::vector<double> slope(x.size());
  slope.front() = chord(0);
  slope.back() = chord(last - 1);
  for (std::size_t i = 1; i < last; ++i)
    slope[i] = mean_slope(chord(i - 1), chord(i), x[i] - x[i - 1], x[i + 1] - x[i]);
  return {std::move(x), std::move(value), std::move(slope)};
}

ShapeCurve::Point ShapeCurve::at(double x) const {
  if (x <= x_.front()) return {value_.front() + slope_.front() * (x - x_.front()), slope_.front()};
  if (x >= x_.back()) return {value_.back() + slope_.back() * (x - x_.back()), slope_.back()};
  const auto i = static_cast<std::size_t>(std::ranges::upper_bound(x_, x) - x_.begin()) - 1;
  const double length = x_[i + 1] - x_[i], chord = (value_[i + 1] - value_[i]) / length, first = slope_[i],
               last = slope_[i + 1];
  // The slope runs straight from its first value to 'middle' at the share 'knot' of the way, and on to its last value;
  // the area below it is the chord's.
  double knot = 0.5, middle = 2.0 * chord - 0.5 * (first + last);
  if ((first - chord) * (last - chord) < 0.0) {
    knot = (last - chord) / (last - first);
    middle = chord;
  }
  const double share = (x - x_[i]) / length;
  if (share <= knot) {
    const double slope = first + (middle - first) * share / knot;
    return {value_[i] + 0.5 * (first + slope) * share * length, slope};
  }
  const double rest = 1.0 - share, slope = last + (middle - last) * rest / (1.0 - knot);
  return {value_[i + 1] - 0.5 * (last + slope) * rest * length, slope};
}

}  // namespace treadmark::vehicle
