// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/root_search.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::wheelrail {

RootSearch::RootSearch(const Settings& settings) : settings_(settings), step_(settings.first_step) {}

bool RootSearch::bracketed() const { return std::isfinite(x_low_) && std::isfinite(x_high_); }

double RootSearch::outside(double x, double residual) {
  constexpr double kLongest = 4.0;  // of the last step
  const double direction = residual < 0.0 ? 1.0 : -1.0;
  if (count_ > 1 && x != x_last_) {
    const double slope = (residual - f_last_) / (x - x_last_);
    step_ = slope > 0.0 ? std::clamp(1.1 * std::abs(residual) / slope, step_, kLongest * step_) : kLongest * step_;
  }
  return x + direction * step_;
}

double RootSearch::inside(double x, double residual) {
  const double width = std::abs(x_high_ - x_low_);
  // Secants may close in from one side; those that do not close in at all give way to bisection.
  constexpr int kPatience = 3;
  slow_ = width > 0.5 * width_ ? slow_ + 1 : 0;
  width_ = width;
  const double middle = 0.5 * (x_low_ + x_high_);
  if (slow_ >= kPatience || residual == f_last_) {
    slow_ = 0;
    return middle;
  }
  const double secant = x - residual * (x - x_last_) / (residual - f_last_);
  const double low = std::min(x_low_, x_high_), high = std::max(x_low_, x_high_);
  return secant > low && secant < high ? secant : middle;
}

RootSearch::State RootSearch::add(double x, double residual) {
  if (count_++ == 0) start_ = x;
  next_ = x;
  if (std::abs(residual) <= settings_.tolerance) return State::found;
  if (residual < 0.0)
    x_low_ = x, f_low_ = residual;
  else
    x_high_ = x, f_high_ = residual;
  if (bracketed()) {
    if (std::abs(x_high_ - x_low_) <= settings_.resolution) return State::jump;
    next_ = inside(x, residual);
  } else {
    next_ = outside(x, residual);
    if (std::abs(x - start_) >= settings_.reach) return State::nowhere;
    next_ = std::clamp(next_, start_ - settings_.reach, start_ + settings_.reach);
  }
  x_last_ = x, f_last_ = residual;
  return State::search;
}

}  // namespace treadmark::wheelrail
