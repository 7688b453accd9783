// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "treadmark/backends/offset/sheet_types.hpp"
#include "treadmark/core/channel.hpp"

namespace treadmark::offset {

/// What Treadmark asks the program that holds OpenVDB (core/helper_process.hpp), one task a run. Every answer begins
/// with what is wrong, a text; where it is empty the rest follows.
enum class VdbTask : std::int64_t {
  read,     ///< file, how many bytes of it count: its grids (VdbGrid); then the number of one: background, whether
            ///< there are active tiles, leaves with an active voxel
  write,    ///< u0, y0, du, dy, entries and blocks of a sheet: the bytes of a file
  nearest,  ///< vertices [voxels] and corners of triangles, half width of a band about them [voxels], threads:
            ///< NearestBlock, by their first nodes
};

/// What a grid says of itself.
struct VdbGrid {
  std::string name = {}, type = {};  ///< type: "Tree_float_5_4_3", also of half precision
  Metadata metadata = {};
  std::int64_t linear = 0;            ///< whether its transform is
  std::array<double, 12> to_world{};  ///< voxel . three rows + the fourth one = place
};

/// Voxel (i, j, k) of a leaf has the index 64 i + 8 j + k.
struct VdbLeaf {
  std::array<std::int32_t, 3> first{};    ///< its first voxel
  std::int32_t unused = 0;                ///< no byte is sent that nobody has set
  std::array<std::uint64_t, 8> active{};  ///< word i, bit 8 j + k
  std::array<float, 512> value{};
};

struct SheetBlock {
  BlockKey key = {};
  Block values = {};
};

/// The triangles nearest to the nodes of one leaf.
struct NearestBlock {
  std::array<std::int32_t, 3> first{};       ///< its first node
  std::array<std::int32_t, 512> triangle{};  ///< index as of VdbLeaf; -1: none is within the band
};

inline void put(Channel& c, const Metadata& entries) {
  c.put(static_cast<std::int64_t>(entries.size()));
  for (const auto& [name, text] : entries) {
    c.put_list(name);
    c.put_list(text);
  }
}

inline Metadata take_entries(Channel& c) {
  Metadata entries;
  for (auto left = c.take<std::int64_t>(); left > 0; --left) {
    auto name = c.take_list<std::string>();
    entries[std::move(name)] = c.take_list<std::string>();
  }
  return entries;
}

inline void put(Channel& c, const VdbGrid& grid) {
  c.put_list(grid.name);
  c.put_list(grid.type);
  put(c, grid.metadata);
  c.put(grid.linear);
  c.put(grid.to_world);
}

inline VdbGrid take_grid(Channel& c) {
  VdbGrid grid;
  grid.name = c.take_list<std::string>();
  grid.type = c.take_list<std::string>();
  grid.metadata = take_entries(c);
  grid.linear = c.take<std::int64_t>();
  grid.to_world = c.take<std::array<double, 12>>();
  return grid;
}

}  // namespace treadmark::offset
