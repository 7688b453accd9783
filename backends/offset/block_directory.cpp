// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/block_directory.hpp"

#include <algorithm>
#include <utility>

namespace treadmark::offset {

BlockDirectory::BlockDirectory(const SheetGrid& grid) {
  constexpr std::int64_t kSmall = 4096, kMostPerBlock = 16;
  std::vector<SheetGrid::Entry> all = grid.blocks();
  if (all.empty()) return;
  first_ = all.front().key;
  BlockKey last = first_;
  for (const SheetGrid::Entry& one : all) {
    first_ = {std::min(first_.bi, one.key.bi), std::min(first_.bj, one.key.bj)};
    last = {std::max(last.bi, one.key.bi), std::max(last.bj, one.key.bj)};
  }
  const std::int64_t ni = static_cast<std::int64_t>(last.bi) - first_.bi + 1,
                     nj = static_cast<std::int64_t>(last.bj) - first_.bj + 1;
  if (ni * nj > std::max(kSmall, kMostPerBlock * static_cast<std::int64_t>(all.size()))) {
    list_ = std::move(all);
    return;
  }
  bi_count_ = static_cast<std::int32_t>(ni), bj_count_ = static_cast<std::int32_t>(nj);
  table_.assign(static_cast<std::size_t>(ni * nj), nullptr);
  for (const SheetGrid::Entry& one : all)
    table_[static_cast<std::size_t>((one.key.bi - first_.bi) * nj + one.key.bj - first_.bj)] = one.values;
}

const float* BlockDirectory::seek(std::int32_t bi, std::int32_t bj) const {
  const BlockKey key{bi, bj};
  const auto found = std::lower_bound(list_.begin(), list_.end(), key,
                                      [](const SheetGrid::Entry& a, const BlockKey& b) { return a.key < b; });
  return found != list_.end() && found->key == key ? found->values : nullptr;
}

}  // namespace treadmark::offset
