// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "treadmark/core/parallel_blocks.hpp"

namespace treadmark {

/// Sorts on all threads: blocks by themselves, then pairs of neighbours merged. What is equal stands in an order that
/// does not depend on the number of threads.
template <class Value, class Less>
void parallel_sort(std::vector<Value>& values, const Less& less) {
  constexpr std::size_t kBlock = std::size_t{1} << 15;
  const std::size_t count = values.size();
  const auto at = [count](std::vector<Value>& list, std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(std::min(i, count));
  };
  parallel_blocks(count, kBlock,
                  [&](std::size_t from, std::size_t to) { std::sort(at(values, from), at(values, to), less); });
  if (count <= kBlock) return;
  std::vector<Value> merged(count);
  for (std::size_t width = kBlock; width < count; width *= 2) {
    parallel_blocks(count, 2 * width, [&](std::size_t from, std::size_t to) {
      const auto middle = at(values, from + width);
      std::merge(at(values, from), middle, middle, at(values, to), at(merged, from), less);
    });
    values.swap(merged);
  }
}

}  // namespace treadmark
