// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/read_patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/results/read_quantities.hpp"
#include "treadmark/io/results/subsurface_table.hpp"

namespace treadmark::io {
namespace {

constexpr double kMostElements = 1e8;

std::uint64_t patch_id(const Hdf5GroupReader& group, const std::string& text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc() || stop != end)
    refuse_result(group, fmt::format("has \"{}\" as the number of a patch", text));
  return value;
}

void read_identity(const Hdf5GroupReader& group, PatchResult& p) {
  p.id = patch_id(group, group.text("id"));
  for (const std::string& one : group.texts("came_from")) p.came_from.push_back(patch_id(group, one));
}

Grid2 read_grid(const Hdf5GroupReader& group) {
  const Grid2 grid{group.number("x0"), group.number("s0"),  group.number("dx"),
                   group.number("ds"), group.integer("nx"), group.integer("ny")};
  if (grid.nx < 0 || grid.ny < 0 || static_cast<double>(grid.nx) * grid.ny > kMostElements)
    refuse_result(group, fmt::format("has a patch of {} by {} elements", grid.nx, grid.ny));
  const bool placed =
      std::isfinite(grid.x0) && std::isfinite(grid.y0) && std::isfinite(grid.dx) && std::isfinite(grid.dy);
  if (grid.size() > 0 && !(placed && grid.dx > 0.0 && grid.dy > 0.0))
    refuse_result(group, "has a patch whose elements have no size");
  return grid;
}

void read_fields(const Hdf5GroupReader& group, PatchResult& p) {
  PatchFields& fields = p.fields;
  fields.grid = read_grid(group);
  fields.X_TC = {group.vector("X_TC_origin"), group.matrix("X_TC_rotation")};
  p.npot = static_cast<int>(fields.grid.size());
  if (fields.grid.size() == 0) return;
  const auto rows = static_cast<std::size_t>(fields.grid.ny), columns = static_cast<std::size_t>(fields.grid.nx);
  const std::vector<std::size_t> shape{rows, columns};
  for (const FieldColumn& column : kFieldColumns)
    if (const std::string name(column.name); group.has(name)) fields.*column.values = group.numbers(name, shape);
  if (group.has("row_angle")) fields.row_angle = group.numbers("row_angle", {rows});
  if (group.has("state")) fields.state = group.bytes("state", shape);
}

/// Older files do not count their elements.
void count_elements(const Hdf5GroupReader& group, PatchResult& p) {
  if (group.has_attribute("elements_in_contact")) return;
  constexpr std::uint8_t kAdhesion = 1, kSlip = 2;
  const auto count = [&](auto is) { return static_cast<int>(std::ranges::count_if(p.fields.state, is)); };
  p.ncon = count([](std::uint8_t state) { return state > 0; });
  p.nadh = count([](std::uint8_t state) { return state == kAdhesion; });
  p.nslip = count([](std::uint8_t state) { return state == kSlip; });
}

SubsurfaceBlock read_subsurface(const Hdf5GroupReader& group) {
  const std::vector<std::size_t> size = group.shape("x");
  if (size.size() != 3 ||
      std::ranges::any_of(size, [](std::size_t n) { return n == 0 || static_cast<double>(n) > kMostElements; }) ||
      static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(size[2]) > kMostElements)
    refuse_result(group, "has a block below the surface that is no box of points");
  SubsurfaceBlock block{static_cast<int>(size[2]), static_cast<int>(size[1]), static_cast<int>(size[0]), {}};
  std::vector<std::vector<double>> columns;
  for (const SubsurfaceColumn& column : kSubsurfaceColumns) {
    std::vector<std::size_t> shape = size;
    if (column.components > 1) shape.push_back(static_cast<std::size_t>(column.components));
    columns.push_back(group.numbers(std::string(column.name), shape));
  }
  block.values.resize(size[0] * size[1] * size[2]);
  for (std::size_t k = 0; k < kSubsurfaceColumns.size(); ++k) {
    const auto components = static_cast<std::size_t>(kSubsurfaceColumns[k].components);
    for (std::size_t i = 0; i < block.values.size(); ++i)
      kSubsurfaceColumns[k].put(columns[k].data() + i * components, block.values[i]);
  }
  return block;
}

void read_blocks(const Hdf5GroupReader& group, PatchResult& p) {
  if (!group.has("subsurface")) return;
  const Hdf5GroupReader parent = group.open_group("subsurface");
  for (int number = 1;; ++number) {
    const std::string name = fmt::format("block{}", number);
    if (!parent.has(name)) return;
    p.subsurface.push_back(read_subsurface(parent.open_group(name)));
  }
}

}  // namespace

std::optional<Loads> read_loads(const Hdf5GroupReader& group) {
  if (!group.has_attribute("load_force_track")) return {};
  const auto one = [&](const std::string& axes) {
    return Load{group.vector("load_force_" + axes), group.vector("load_moment_" + axes)};
  };
  return Loads{one("track"), one("rail"), one("wheelset"), one("wheel")};
}

PatchResult read_patch(const Hdf5GroupReader& group) {
  PatchResult p;
  p.shift = group.integer("shift") != 0;
  for (const Block block : {Block::force, Block::creepage, Block::approach, Block::pressure, Block::energy})
    read_block(group, block, p);
  for (const Block block : {Block::relative, Block::count, Block::heat, Block::rolling, Block::place, Block::local})
    read_block_if_there(group, block, p);
  if (p.has_reference) {
    for (const Block block : {Block::angle, Block::in_grid, Block::arc}) read_block(group, block, p);
    read_identity(group, p);
  }
  p.loads = read_loads(group);
  read_fields(group, p);
  count_elements(group, p);
  read_blocks(group, p);
  return p;
}

}  // namespace treadmark::io
