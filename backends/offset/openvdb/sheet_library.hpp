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
#include <string_view>
#include <vector>

#include "treadmark/backends/offset/sheet_types.hpp"

namespace treadmark::offset {

/// Blocks in an OpenVDB tree; see SheetGrid, whose functions these are.
class SheetStorage {
 public:
  virtual ~SheetStorage() = default;
  virtual std::size_t insert(const BlockKey& key, const Block& values, float tolerance) = 0;
  virtual const float* block(const BlockKey& key) const = 0;
  virtual std::vector<SheetEntry> blocks() const = 0;
  virtual std::size_t active_count() const = 0;
  virtual std::size_t memory_bytes() const = 0;
};

/// What is wrong with a file, for an Error that the caller throws; no message: nothing.
struct SheetFault {
  enum class Kind { configuration, input_data };
  Kind kind = Kind::input_data;
  std::string message = {};
};

/// A sheet in a file: voxel (i, j, 0) at (u0 + i du, y0 + j dy).
struct SheetFrameAndData {
  double u0 = 0.0, y0 = 0.0, du = 1.0, dy = 1.0;
  std::map<std::string, std::string> metadata;
};

/// The triangles nearest to the nodes of one leaf.
struct NearestBlock {
  std::array<std::int32_t, 3> first;       ///< its first node
  std::array<std::int32_t, 512> triangle;  ///< [64 i + 8 j + k]; -1: none is within the band
};

/// What OpenVDB does for sheets and level sets. It lies in a library of its own, libtreadmark_openvdb, that is loaded
/// where offsets are first used: the dynamic linker takes longer for OpenVDB than most cases take to be solved. That
/// library knows nothing else of Treadmark. Functions may be called from several threads.
struct SheetLibrary {
  const char* version;  ///< of Treadmark; another one is not used
  std::unique_ptr<SheetStorage> (*make_storage)();
  SheetFault (*write)(std::string& bytes, const std::vector<SheetEntry>& blocks, const SheetFrameAndData& sheet);
  /// Values as they are stored after their length, by Blosc or zlib; whether they are this many bytes.
  bool (*unpack)(bool blosc, std::string_view stored, char* to, std::size_t size);
  /// Leaves with a node within the band of half this width [voxels] about triangles. vertices: x, y and z of each in
  /// voxels; corners: three of each triangle. Ordered by their first nodes.
  SheetFault (*nearest)(const double* vertices, std::size_t vertex_count, const std::uint32_t* corners,
                        std::size_t triangle_count, double half_width, std::vector<NearestBlock>& out);
};

/// Its one symbol, "treadmark_sheet_library".
extern "C" const SheetLibrary* treadmark_sheet_library();

/// Loads it at the first call. Errors: Error(configuration) naming the places where it was looked for: ../lib/treadmark
/// of the folder of the program, where it was built, where it was installed, and the program's run path.
const SheetLibrary& sheet_library();

}  // namespace treadmark::offset
