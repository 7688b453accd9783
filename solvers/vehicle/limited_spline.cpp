// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/limited_spline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"

namespace treadmark::vehicle {

namespace {

using Samples = std::vector<double>;

double minmod(double a, double b) {
  if (!(a * b > 0.0)) return 0.0;
  return std::abs(a) < std::abs(b) ? a : b;
}

/// Slope in x[0] of the polynomial through up to four points (Newton's divided differences).
double end_slope(const double* x, const double* y, std::size_t count, std::ptrdiff_t step) {
  const auto at = [step](const double* values, std::size_t i) { return values[static_cast<std::ptrdiff_t>(i) * step]; };
  Samples d(count);
  for (std::size_t i = 0; i < count; ++i) d[i] = at(y, i);
  double slope = 0.0, product = 1.0;
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t i = 0; i + order < count; ++i) d[i] = (d[i + 1] - d[i]) / (at(x, i + order) - at(x, i));
    slope += d[0] * product;
    product *= at(x, 0) - at(x, order);
  }
  return slope;
}

/// Slopes of the spline with continuous second derivative and given slopes at its ends (Thomas's algorithm).
void solve_slopes(const Samples& x, const Samples& rise, Samples& slope) {
  const std::size_t n = slope.size();
  Samples c(n), d(n);
  d[0] = slope[0];
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = x[i] - x[i - 1], behind = x[i + 1] - x[i];
    const double pivot = 2.0 * (before + behind) - behind * c[i - 1];
    c[i] = before / pivot;
    d[i] = (3.0 * (behind * rise[i - 1] + before * rise[i]) - behind * d[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) slope[i] = d[i] - c[i] * slope[i + 1];
}

}  // namespace

LimitedSpline::LimitedSpline(Samples x, Samples y) : x_(std::move(x)), y_(std::move(y)) {
  const std::size_t n = x_.size();
  if (n < 2 || y_.size() != n) throw Error(ErrorKind::input_data, "a spline needs at least two points");
  Samples rise(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    rise[i] = (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
    if (!(x_[i + 1] > x_[i]) || !std::isfinite(rise[i]))
      throw Error(ErrorKind::input_data, "the points of a spline must be finite and increase");
  }
  slope_.resize(n);
  const std::size_t points = std::min<std::size_t>(n, 4);
  const auto end = [](double slope, double next) {
    return std::clamp(slope, -3.0 * std::abs(next), 3.0 * std::abs(next));
  };
  slope_.front() = end(end_slope(x_.data(), y_.data(), points, 1), rise.front());
  slope_.back() = end(end_slope(&x_.back(), &y_.back(), points, -1), rise.back());
  solve_slopes(x_, rise, slope_);

  // Second differences at the points; none at the ends, so that the last piece of a step is not taken for a peak.
  Samples bend(n);
  for (std::size_t i = 1; i + 1 < n; ++i) bend[i] = (rise[i] - rise[i - 1]) / (x_[i + 1] - x_[i - 1]);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double from_left = rise[i - 1] + minmod(bend[i - 1], bend[i]) * (x_[i] - x_[i - 1]);
    const double from_right = rise[i] - minmod(bend[i], bend[i + 1]) * (x_[i + 1] - x_[i]);
    const double t = minmod(from_left, from_right);
    const double most = std::copysign(std::max(3.0 * std::abs(minmod(rise[i - 1], rise[i])), 1.5 * std::abs(t)), t);
    const double kept = t == 0.0 ? 0.0 : std::clamp(slope_[i], std::min(0.0, most), std::max(0.0, most));
    constexpr double kRounding = 1e-9;
    if (std::abs(kept - slope_[i]) > kRounding * (std::abs(rise[i - 1]) + std::abs(rise[i]))) ++limited_;
    slope_[i] = kept;
  }
}

Along LimitedSpline::at(double x) const {
  if (x < first()) return {y_.front(), 0.0, 0.0};
  if (x > last()) return {y_.back(), 0.0, 0.0};
  const std::size_t i = piece_at(x_, x);
  const double h = x_[i + 1] - x_[i], t = x - x_[i], rise = (y_[i + 1] - y_[i]) / h;
  const double second = (3.0 * rise - 2.0 * slope_[i] - slope_[i + 1]) / h,
               third = (slope_[i] + slope_[i + 1] - 2.0 * rise) / (h * h);
  return {y_[i] + t * (slope_[i] + t * (second + t * third)), slope_[i] + t * (2.0 * second + 3.0 * t * third),
          2.0 * second + 6.0 * t * third};
}

}  // namespace treadmark::vehicle
