// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

namespace treadmark {

/// Where something lies: between these two numbers.
struct Bracketed {
  double low, high;
  double middle() const { return 0.5 * (low + high); }
};

/// Bisection between low, where below(x) holds, and high, where it does not (low may be the greater number): so many
/// times, or until the two are as close as `width` or have no number between them.
template <class Below>
Bracketed bisect(double low, double high, const Below& below, int most = 200, double width = 0.0) {
  for (int k = 0; k < most && std::fabs(high - low) > width; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (below(middle) ? low : high) = middle;
  }
  return {low, high};
}

/// Where a function of one valley is least, by golden section (Kiefer 1953) until low and high are as close as `width`.
template <class Function>
Bracketed golden_section(double low, double high, double width, const Function& function) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = function(a), at_b = function(b);
  while (high - low > width) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low), at_a = function(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low), at_b = function(b);
    }
  }
  return {low, high};
}

}  // namespace treadmark
