// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/backends/offset/vdb_tree_reader.hpp"

namespace treadmark::offset {

namespace {

class SheetReader final : public VdbTreeReader {
 public:
  SheetReader(std::string_view data, const std::filesystem::path& file)
      : VdbTreeReader(data, file, "the offsets", "offsets come from treadmark convert or import, as .vdb") {}

  SheetFile read() {
    std::optional<Descriptor> chosen;
    std::string others;  // what the first of them is
    const std::vector<Descriptor> all = grids();
    for (const Descriptor& grid : all) {
      if (is_offsets(grid)) {
        if (chosen)
          refuse("the VDB file holds several grids of offsets: " + chosen->title() + " and " + grid.title(),
                 "keep one of them");
        chosen = grid;
      } else if (others.empty()) {
        others = what_is(grid);
      }
    }
    if (!chosen)
      refuse(fmt::format("the VDB file holds no grid of offsets, but {}{}", others,
                         all.size() > 1 ? fmt::format(" and {} more", all.size() - 1) : ""));
    if (const std::string kind = chosen->kind(); !kind.empty() && kind != "unknown")
      refuse(fmt::format("the grid {} of the VDB file is a {}, not offsets", chosen->title(), short_name(kind)),
             "its class must be unknown");
    read_grid(*chosen);
    sheet_.metadata = metadata_of_grid();
    return std::move(sheet_);
  }

 private:
  static bool is_offsets(const Descriptor& grid) {
    const auto format = grid.metadata.find("format");
    return grid.name == kGridName || (format != grid.metadata.end() && format->second == kOffsetFormat);
  }

  void take_transform(const Transform& t) override {
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column)
        if (row != column && t.matrix[row][column] != 0.0)
          refuse("the transform of the offsets must not rotate or shear");
    sheet_.u0 = t.shift[0], sheet_.y0 = t.shift[1], sheet_.du = t.matrix[0][0], sheet_.dy = t.matrix[1][1];
    if (!(sheet_.du > 0.0) || !(sheet_.dy > 0.0) || !std::isfinite(sheet_.du + sheet_.dy + sheet_.u0 + sheet_.y0))
      refuse("the steps of the offsets must be positive");
  }

  void take_background(float background) override {
    if (background != 0.0f) refuse("the background of the offsets must be 0");
  }

  void take_leaf(const Leaf& leaf) override {
    Block block{};
    std::size_t next = 0;
    for_each_on(leaf.active, [&](unsigned n) {
      const auto coordinate = [&](unsigned axis) {
        return leaf.origin[axis] + static_cast<std::int32_t>(n >> (3 * (2 - axis)) & (kLeafSize - 1));
      };
      const std::int32_t i = coordinate(0), j = coordinate(1);
      if (coordinate(2) != 0) refuse("the offsets must be a sheet at k = 0");
      if (std::min(i, j) < -kFarthest || std::max(i, j) > kFarthest) refuse_far();
      const float value = leaf.values[leaf.all ? n : next++];
      if (!std::isfinite(value)) refuse("an offset is not a number");
      block[static_cast<std::size_t>((i & (kBlockI - 1)) * kBlockJ + (j & (kBlockJ - 1)))] = value;
    });
    sheet_.grid.insert({leaf.origin[0] >> 3, leaf.origin[1] >> 6}, block, 0.0f);
  }

  SheetFile sheet_;
};

}  // namespace

SheetFile read_sheet(std::string_view data, const std::filesystem::path& file) {
  return SheetReader(data, file).read();
}

}  // namespace treadmark::offset
