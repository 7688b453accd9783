// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/read_hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/subsurface_table.hpp"
#include "treadmark/io/tables/hdf5_origin.hpp"

namespace treadmark::io {

namespace {

constexpr std::size_t kMostPoints = std::size_t{1} << 24;  // of a sampled surface

Status status_of(const Hdf5GroupReader& group) {
  const std::string word = group.text("status");
  for (const Status status : {Status::ok, Status::no_contact, Status::not_converged, Status::failed})
    if (word == to_string(status)) return status;
  refuse_result(group, fmt::format("has the unknown status \"{}\"", word));
}

SampledSurface read_surface(const Hdf5GroupReader& group, const std::string& name) {
  SampledSurface s;
  s.name = name;
  s.body = group.text("body");
  s.closed = group.integer("closed") != 0;
  const std::vector<std::size_t> size = group.shape("x");
  const auto fits = [](std::size_t n) { return n > 0 && n <= kMostPoints; };
  if (size.size() != 2 || !fits(size[0]) || !fits(size[1]) || size[0] * size[1] > kMostPoints)
    refuse_result(group, fmt::format("has a surface {} that is no table of points", name));
  s.nu = static_cast<int>(size[0]);
  s.nv = static_cast<int>(size[1]);
  s.u = group.numbers("u", {size[0]});
  s.x = group.numbers("x", size);
  s.y = group.numbers("y", size);
  s.z = group.numbers("z", size);
  if (group.has("deviation")) s.deviation = group.numbers("deviation", size);
  if (s.body != "wheel" && s.body != "rail") refuse_result(group, fmt::format("has a surface of \"{}\"", s.body));
  return s;
}

std::uint64_t patch_id(const Hdf5GroupReader& group, const std::string& text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = from_chars(text.data(), end, value);
  if (failure != std::errc() || stop != end)
    refuse_result(group, fmt::format("has \"{}\" as the number of a patch", text));
  return value;
}

std::vector<Remark> read_remarks(const Hdf5GroupReader& group) {
  const std::vector<std::string> names = group.texts("remarks"), patches = group.texts("remark_patches"),
                                 texts = group.texts("remark_texts");
  if (patches.size() != names.size() || texts.size() != names.size())
    refuse_result(group, "has another number of remarks than of their texts");
  std::vector<Remark> out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::optional<RemarkKind> kind = remark_named(names[i]);
    if (!kind) refuse_result(group, fmt::format("has a remark \"{}\"", names[i]));
    out.push_back({*kind, static_cast<int>(patch_id(group, patches[i])), texts[i]});
  }
  return out;
}

CaseUncertainty read_uncertainty(const Hdf5GroupReader& group) {
  CaseUncertainty out;
  out.checked = group.integer("checked"), out.samples = group.integer("samples"), out.others = group.integer("others");
  out.why = group.text("why"), out.message = group.text("message");
  const std::vector<std::string> sources = group.texts("sources"), names = group.texts("numbers");
  if (sources.empty() || names.empty()) return out;
  const std::size_t count = names.size(), of = sources.size();
  const std::vector<double> source_sigma = group.numbers("source_sigma", {of}), value = group.numbers("value", {count}),
                            sigma = group.numbers("sigma", {count}), shares = group.numbers("shares", {count, of});
  const std::vector<std::uint8_t> sampled = group.bytes("sampled", {count});
  for (std::size_t k = 0; k < of; ++k) out.sources.push_back({sources[k], source_sigma[k]});
  for (std::size_t n = 0; n < count; ++n) {
    const auto first = shares.begin() + static_cast<std::ptrdiff_t>(n * of);
    out.numbers.push_back(
        {names[n], value[n], sigma[n], sampled[n] != 0, {first, first + static_cast<std::ptrdiff_t>(of)}});
  }
  return out;
}

}  // namespace

void refuse_result(const Hdf5GroupReader& where, const std::string& what) {
  throw Error(ErrorKind::input_data, "the file of results " + what, {where.file(), 0, 0},
              "give a file that this program wrote");
}

Pose read_pose(const Hdf5GroupReader& group, const std::string& name) {
  return {group.vector(name + "_origin"), group.matrix(name + "_rotation")};
}

CaseResult read_case(const Hdf5GroupReader& group) {
  CaseResult c;
  c.number = group.integer("number");
  c.status = status_of(group);
  c.message = group.text("message");
  if (group.has_attribute("remarks")) c.remarks = read_remarks(group);
  if (group.has_attribute("seconds")) c.seconds = group.number("seconds");
  for (const Block block : {Block::wheelset, Block::deflection, Block::roller}) read_block_if_there(group, block, c);
  c.loads = read_loads(group);
  // Early files name the same poses X_TW and X_TR.
  const char *wheel = "X_TA", *rail = "X_TS";
  if (!group.has_attribute("X_TA_origin")) wheel = "X_TW", rail = "X_TR";
  if (group.has_attribute(std::string(wheel) + "_origin"))
    c.bodies = CaseResult::Bodies{read_pose(group, wheel), read_pose(group, rail)};
  if (group.has_attribute("wheel_surface")) c.wheel_surface = group.text("wheel_surface");
  if (group.has_attribute("rail_surface")) c.rail_surface = group.text("rail_surface");
  if (group.has("uncertainty")) c.uncertainty = read_uncertainty(group.open_group("uncertainty"));
  for (int number = 1;; ++number) {
    const std::string name = fmt::format("patch_{}", number);
    if (!group.has(name)) return c;
    c.patches.push_back(read_patch(group.open_group(name)));
  }
}

std::vector<CaseResult> read_cases(const Hdf5GroupReader& parent) {
  std::vector<CaseResult> cases;
  for (const std::string& name : parent.names()) {
    if (!name.starts_with("case_")) continue;
    cases.push_back(read_case(parent.open_group(name)));
    if (name != fmt::format("case_{:04}", cases.back().number))
      refuse_result(parent, fmt::format("has case {} in {}", cases.back().number, name));
  }
  std::sort(cases.begin(), cases.end(), [](const CaseResult& a, const CaseResult& b) { return a.number < b.number; });
  return cases;
}

std::vector<SampledSurface> read_surfaces(const Hdf5GroupReader& parent) {
  std::vector<SampledSurface> out;
  if (!parent.has(kSurfaces)) return out;
  const Hdf5GroupReader all = parent.open_group(kSurfaces);
  for (const std::string& name : all.texts(kSurfaceNames)) out.push_back(read_surface(all.open_group(name), name));
  return out;
}

void require_format(const Hdf5GroupReader& root, const std::string& format) {
  if (!root.has_attribute("format")) refuse_result(root, "does not say what it holds");
  if (const std::string found = root.text("format"); found != format)
    refuse_result(root, fmt::format("holds \"{}\" where \"{}\" is read", found, format));
}

void check_surface_names(const Hdf5GroupReader& where, std::span<const CaseResult> cases,
                         std::span<const SampledSurface> surfaces) {
  for (const CaseResult& c : cases)
    for (const std::string* name : {&c.wheel_surface, &c.rail_surface})
      if (!name->empty() && surface_index(surfaces, *name) < 0)
        refuse_result(where, fmt::format("has no surface {}, which case {} names", *name, c.number));
}

RunResult read_hdf5(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const Hdf5GroupReader& root = file.root();
  require_format(root, kResultFormat);
  RunResult run;
  read_origin(root, run);
  run.threads = root.integer("threads");
  run.seconds = root.number("seconds");
  if (root.has_attribute("doubts")) run.doubts = root.texts("doubts");
  run.complete = root.integer("complete") != 0;
  run.cases_total = root.integer("cases_total");
  run.cases = read_cases(root);
  run.sampled = read_surfaces(root);
  check_surface_names(root, run.cases, run.sampled);
  return run;
}

namespace {

constexpr double kMostElements = 1e8;

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
  const auto count = [&](auto is) { return static_cast<int>(ranges::count_if(p.fields.state, is)); };
  p.ncon = count([](std::uint8_t state) { return state > 0; });
  p.nadh = count([](std::uint8_t state) { return state == kAdhesion; });
  p.nslip = count([](std::uint8_t state) { return state == kSlip; });
}

SubsurfaceBlock read_subsurface(const Hdf5GroupReader& group) {
  const std::vector<std::size_t> size = group.shape("x");
  if (size.size() != 3 ||
      ranges::any_of(size, [](std::size_t n) { return n == 0 || static_cast<double>(n) > kMostElements; }) ||
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
  for (const Block block : {Block::relative, Block::count, Block::heat, Block::rolling, Block::place, Block::local,
                            Block::shape, Block::refined})
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
