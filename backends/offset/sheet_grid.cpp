// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/sheet_grid.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/backends/offset/vdb_file.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/helper_process.hpp"

namespace treadmark::offset {

std::size_t SheetGrid::insert(const BlockKey& key, const Block& values, float tolerance) {
  const auto beyond = [tolerance](float v) { return std::fabs(v) > tolerance; };
  const auto active = static_cast<std::size_t>(std::count_if(values.begin(), values.end(), beyond));
  if (active == 0) return 0;
  Block& block = own_[key];
  for (std::size_t k = 0; k < values.size(); ++k)
    if (beyond(values[k])) block[k] = values[k];
  return active;
}

const float* SheetGrid::block(const BlockKey& key) const {
  if (!lent_.empty()) {
    const auto found =
        std::lower_bound(lent_.begin(), lent_.end(), key, [](const Entry& a, const BlockKey& b) { return a.key < b; });
    return found != lent_.end() && found->key == key ? found->values : nullptr;
  }
  const auto found = own_.find(key);
  return found == own_.end() ? nullptr : found->second.data();
}

std::vector<SheetGrid::Entry> SheetGrid::blocks() const {
  if (!lent_.empty()) return lent_;
  std::vector<Entry> all;
  all.reserve(own_.size());
  for (const auto& [key, block] : own_) all.push_back({key, block.data()});
  return all;
}

std::size_t SheetGrid::active_count() const {
  std::size_t count = 0;
  for (const Entry& b : blocks())
    count += kBlockI * kBlockJ - static_cast<std::size_t>(std::count(b.values, b.values + kBlockI * kBlockJ, 0.0f));
  return count;
}

std::size_t SheetGrid::memory_bytes() const {
  constexpr std::size_t kNode = sizeof(std::pair<const BlockKey, Block>) + 4 * sizeof(void*);
  return sizeof(*this) + own_.size() * kNode + lent_.size() * (sizeof(Entry) + sizeof(Block));
}

std::string sheet_bytes(const SheetGrid& grid, const SheetFile& frame) {
  std::unique_ptr<Channel> channel = start_openvdb({});
  std::string fault, bytes;
  talk_to(
      channel,
      [&](Channel& c) {
        c.put(VdbTask::write);
        c.put(std::array<double, 4>{frame.u0, frame.y0, frame.du, frame.dy});
        put(c, frame.metadata);
        const std::vector<SheetEntry> blocks = grid.blocks();
        c.put(static_cast<std::int64_t>(blocks.size()));
        SheetBlock one;
        for (const SheetEntry& b : blocks) {
          one.key = b.key;
          std::copy_n(b.values, one.values.size(), one.values.begin());
          c.put(one);
        }
        fault = c.take_list<std::string>();
        if (fault.empty()) bytes = c.take_list<std::string>();
      },
      [] { return Error(ErrorKind::configuration, "OpenVDB broke down over offsets that were to be written"); });
  if (!fault.empty()) throw Error(ErrorKind::configuration, fault);
  return bytes;
}

}  // namespace treadmark::offset
