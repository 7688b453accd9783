// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cstddef>

#include "treadmark/core/parallel.hpp"

namespace treadmark {

/// parallel_for for blocks of successive numbers in [0, count): body(begin, end) for each of `block` numbers, the last
/// one of what is left.
template <class Body>
void parallel_blocks(std::size_t count, std::size_t block, const Body& body) {
  parallel_for((count + block - 1) / block, [&](std::size_t k) { body(k * block, std::min(count, (k + 1) * block)); });
}

}  // namespace treadmark
