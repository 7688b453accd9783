// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/write_hdf5.hpp"

#include <fmt/format.h>

#include <string>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/results/attributes.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/file_layout.hpp"
#include "treadmark/io/results/subsurface_table.hpp"

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
  AtomicFile target(path);
  Hdf5Writer file(target.temporary(), path.string());
  file.root().add(attributes_of(run));
  for (const CaseResult& result : run.cases)
    write_case(file.root().make_group(fmt::format("case_{:04}", result.number)), result, CaseTimes::written);
  write_surfaces(file.root(), run.sampled);
  file.close();
  target.commit();
}

}  // namespace treadmark::io
