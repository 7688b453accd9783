// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/write_hdf5.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/quantities.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/results/subsurface_table.hpp"
#include "treadmark/io/tables/hdf5_origin.hpp"

namespace treadmark::io {

namespace {

void write_fields(const Hdf5GroupWriter& group, const PatchResult& patch) {
  const PatchFields& fields = patch.fields;
  const Grid2& grid = fields.grid;
  if (grid.size() == 0) return;
  std::vector<double> x, s;
  for (int ix = 0; ix < grid.nx; ++ix) x.push_back(grid.x(ix));
  for (int iy = 0; iy < grid.ny; ++iy) s.push_back(grid.y(iy));
  const std::vector<std::size_t> size{s.size(), x.size()};
  group.write({"x", {x.size()}, "m", "element centres along the columns"}, x);
  group.write({"s", {s.size()}, "m", "element centres along the rows"}, s);
  for (const FieldColumn& column : kFieldColumns) {
    const std::vector<double>& values = fields.*column.values;
    if (values.empty()) continue;
    const std::string_view unit = patch.shift ? column.unit_shift : column.unit;
    group.write({std::string(column.name), size, std::string(unit), std::string(column.meaning), true}, values);
  }
  if (!fields.row_angle.empty())
    group.write(
        {"row_angle", {s.size()}, "rad", "inclination of the rows of a curved reference against the contact plane"},
        fields.row_angle);
  if (!fields.state.empty())
    group.write({"state", size, "1", "0 exterior, 1 adhesion, 2 slip, 3 plastic", true}, fields.state);
}

void write_subsurface(const Hdf5GroupWriter& patch_group, const std::vector<SubsurfaceBlock>& blocks) {
  if (blocks.empty()) return;
  const Hdf5GroupWriter parent = patch_group.make_group("subsurface");
  int number = 0;
  for (const SubsurfaceBlock& block : blocks) {
    const Hdf5GroupWriter group = parent.make_group(fmt::format("block{}", ++number));
    for (const SubsurfaceColumn& column : kSubsurfaceColumns) {
      std::vector<std::size_t> size;
      for (const int length : {block.nz, block.ny, block.nx}) size.push_back(static_cast<std::size_t>(length));
      if (column.components > 1) size.push_back(static_cast<std::size_t>(column.components));
      group.write({std::string(column.name), size, std::string(column.unit), std::string(column.meaning), true},
                  column_values(block, column));
    }
  }
}

void write_patch(const Hdf5GroupWriter& group, const PatchResult& patch) {
  group.add(attributes_of(patch));
  write_fields(group, patch);
  write_subsurface(group, patch.subsurface);
}

void write_uncertainty(const Hdf5GroupWriter& group, const CaseUncertainty& u) {
  const std::pair<const char*, int> counts[] = {{"checked", u.checked}, {"samples", u.samples}, {"others", u.others}};
  for (const auto& [name, count] : counts) group.add({name, count});
  group.add({"why", u.why});
  group.add({"message", u.message});
  std::vector<std::string> sources, names;
  std::vector<double> source_sigma, value, sigma, shares;
  std::vector<std::uint8_t> sampled;
  for (const CaseUncertainty::Source& s : u.sources) sources.push_back(s.name), source_sigma.push_back(s.sigma);
  for (const CaseUncertainty::Number& n : u.numbers) {
    names.push_back(n.name), value.push_back(n.value), sigma.push_back(n.sigma), sampled.push_back(n.sampled ? 1 : 0);
    // none where nothing is known of a number
    for (std::size_t k = 0; k < sources.size(); ++k) shares.push_back(k < n.shares.size() ? n.shares[k] : kNaN);
  }
  group.add({"sources", sources});
  group.add({"numbers", names});
  if (sources.empty() || names.empty()) return;
  const char* unit = "that of the name";
  group.write({"source_sigma", {sources.size()}, unit, "standard deviation of what is given; of heights in mm"},
              source_sigma);
  group.write({"value", {names.size()}, unit, "of numbers"}, value);
  group.write({"sigma", {names.size()}, unit, "standard deviation of numbers"}, sigma);
  group.write({"sampled", {names.size()}, "1", "from a sample; else by derivatives"}, sampled);
  group.write({"shares", {names.size(), sources.size()}, "1", "of each source in the variance; NaN: not known"},
              shares);
}

}  // namespace

void write_case(const Hdf5GroupWriter& group, const CaseResult& result, CaseTimes times) {
  for (const Attribute& attribute : attributes_of(result))
    if (times == CaseTimes::written || attribute.name != "seconds") group.add(attribute);
  int number = 0;
  for (const PatchResult& patch : result.patches) {
    ++number;
    check_field_sizes(patch.fields, result.number, number);
    check_blocks(patch.subsurface, fmt::format("case {}, patch {}: ", result.number, number));
    write_patch(group.make_group(fmt::format("patch_{}", number)), patch);
  }
  if (result.uncertainty) write_uncertainty(group.make_group("uncertainty"), *result.uncertainty);
}

void write_surfaces(const Hdf5GroupWriter& parent, std::span<const SampledSurface> surfaces) {
  check_surfaces(surfaces);
  if (surfaces.empty()) return;
  const Hdf5GroupWriter all = parent.make_group(kSurfaces);
  std::vector<std::string> names;
  for (const SampledSurface& s : surfaces) names.push_back(s.name);
  all.add({kSurfaceNames, names});
  for (const SampledSurface& s : surfaces) {
    const Hdf5GroupWriter group = all.make_group(s.name);
    group.add({"body", s.body});
    group.add({"name", s.name});
    group.add({"closed", s.closed ? 1 : 0});
    const bool angle = s.body == "wheel" || s.closed;
    group.write({"u",
                 {s.u.size()},
                 angle ? "rad" : "m",
                 angle ? "stations: angle round the axle" : "stations: x along the rail"},
                s.u);
    const std::vector<std::size_t> size{s.u.size(), static_cast<std::size_t>(s.nv)};
    group.write({"x", size, "m", "forward, in the axes of the body; NaN where there is no surface", true}, s.x);
    group.write({"y", size, "m", "to the right", true}, s.y);
    group.write({"z", size, "m", "down", true}, s.z);
    if (!s.deviation.empty())
      group.write({"deviation", size, "m", "along the outward normal from the median of the sections", true},
                  s.deviation);
  }
}

void write_hdf5(const std::filesystem::path& path, const RunResult& run) {
  Hdf5Writer file(path);
  file.root().add(attributes_of(run));
  for (const CaseResult& result : run.cases)
    write_case(file.root().make_group(fmt::format("case_{:04}", result.number)), result, CaseTimes::written);
  write_surfaces(file.root(), run.sampled);
  file.commit();
}

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
  add_blocks(list, patch, {Block::arc, Block::shape, Block::refined});
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
  if (!result.remarks.empty()) {
    std::vector<std::string> names, patches, texts;
    for (const Remark& r : result.remarks) {
      names.emplace_back(r.row().name);
      patches.push_back(fmt::format("{}", r.patch));
      texts.push_back(r.text);
    }
    add("remarks", names);
    add("remark_patches", patches);
    add("remark_texts", texts);
  }
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
  std::vector<Attribute> list = origin_attributes(kResultFormat, run);
  const auto add = [&](std::string name, Attribute::Value value) {
    list.push_back({std::move(name), std::move(value)});
  };
  add("axes", kAxes);
  add("threads", run.threads);
  add("seconds", run.seconds);
  if (!run.doubts.empty()) add("doubts", run.doubts);
  add("complete", run.complete ? 1 : 0);
  add("cases_total", run.cases_total);
  return list;
}

}  // namespace treadmark::io
