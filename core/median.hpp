// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace treadmark {

/// Median of at least one value, the upper one of an even number. Rearranges the values, so that all before the middle
/// are no greater than those behind it.
template <class Number>
Number median_of(std::vector<Number>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace treadmark
