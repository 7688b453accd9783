// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/offset/sheet_grid.hpp"

namespace treadmark::offset {

/// Where the blocks of a grid lie: a table over their bounding rectangle, or, if that would be mostly empty, a sorted
/// list. The grid must outlive it and stay as it is.
class BlockDirectory {
 public:
  explicit BlockDirectory(const SheetGrid& grid);

  const float* get(std::int32_t bi, std::int32_t bj) const {
    if (table_.empty()) return seek(bi, bj);
    const unsigned i = static_cast<unsigned>(bi) - static_cast<unsigned>(first_.bi),
                   j = static_cast<unsigned>(bj) - static_cast<unsigned>(first_.bj);
    if (i >= static_cast<unsigned>(bi_count_) || j >= static_cast<unsigned>(bj_count_)) return nullptr;
    return table_[static_cast<std::size_t>(i) * static_cast<std::size_t>(bj_count_) + j];
  }
  float value(int i, int j) const {
    const float* b = get(i >> 3, j >> 6);
    return b == nullptr ? 0.0f : b[((i & 7) << 6) | (j & 63)];
  }

  const float* const* table() const { return table_.empty() ? nullptr : table_.data(); }
  BlockKey first() const { return first_; }
  std::int32_t bi_count() const { return bi_count_; }
  std::int32_t bj_count() const { return bj_count_; }
  std::size_t memory_bytes() const {
    return table_.capacity() * sizeof(table_[0]) + list_.capacity() * sizeof(SheetGrid::Entry);
  }

 private:
  const float* seek(std::int32_t bi, std::int32_t bj) const;

  BlockKey first_;
  std::int32_t bi_count_ = 0, bj_count_ = 0;
  std::vector<const float*> table_;
  std::vector<SheetGrid::Entry> list_;  ///< if there is no table
};

}  // namespace treadmark::offset
