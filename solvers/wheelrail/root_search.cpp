// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/wheelrail/root_search.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::wheelrail {

RootSearch::RootSearch(const Settings& settings) : settings_(settings), step_(settings.first_step) {}

double RootSearch::outside(double x, double residual) {
  constexpr double kLongest = 4.0;  // of the last step
  const double direction = residual < 0.0 ? 1.0 : -1.0;
  if (count_ > 1 && x != x_last_) {
    const double slope = (residual - f_last_) / (x - x_last_);
    step_ = slope > 0.0 ? std::clamp(1.1 * std::abs(residual) / slope, step_, kLongest * step_) : kLongest * step_;
  }
  return x + direction * step_;
}

RootSearch::State RootSearch::add(double x, double residual) {
  if (count_++ == 0) start_ = x;
  next_ = x;
  if (std::abs(residual) <= settings_.tolerance) return State::found;
  bracket_.add(x, residual, residual);
  if (bracket_.closed()) {
    if (std::abs(bracket_.width()) <= settings_.resolution) return State::jump;
    next_ = bracket_.safeguarded(x - residual * (x - x_last_) / (residual - f_last_));
  } else {
    next_ = outside(x, residual);
    if (std::abs(x - start_) >= settings_.reach) return State::nowhere;
    next_ = std::clamp(next_, start_ - settings_.reach, start_ + settings_.reach);
  }
  x_last_ = x, f_last_ = residual;
  return State::search;
}

void Bracket::add(double x, double residual, double value) {
  if (residual < 0.0)
    x_low_ = x, value_low_ = value;
  else
    x_high_ = x, value_high_ = value;
}

bool Bracket::closed() const { return std::isfinite(x_low_) && std::isfinite(x_high_); }

double Bracket::safeguarded(double guess) {
  constexpr int kPatience = 3;
  const double size = std::abs(width());
  slow_ = size > 0.5 * last_width_ ? slow_ + 1 : 0;
  last_width_ = size;
  const bool patient = slow_ < kPatience;
  if (!patient) slow_ = 0;
  const bool inside = guess > std::min(x_low_, x_high_) && guess < std::max(x_low_, x_high_);
  return patient && inside ? guess : 0.5 * (x_low_ + x_high_);
}

}  // namespace treadmark::wheelrail
