// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace treadmark::offset {

/// Voxels of a block. A sheet one voxel thick would waste 7/8 of each leaf of OpenVDB and NanoVDB, 8 x 8 x 8 voxels, so
/// voxel (i, j) is thought to lie at (i, j / 8, j mod 8): a leaf then holds 8 x 64 voxels of the sheet side by side.
constexpr int kBlockI = 8, kBlockJ = 64;

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

/// Texts by their names.
using Metadata = std::map<std::string, std::string>;

/// Name of the grid in a file.
constexpr const char* kGridName = "treadmark_offsets";
/// Its entry 'format', by which it is known whatever it is called.
constexpr const char* kOffsetFormat = "treadmark offsets 1";

}  // namespace treadmark::offset
