// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "chebyshev_series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

constexpr double kPi = std::numbers::pi;

double node_angle(std::size_t j, std::size_t n) {
  return kPi * (static_cast<double>(j) + 0.5) / static_cast<double>(n);
}

}  // namespace

std::vector<double> ChebyshevSeries::nodes(double begin, double end, std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j) x[j] = 0.5 * (begin + end) + 0.5 * (end - begin) * std::cos(node_angle(j, n));
  return x;
}

ChebyshevSeries::ChebyshevSeries(double begin, double end, const std::vector<double>& values, double period,
                                 double negligible)
    : middle_(0.5 * (begin + end)), half_(0.5 * (end - begin)), period_(period), coefficients_(values.size(), 0.0) {
  // discrete orthogonality of cos(k theta) at the nodes
  const std::size_t n = values.size();
  double scale = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 0; j < n; ++j)
      coefficients_[k] += values[j] * std::cos(static_cast<double>(k) * node_angle(j, n));
    coefficients_[k] *= (k == 0 ? 1.0 : 2.0) / static_cast<double>(n);
    scale = std::max(scale, std::fabs(coefficients_[k]));
  }
  constexpr double kRounding = 1e-13;
  double left_out = 0.0;
  while (coefficients_.size() > 1) {
    const double last = std::fabs(coefficients_.back());
    left_out += last;
    if (last > kRounding * scale && left_out > negligible) break;
    coefficients_.pop_back();
  }
  for (std::size_t k = 1; k < coefficients_.size(); ++k) {
    const double order = static_cast<double>(k), size = std::fabs(coefficients_[k]);
    sum_ += size;
    sum_1_ += order * size;
    sum_2_ += order * order * size;
  }
  first_ = unit_jet(-1.0).value;
  last_ = unit_jet(1.0).value;
  if (period_ > 0.0) join_ = (first_ - last_) / (period_ - 2.0 * half_);
}

double ChebyshevSeries::on_this_turn(double x) const {
  return period_ > 0.0 ? x - period_ * std::round((x - middle_) / period_) : x;
}

ChebyshevSeries::Jet ChebyshevSeries::jet(double x) const {
  x = on_this_turn(x);
  const double t = to_unit(x);
  if (std::fabs(t) <= 1.0) {
    const Jet j = unit_jet(t);
    return {j.value, j.slope / half_, j.bend / (half_ * half_)};
  }
  return {outer_value(x), join_, 0.0};
}

double ChebyshevSeries::outer_value(double x) const {
  const bool after = x > middle_;
  const double value = after ? last_ : first_;
  return join_ == 0.0 ? value : value + join_ * (x - (after ? middle_ + half_ : middle_ - half_));
}

/// Clenshaw's recurrence (1955), and the same differentiated twice.
ChebyshevSeries::Jet ChebyshevSeries::unit_jet(double t) const {
  Jet b1, b2;
  for (std::size_t k = coefficients_.size() - 1; k > 0; --k) {
    const Jet b{coefficients_[k] + 2.0 * t * b1.value - b2.value, 2.0 * b1.value + 2.0 * t * b1.slope - b2.slope,
                4.0 * b1.slope + 2.0 * t * b1.bend - b2.bend};
    b2 = b1;
    b1 = b;
  }
  return {coefficients_[0] + t * b1.value - b2.value, b1.value + t * b1.slope - b2.slope,
          2.0 * b1.slope + t * b1.bend - b2.bend};
}

/// With t = cos(theta) the series is f(theta) = sum c_n cos(n theta), |f''| <= sum n^2 |c_n|: Taylor's remainder round
/// the middle of each piece. df/dt = -f'/sin(theta), and |sin(n theta)| <= n sin(theta) bounds it at the ends.
ChebyshevSeries::Range ChebyshevSeries::inner_range(double t_from, double t_to) const {
  constexpr double kPiece = 0.05;
  const double begin = std::acos(std::clamp(t_to, -1.0, 1.0)), end = std::acos(std::clamp(t_from, -1.0, 1.0));
  const int pieces = 1 + std::min(15, static_cast<int>((end - begin) / kPiece));
  const double r = 0.5 * (end - begin) / pieces;
  Range out{last_, last_, 0.0};
  for (int i = 0; i < pieces; ++i) {
    const double theta = begin + (2 * i + 1) * r, sine = std::sin(theta);
    const Jet middle = unit_jet(std::cos(theta));
    const double rate = std::min(sum_1_, std::fabs(sine * middle.slope) + sum_2_ * r);
    const double spread = rate * r + rounding();
    const double low = std::max(middle.value - spread, coefficients_[0] - sum_ - rounding());
    const double high = std::min(middle.value + spread, coefficients_[0] + sum_ + rounding());
    out.low = i == 0 ? low : std::min(out.low, low);
    out.high = i == 0 ? high : std::max(out.high, high);
    const double least_sine = std::min(std::sin(theta - r), std::sin(theta + r));
    out.steepest = std::max(out.steepest, least_sine > 0.0 ? std::min(sum_2_, rate / least_sine) : sum_2_);
  }
  out.steepest /= half_;
  return out;
}

ChebyshevSeries::Range ChebyshevSeries::range(double from, double to) const {
  if (period_ > 0.0) {
    const double shift = period_ * std::round((0.5 * (from + to) - middle_) / period_);
    from -= shift;
    to -= shift;
    // what reaches round the far side of the turn counts as all of it
    const double low = middle_ - 0.5 * period_, high = middle_ + 0.5 * period_;
    if (!(from >= low && to <= high)) from = low, to = high;
  }
  const double begin = middle_ - half_, end = middle_ + half_;
  Range out{outer_value(from), outer_value(from), 0.0};
  if (from <= end && to >= begin) out = inner_range(to_unit(from), to_unit(to));
  for (const double x : {from, to}) {
    if (x >= begin && x <= end) continue;
    out.low = std::min(out.low, outer_value(x) - rounding());
    out.high = std::max(out.high, outer_value(x) + rounding());
    out.steepest = std::max(out.steepest, std::fabs(join_));
  }
  return out;
}
