// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/offset/sheet_grid.hpp"

namespace treadmark::offset {

/// The blocks looked at lately, so that neighbouring points do not descend the tree again. One object serves one thread.
class BlockCache {
 public:
  explicit BlockCache(const SheetGrid& grid) : grid_(grid) {
    for (Slot& s : slots_) s.key = {kNowhere, kNowhere};
  }

  const float* get(std::int32_t bi, std::int32_t bj) {
    Slot& s = slots_[((bi & 7) << 2) | (bj & 3)];
    if (s.key.bi != bi || s.key.bj != bj) s = {{bi, bj}, grid_.block({bi, bj})};
    return s.values;
  }
  float value(int i, int j) {
    const float* b = get(i >> 3, j >> 6);
    return b == nullptr ? 0.0f : b[((i & 7) << 6) | (j & 63)];
  }

 private:
  static constexpr std::int32_t kNowhere = INT32_MIN;
  struct Slot {
    BlockKey key;
    const float* values = nullptr;
  };
  const SheetGrid& grid_;
  Slot slots_[32];
};

}  // namespace treadmark::offset
