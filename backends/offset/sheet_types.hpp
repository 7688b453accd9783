// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace treadmark::offset {

constexpr int kBlockI = 8, kBlockJ = 64;  ///< voxels of a block, one OpenVDB leaf

/// Values of one block, index = (i mod 8) * 64 + (j mod 64).
using Block = std::array<float, std::size_t{kBlockI} * kBlockJ>;

struct BlockKey {
  std::int32_t bi = 0, bj = 0;  ///< i / 8 and j / 64, rounded down
  // clang-tidy 14 takes its comparisons with zero for pointers
  friend auto operator<=>(const BlockKey&, const BlockKey&) = default;  // NOLINT(modernize-use-nullptr)
};

/// A stored block; the values are those of the grid.
struct SheetEntry {
  BlockKey key;
  const float* values;
};

/// Name of the grid in a file.
constexpr const char* kGridName = "treadmark_offsets";
/// Its entry 'format', by which it is known whatever it is called.
constexpr const char* kOffsetFormat = "treadmark offsets 1";

}  // namespace treadmark::offset
