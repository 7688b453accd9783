// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "treadmark/core/number_text.hpp"

namespace treadmark::io {

/// The shortest number that a reader turns into exactly this value, as text.
/// guess: about that number; read: what the reader makes of a number (a change of unit). Where no number gives exactly
/// the value, the nearest one.
template <class Read>
std::string exact_text(double value, double guess, Read read) {
  constexpr int kAllDigits = 17;
  for (int digits = 1; digits <= kAllDigits; ++digits) {
    const double x = finite_number(fmt::format("{:.{}g}", guess, digits)).value_or(guess);
    if (read(x) == value) return fmt::format("{}", x);
  }
  double below = guess, above = guess;
  for (int i = 0; i < 4; ++i) {
    below = std::nextafter(below, -HUGE_VAL);
    above = std::nextafter(above, HUGE_VAL);
    if (read(below) == value) return fmt::format("{}", below);
    if (read(above) == value) return fmt::format("{}", above);
  }
  return fmt::format("{}", guess);
}

/// Of a value in SI units, in another unit.
inline std::string exact_text(double value, double unit) {
  return exact_text(value, value / unit, [unit](double x) { return x * unit; });
}

}  // namespace treadmark::io
