// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/backends/offset/vdb_file.hpp"

namespace treadmark::offset {

namespace {

bool is_offsets(const VdbGrid& grid) {
  const auto format = grid.metadata.find("format");
  return grid.name == kGridName || (format != grid.metadata.end() && format->second == kOffsetFormat);
}

std::size_t chosen_sheet(const VdbFile& vdb) {
  std::optional<std::size_t> chosen;
  std::string others;  // what the first of them is
  for (std::size_t k = 0; k < vdb.grids().size(); ++k) {
    const VdbGrid& grid = vdb.grids()[k];
    if (is_offsets(grid)) {
      if (chosen)
        vdb.refuse(
            "the VDB file holds several grids of offsets: " + title_of(vdb.grids()[*chosen]) + " and " + title_of(grid),
            "keep one of them");
      chosen = k;
    } else if (others.empty()) {
      others = what_is(grid);
    }
  }
  if (!chosen)
    vdb.refuse(fmt::format("the VDB file holds no grid of offsets, but {}{}", others,
                           vdb.grids().size() > 1 ? fmt::format(" and {} more", vdb.grids().size() - 1) : ""));
  const VdbGrid& grid = vdb.grids()[*chosen];
  if (const std::string kind = kind_of(grid); !kind.empty() && kind != "unknown")
    vdb.refuse(fmt::format("the grid {} of the VDB file is a {}, not offsets", title_of(grid), shortened(kind)),
               "its class must be unknown");
  return *chosen;
}

void take_frame(const VdbFile& vdb, const VdbGrid& grid, SheetFile& sheet) {
  const std::array<double, 12>& t = grid.to_world;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      if (row != column && t[3 * row + column] != 0.0)
        vdb.refuse("the transform of the offsets must not rotate or shear");
  sheet.u0 = t[9], sheet.y0 = t[10], sheet.du = t[0], sheet.dy = t[4];
}

}  // namespace

SheetFile read_sheet(VdbFile vdb) {
  const std::size_t number = chosen_sheet(vdb);
  SheetFile sheet;
  sheet.metadata = vdb.grids()[number].metadata;
  take_frame(vdb, vdb.grids()[number], sheet);
  const VdbContent content = vdb.content(number);
  if (content.background != 0.0f) vdb.refuse("the background of the offsets must be 0");
  for (const VdbLeaf& leaf : content.leaves) {
    Block block{};
    for_each_active(leaf, [&](unsigned n) {
      if (leaf.first[2] != 0 || n % 8 != 0) vdb.refuse("the offsets must be a sheet at k = 0");
      const std::int32_t j = leaf.first[1] + static_cast<std::int32_t>(n / 8 % 8);
      if (!std::isfinite(leaf.value[n])) vdb.refuse("an offset is not a number");
      block[n / 64 * kBlockJ + static_cast<std::size_t>(j & (kBlockJ - 1))] = leaf.value[n];
    });
    sheet.grid.insert({leaf.first[0] >> 3, leaf.first[1] >> 6}, block, 0.0f);
  }
  return sheet;
}

}  // namespace treadmark::offset
