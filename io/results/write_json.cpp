// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/write_json.hpp"

#include <cmath>
#include <initializer_list>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/quantities.hpp"
#include "treadmark/io/tables/number.hpp"
#include "treadmark/io/tables/schema_of.hpp"

namespace treadmark::io {
namespace {

Json hashes(const std::vector<std::pair<std::string, std::string>>& files) {
  Json list = Json::array();
  for (const auto& [file, sha256] : files) list.push_back({{"file", file}, {"sha256", sha256}});
  return list;
}

constexpr const char* kResultSchema =
#include "treadmark/io/results/result.schema.json.in"
    ;

/// What add_quantities writes.
template <class T>
SchemaRows schema_rows_of() {
  SchemaRows out;
  for (const Quantity<T>& row : quantities<T>())
    if (!row.key.empty())
      out.push_back({name_of(row), row.access.whole ? "integer" : "number", !row.access.whole,
                     flag_of<T>(row.block) == nullptr && row.access.has == nullptr, std::string(row.meaning)});
  return out;
}

bool in_shift(const PatchResult& patch) { return patch.shift; }
bool in_shift(const CaseResult&) { return false; }

/// What is known of these blocks, in the order of the table.
template <class T>
void add_quantities(Json& out, const T& item, std::initializer_list<Block> blocks) {
  for (const Quantity<T>& row : quantities<T>()) {
    if (row.key.empty() || ranges::find(blocks, row.block) == blocks.end()) continue;
    if (!has_block(item, row.block) || !row.has(item)) continue;
    Json& target = row.object.empty() ? out : out[std::string(row.object)];
    const double value = row.access.get(item);
    target[std::string(row.key)] =
        row.access.whole ? Json(to_whole<int>(value)) : number(row.unit_in(in_shift(item)).in_file(value));
  }
}

Json load_json(const Load& load) {
  return {{"fx_N", number(load.force.x())},
          {"fy_N", number(load.force.y())},
          {"fz_N", number(load.force.z())},
          {"mx_Nmm", number(load.moment.x() * kMilli)},
          {"my_Nmm", number(load.moment.y() * kMilli)},
          {"mz_Nmm", number(load.moment.z() * kMilli)}};
}

Json loads_json(const Loads& loads) {
  return {{"track", load_json(loads.track)},
          {"rail", load_json(loads.rail)},
          {"wheelset", load_json(loads.wheelset)},
          {"wheel", load_json(loads.wheel)}};
}

Json patch_json(const PatchResult& patch) {
  Json out = Json::object();
  if (patch.id != 0) {
    out["id"] = patch.id;
    out["came_from"] = patch.came_from;
  }
  add_quantities(out, patch,
                 {Block::place, Block::angle, Block::arc, Block::shape, Block::rolling, Block::creepage, Block::force,
                  Block::energy, Block::work, Block::relative, Block::approach, Block::pressure, Block::refined});
  if (patch.loads) out["loads"] = loads_json(*patch.loads);
  add_quantities(out, patch, {Block::local});
  if (patch.sensitivities) {
    const auto& s = *patch.sensitivities;
    out["sensitivities"] = {{"fx_by_xi", number(s.by_creepage[0][0])},    {"fs_by_xi", number(s.by_creepage[0][1])},
                            {"fx_by_eta", number(s.by_creepage[1][0])},   {"fs_by_eta", number(s.by_creepage[1][1])},
                            {"fx_by_phi", number(s.by_creepage[2][0])},   {"fs_by_phi", number(s.by_creepage[2][1])},
                            {"fn_by_approach", number(s.by_approach[0])}, {"fx_by_approach", number(s.by_approach[1])},
                            {"fs_by_approach", number(s.by_approach[2])}};
  }
  add_quantities(out, patch, {Block::heat, Block::count});
  const Grid2& grid = patch.fields.grid;
  out["grid"] = {{"mx", grid.nx},
                 {"my", grid.ny},
                 {"dx_mm", number(grid.dx * kMilli)},
                 {"ds_mm", number(grid.dy * kMilli)},
                 {"x0_mm", number(grid.x0 * kMilli)},
                 {"s0_mm", number(grid.y0 * kMilli)},
                 {"reference_x_mm", number(patch.reference_x * kMilli)},
                 {"reference_s_mm", number(patch.reference_s * kMilli)}};
  if (!patch.fields.row_angle.empty()) {
    Json angles = Json::array();
    for (const double angle : patch.fields.row_angle) angles.push_back(number(angle));
    out["grid"]["row_angle_rad"] = std::move(angles);
  }
  return out;
}

Json derivatives_json(const CaseDerivatives& derivatives) {
  Json out = {{"message", derivatives.message},
              {"by", Json::array()},
              {"numbers", Json::array()},
              {"without", derivatives.without}};
  for (const CaseDerivatives::Parameter& p : derivatives.parameters)
    out["by"].push_back(
        {{"key", p.key}, {"value", number(p.value)}, {"of_surfaces", p.of_surfaces}, {"left_out", p.left_out}});
  for (const CaseDerivatives::Number& n : derivatives.numbers)
    out["numbers"].push_back({{"name", n.name}, {"by", numbers(n.by)}});
  return out;
}

Json uncertainty_json(const CaseUncertainty& uncertainty) {
  Json out = {{"message", uncertainty.message}, {"sources", Json::array()},       {"numbers", Json::array()},
              {"checked", uncertainty.checked}, {"samples", uncertainty.samples}, {"others", uncertainty.others},
              {"why", uncertainty.why}};
  for (const CaseUncertainty::Source& s : uncertainty.sources)
    out["sources"].push_back({{"name", s.name}, {"sigma", number(s.sigma)}});
  for (const CaseUncertainty::Number& n : uncertainty.numbers)
    out["numbers"].push_back({{"name", n.name},
                              {"value", number(n.value)},
                              {"sigma", number(n.sigma)},
                              {"sampled", n.sampled},
                              {"shares", numbers(n.shares)}});
  return out;
}

Json case_json(const CaseResult& result) {
  Json out = Json::object();
  out["case"] = result.number;
  out["status"] = std::string(status_word(result));
  out["message"] = result.message;
  out["remarks"] = Json::array();
  for (const Remark& r : result.remarks)
    out["remarks"].push_back({{"name", r.row().name}, {"grave", r.grave()}, {"patch", r.patch}, {"text", r.text}});
  out["seconds"] = number(result.seconds);
  add_quantities(out, result, {Block::wheelset});
  if (result.has_wheelset) {
    if (result.loads) out["loads"] = loads_json(*result.loads);
    add_quantities(out, result, {Block::deflection, Block::roller});
  }
  add_quantities(out, result, {Block::timing});
  out["force_iterations"] = Json::array();
  for (const auto& [z, fz] : result.force_iterations)
    out["force_iterations"].push_back(Json::array({number(z * kMilli), number(fz)}));
  out["npatch"] = result.patches.size();
  out["patches"] = Json::array();
  for (const PatchResult& patch : result.patches) out["patches"].push_back(patch_json(patch));
  if (result.uncertainty) out["uncertainty"] = uncertainty_json(*result.uncertainty);
  if (result.derivatives) out["derivatives"] = derivatives_json(*result.derivatives);
  return out;
}

Json surface_json(const SurfaceUse& use) {
  Json out = {{"body", use.body},
              {"backend", use.backend},
              {"resolution_mm", use.resolution > 0.0 ? Json(number(use.resolution * kMilli)) : Json()},
              {"build_s", number(use.build_seconds)},
              {"memory_bytes", use.memory_bytes}};
  if (use.fit.points > 0)
    out["fit"] = {{"points", use.fit.points},
                  {"missing", use.fit.missing},
                  {"height_max_um", number(use.fit.height_max * kMicro)},
                  {"height_rms_um", number(use.fit.height_rms * kMicro)},
                  {"slope_max_mrad", number(use.fit.slope_max * kMilli)},
                  {"curvature_max_per_m", number(use.fit.curvature_max)}};
  if (!use.note.empty()) out["note"] = use.note;
  return out;
}

/// All but its cases, whose list stands last.
Json head_json(const RunResult& run) {
  Json out = Json::object();
  out["treadmark"] = {
      {"version", run.version}, {"git", run.git}, {"threads", run.threads}, {"seconds", number(run.seconds)}};
  out["input"] = {{"file", run.input_file}, {"sha256", run.input_sha256}, {"geometry", hashes(run.geometry_sha256)}};
  if (!run.title.empty()) out["input"]["title"] = run.title;
  for (const auto& [name, value] : run.inputs) out["input"]["values"][name] = value;
  if (!run.doubts.empty()) out["input"]["doubts"] = run.doubts;
  if (!run.toml.empty()) out["input"]["toml"] = run.toml;
  out["surfaces"] = Json::array();
  for (const SurfaceUse& use : run.surfaces) out["surfaces"].push_back(surface_json(use));
  out["settings"] = run.settings;
  out["complete"] = run.complete;
  out["cases_total"] = run.cases_total;
  out["cases"] = Json::array();
  return out;
}

}  // namespace

std::string to_json(const RunResult& run) {
  Json out = head_json(run);
  for (const CaseResult& result : run.cases) out["cases"].push_back(case_json(result));
  return dumped(out) + "\n";
}

std::string result_schema() {
  return filled_schema(kResultSchema,
                       {{"case", schema_rows_of<CaseResult>()}, {"patch", schema_rows_of<PatchResult>()}});
}

std::string case_text(const CaseResult& result) {
  std::string out;
  for (const char c : dumped(case_json(result))) out += c == '\n' ? "\n  " : std::string_view(&c, 1);
  return out;
}

std::string text_before_cases(const RunResult& run) {
  std::string text = dumped(head_json(run));
  constexpr std::string_view kNoCases = "]\n}";
  text.resize(text.size() - kNoCases.size());
  return text + "\n  ";
}

void write_json(const std::filesystem::path& path, const RunResult& run) { write_file(path, to_json(run)); }

}  // namespace treadmark::io
