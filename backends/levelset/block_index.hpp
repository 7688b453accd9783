// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace treadmark::levelset {

/// Blocks that one thread looks at.
inline constexpr std::size_t kBlocksAtOnce = 16;

/// Numbers of blocks, or of anything, by three whole coordinates.
class BlockIndex {
 public:
  using Place = std::array<std::int32_t, 3>;

  explicit BlockIndex(std::size_t count) { numbers_.reserve(count); }
  void put(const Place& at, std::uint32_t number) { numbers_.insert_or_assign(at, number); }
  /// -1: nothing is there.
  std::int32_t find(const Place& at) const {
    const auto found = numbers_.find(at);
    return found == numbers_.end() ? -1 : static_cast<std::int32_t>(found->second);
  }

  /// Spreads places that differ in few bits.
  struct Hash {
    std::size_t operator()(const Place& p) const {
      std::uint64_t h = 0;
      for (const std::int32_t x : p) h = (h ^ static_cast<std::uint32_t>(x)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
      return static_cast<std::size_t>(h);
    }
  };

 private:
  std::unordered_map<Place, std::uint32_t, Hash> numbers_;
};

}  // namespace treadmark::levelset
