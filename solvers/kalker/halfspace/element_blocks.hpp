// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "treadmark/core/parallel.hpp"

namespace treadmark::kalker {

/// Loops over the elements of a large contact on all cores. Where blocks begin follows from the number of elements
/// alone, so that sums have one order of additions and results do not depend on the number of threads. Fewer elements
/// than a few blocks are not worth a second thread: they stay on the caller's.
inline constexpr std::size_t kElementsOfBlock = 8192, kFewestBlocks = 4;

/// body(begin, end) for consecutive parts of [0, count), each item of which stands for so many elements.
template <class Body>
void for_blocks(std::size_t count, const Body& body, std::size_t elements_of_item = 1) {
  const std::size_t length = std::max(std::size_t{1}, kElementsOfBlock / std::max(std::size_t{1}, elements_of_item));
  const std::size_t blocks = (count + length - 1) / length;
  if (blocks < kFewestBlocks) return body(std::size_t{0}, count);
  parallel_for(blocks, [&](std::size_t b) { body(b * length, std::min(count, (b + 1) * length)); });
}

/// body(i) for all elements.
template <class Body>
void for_each_element(std::size_t count, const Body& body) {
  for_blocks(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Sum over the blocks of sum(begin, end), in their order.
template <class Sum>
double sum_of_blocks(std::size_t count, const Sum& sum) {
  const std::size_t blocks = (count + kElementsOfBlock - 1) / kElementsOfBlock;
  if (blocks <= 1) return sum(std::size_t{0}, count);
  std::vector<double> part(blocks);
  const auto add_block = [&](std::size_t b) {
    part[b] = sum(b * kElementsOfBlock, std::min(count, (b + 1) * kElementsOfBlock));
  };
  if (blocks < kFewestBlocks) {
    for (std::size_t b = 0; b < blocks; ++b) add_block(b);
  } else {
    parallel_for(blocks, add_block);
  }
  double total = 0.0;
  for (const double value : part) total += value;
  return total;
}

template <class Value>
void clear(std::span<Value> values) {
  for_blocks(values.size(), [&](std::size_t begin, std::size_t end) {
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(begin), values.begin() + static_cast<std::ptrdiff_t>(end),
              Value());
  });
}

template <class Value>
void copy_by_blocks(std::span<const Value> from, std::span<Value> to) {
  for_blocks(from.size(), [&](std::size_t begin, std::size_t end) {
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(begin), from.begin() + static_cast<std::ptrdiff_t>(end),
              to.begin() + static_cast<std::ptrdiff_t>(begin));
  });
}

/// values[i] = made(i) for a field that grows to count values.
template <class Values, class Make>
void fill_by_blocks(Values& values, std::size_t count, const Make& made) {
  values.resize(count);
  for_each_element(count, [&](std::size_t i) { values[i] = made(i); });
}

}  // namespace treadmark::kalker
