// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace treadmark::offset {

constexpr int kBlockI = 8, kBlockJ = 64;  ///< voxels of a block, one OpenVDB leaf

/// Values of one block, index = (i mod 8) * 64 + (j mod 64).
using Block = std::array<float, kBlockI * kBlockJ>;

struct BlockKey {
  std::int32_t bi = 0, bj = 0;  ///< i / 8 and j / 64, rounded down
  friend auto operator<=>(const BlockKey&, const BlockKey&) = default;
};

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

  struct Entry {
    BlockKey key;
    const float* values;
  };
  /// All stored blocks, ordered by key.
  std::vector<Entry> blocks() const;

  std::size_t active_count() const;
  std::size_t memory_bytes() const;  ///< the whole tree

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

/// A sheet as it lies in a file: voxel (i, j, 0) at (u0 + i du, y0 + j dy).
struct SheetFile {
  SheetGrid grid;
  double u0 = 0.0, y0 = 0.0, du = 1.0, dy = 1.0;
  std::map<std::string, std::string> metadata;
};
/// Name of the grid in the file.
constexpr const char* kGridName = "treadmark_offsets";

/// Errors: Error(configuration) if the file cannot be written.
void write_sheet(const std::filesystem::path& file, const SheetGrid& grid, const SheetFile& frame);
/// Errors: Error(input_data) for everything that is not a finite sheet of floats. The file must be known to be sound:
/// OpenVDB does not survive every damage.
SheetFile read_sheet(const std::filesystem::path& file);

}  // namespace treadmark::offset
