// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/attributes.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

#include "treadmark/io/results/file_layout.hpp"
#include "treadmark/io/results/quantities.hpp"

namespace treadmark::io {
namespace {

void add_loads(std::vector<Attribute>& list, const Loads& loads) {
  const std::pair<const char*, const Load&> sides[] = {
      {"track", loads.track}, {"rail", loads.rail}, {"wheelset", loads.wheelset}, {"wheel", loads.wheel}};
  for (const auto& [name, load] : sides) {
    list.push_back({std::string("load_force_") + name, load.force});
    list.push_back({std::string("load_moment_") + name, load.moment});
  }
}

template <class T>
void add_blocks(std::vector<Attribute>& list, const T& item, std::initializer_list<Block> blocks) {
  for (const Block block : blocks) {
    if (!has_block(item, block)) continue;
    for_each_stored<T>(block, [&](std::span<const Quantity<T>> rows) {
      const Quantity<T>& first = rows.front();
      if (!first.has(item)) return;
      Attribute::Value value = first.access.get(item);
      if (first.access.whole) value = static_cast<int>(first.access.get(item));
      if (first.stored.component >= 0) {
        Vec3 vector = Vec3::Zero();
        for (const Quantity<T>& row : rows) vector[row.stored.component] = row.access.get(item);
        value = vector;
      }
      list.push_back({std::string(first.stored.name), std::move(value)});
    });
  }
}

}  // namespace

std::vector<Attribute> attributes_of(const PatchResult& patch) {
  std::vector<Attribute> list;
  const auto add = [&](std::string name, Attribute::Value value) {
    list.push_back({std::move(name), std::move(value)});
  };
  const Grid2& grid = patch.fields.grid;
  add("frame", "x, s, n: s along the rail profile, n into the rail; X_TC places it in track axes");
  add("X_TC_origin", patch.fields.X_TC.origin);
  add("X_TC_rotation", patch.fields.X_TC.rotation);
  add("nx", grid.nx);
  add("ny", grid.ny);
  add("shift", patch.shift ? 1 : 0);
  add("x0", grid.x0);
  add("s0", grid.y0);
  add("dx", grid.dx);
  add("ds", grid.dy);
  add_blocks(list, patch,
             {Block::force, Block::creepage, Block::approach, Block::pressure, Block::energy, Block::relative,
              Block::count, Block::heat, Block::rolling, Block::place, Block::angle, Block::in_grid});
  if (patch.has_reference) {
    add("id", fmt::format("{}", patch.id));
    std::vector<std::string> from;
    for (const std::uint64_t one : patch.came_from) from.push_back(fmt::format("{}", one));
    add("came_from", from);
  }
  add_blocks(list, patch, {Block::arc});
  if (patch.loads) add_loads(list, *patch.loads);
  add_blocks(list, patch, {Block::local});
  return list;
}

std::vector<Attribute> attributes_of(const CaseResult& result) {
  std::vector<Attribute> list;
  const auto add = [&](std::string name, Attribute::Value value) {
    list.push_back({std::move(name), std::move(value)});
  };
  add("number", result.number);
  add("status", std::string(to_string(result.status)));
  add("message", result.message);
  add("seconds", result.seconds);
  add_blocks(list, result, {Block::wheelset});
  if (result.loads) add_loads(list, *result.loads);
  add_blocks(list, result, {Block::deflection, Block::roller});
  if (result.bodies) {
    add("X_TA_origin", result.bodies->X_TA.origin);
    add("X_TA_rotation", result.bodies->X_TA.rotation);
    add("X_TS_origin", result.bodies->X_TS.origin);
    add("X_TS_rotation", result.bodies->X_TS.rotation);
  }
  if (!result.wheel_surface.empty()) add("wheel_surface", result.wheel_surface);
  if (!result.rail_surface.empty()) add("rail_surface", result.rail_surface);
  return list;
}

std::vector<Attribute> attributes_of(const RunResult& run) {
  std::vector<Attribute> list;
  const auto add = [&](std::string name, Attribute::Value value) {
    list.push_back({std::move(name), std::move(value)});
  };
  add("format", kResultFormat);
  add("units", "SI");
  add("axes", kAxes);
  add("version", run.version);
  add("git", run.git);
  add("threads", run.threads);
  add("seconds", run.seconds);
  add("input", run.input_file);
  add("sha256", run.input_sha256);
  std::vector<std::string> files, hashes;
  for (const auto& [name, hash] : run.geometry_sha256) {
    files.push_back(name);
    hashes.push_back(hash);
  }
  add("geometry_files", files);
  add("geometry_sha256", hashes);
  add("settings", run.settings);
  add("complete", run.complete ? 1 : 0);
  add("cases_total", run.cases_total);
  return list;
}

}  // namespace treadmark::io
