// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/backends/offset/sheet_types.hpp"

namespace treadmark::offset {

class VdbFile;

/// Sparse float values on voxels (i, j), background 0, in blocks. Building is not thread-safe, reading is.
class SheetGrid {
 public:
  SheetGrid() = default;
  /// Blocks, ordered by key, in the memory of another object, which is kept. Nothing is inserted.
  SheetGrid(std::shared_ptr<const void> owner, std::vector<SheetEntry> blocks)
      : owner_(std::move(owner)), lent_(std::move(blocks)) {}
  SheetGrid(SheetGrid&&) noexcept = default;
  SheetGrid& operator=(SheetGrid&&) noexcept = default;

  /// Values with |value| > tolerance become active, the others stay as they are (0); a block without any
  /// is not stored.
  /// Returns how many are active.
  std::size_t insert(const BlockKey& key, const Block& values, float tolerance);

  /// 512 values as in Block, or nullptr where all are 0.
  const float* block(const BlockKey& key) const;
  float value(int i, int j) const {
    const float* b = block({i >> 3, j >> 6});
    return b == nullptr ? 0.0f : b[((i & 7) << 6) | (j & 63)];
  }

  using Entry = SheetEntry;
  /// All stored blocks, ordered by key.
  std::vector<Entry> blocks() const;

  std::size_t active_count() const;
  std::size_t memory_bytes() const;

 private:
  std::map<BlockKey, Block> own_;  ///< whose places stay, also where the grid is moved
  std::shared_ptr<const void> owner_;
  std::vector<Entry> lent_;
};

/// A sheet as it lies in a file: voxel (i, j, 0) at (u0 + i du, y0 + j dy).
struct SheetFile {
  SheetGrid grid;
  double u0 = 0.0, y0 = 0.0, du = 1.0, dy = 1.0;
  Metadata metadata;
  std::optional<SheetGrid> cubic = {};  ///< as of SparseOffsets
};
/// The bytes of a VDB file. Errors: Error(configuration) for steps that such a file cannot hold; those of
/// start_openvdb.
std::string sheet_bytes(const SheetGrid& grid, const SheetFile& frame);
/// Errors: Error(input_data) for everything that is not a finite sheet of numbers as sheet_bytes makes it.
SheetFile read_sheet(VdbFile vdb);

}  // namespace treadmark::offset
