// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/bracket.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::wheelrail {

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
