// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/twelve_digits.hpp"

#include <charconv>
#include <cstdio>

namespace treadmark::io {

double twelve_digits(double value) {
  char text[32];
  const int length = std::snprintf(text, sizeof text, "%.12g", value);
  double rounded = value;
  std::from_chars(text, text + length, rounded);
  return rounded;
}

}  // namespace treadmark::io
