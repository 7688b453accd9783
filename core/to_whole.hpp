// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <concepts>
#include <limits>

namespace treadmark {

/// A number without its fraction as one of Int; beyond what Int holds the nearest that it holds, of NaN the least. A
/// plain cast is undefined there. Thread-safe.
template <std::integral Int>
constexpr Int to_whole(double x) {
  using Limits = std::numeric_limits<Int>;
  constexpr int kExact = std::numeric_limits<double>::digits;
  constexpr Int most = Limits::max();
  // the greatest that is a double, too
  constexpr double high =
      static_cast<double>(Limits::digits > kExact ? most - (most >> (kExact % Limits::digits)) : most);
  return static_cast<Int>(std::min(std::max(static_cast<double>(Limits::min()), x), high));
}

/// The same between least and most, which Int holds; of NaN least. As fast as a cast that is clamped.
template <std::integral Int>
constexpr Int to_whole(double x, double least, double most) {
  return static_cast<Int>(std::min(std::max(least, x), most));
}

}  // namespace treadmark
