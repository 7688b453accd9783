// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/backends/offset/sheet_types.hpp"

namespace treadmark::offset {

class SheetStorage;

/// Sparse float values on voxels (i, j), background 0, in an OpenVDB grid. A sheet one voxel thick would waste 7/8 of
/// each leaf, so voxel (i, j) is stored at (i, j / 8, j mod 8): a leaf then holds 8 x 64 voxels of the sheet side by
/// side. Building is not thread-safe, reading is.
class SheetGrid {
 public:
  SheetGrid();
  ~SheetGrid();
  SheetGrid(SheetGrid&&) noexcept;
  SheetGrid& operator=(SheetGrid&&) noexcept;

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
  std::size_t memory_bytes() const;  ///< the whole tree

 private:
  std::unique_ptr<SheetStorage> storage_;
};

/// A sheet as it lies in a file: voxel (i, j, 0) at (u0 + i du, y0 + j dy).
struct SheetFile {
  SheetGrid grid;
  double u0 = 0.0, y0 = 0.0, du = 1.0, dy = 1.0;
  std::map<std::string, std::string> metadata;
};
/// The bytes of a VDB file. Errors: Error(configuration) for steps that such a file cannot hold.
std::string sheet_bytes(const SheetGrid& grid, const SheetFile& frame);
/// data: the bytes of a VDB file, which may be hostile: time and memory stay in proportion to them. file: its name for
/// messages. Errors: Error(input_data) for everything that is not a finite sheet of floats as sheet_bytes makes it.
SheetFile read_sheet(std::string_view data, const std::filesystem::path& file);

}  // namespace treadmark::offset
