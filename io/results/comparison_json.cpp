// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/comparison_json.hpp"

#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/read_json.hpp"
#include "treadmark/io/tables/schema_of.hpp"

namespace treadmark::io {

namespace {

constexpr const char* kComparisonSchema =
#include "treadmark/io/results/compare.schema.json.in"
    ;

}  // namespace

std::string to_json(const Comparison& comparison) {
  Json out;
  out["treadmark"] = {{"version", comparison.version},
                      {"git", comparison.git},
                      {"threads", comparison.threads},
                      {"seconds", number(comparison.seconds)}};
  Json& input = out["input"] = {{"file", comparison.input_file}, {"sha256", comparison.input_sha256}};
  input["geometry"] = Json::array();
  for (const auto& [file, sha256] : comparison.geometry_sha256)
    input["geometry"].push_back({{"file", file}, {"sha256", sha256}});
  if (!comparison.title.empty()) input["title"] = comparison.title;
  for (const auto& [name, value] : comparison.inputs) input["values"][name] = value;
  out["settings"] = comparison.settings;
  out["complete"] = comparison.complete;
  out["truth"] = comparison.truth;
  Json& candidates = out["candidates"] = Json::array();
  Json rows = Json::array();
  for (const ComparisonCandidate& candidate : comparison.candidates) {
    Json& one = candidates.emplace_back(json_of(candidate));
    one["wheel"] = json_of(candidate.wheel);
    one["rail"] = json_of(candidate.rail);
    for (const ComparisonRow& row : candidate.rows) rows.push_back(json_of(compared_row(candidate, row)));
  }
  out["rows"] = std::move(rows);
  return dumped(out) + "\n";
}

std::string comparison_schema() {
  return filled_schema(kComparisonSchema, {{"candidate", schema_rows<ComparisonCandidate>()},
                                           {"body", schema_rows<RepresentedBody>()},
                                           {"row", schema_rows<ComparedRow>()}});
}

void write_json(const std::filesystem::path& path, const Comparison& comparison) {
  write_file(path, to_json(comparison));
}

namespace {

ComparisonCandidate candidate_in(const JsonTree& node) {
  ComparisonCandidate out;
  read_json(node, out);
  read_json(node.at("wheel"), out.wheel);
  read_json(node.at("rail"), out.rail);
  return out;
}

ComparedRow row_in(const JsonTree& node) {
  ComparedRow out;
  out.case_number = node.at("case").integer();
  out.status = static_cast<Status>(node.at("status").one_of({"ok", "no_contact", "not_converged", "failed"}));
  out.ncon = node.at("ncon").integer();
  out.patches = node.at("patches").integer();
  out.comparable = node.has("pmax_error_percent");
  if (out.comparable)
    for (const Column<ComparedRow>& column : columns<ComparedRow>())
      if (column.access.has != nullptr) column.access.put(out, kNaN);  // what older files lack
  read_json(node, out);
  return out;
}

void add_row(const JsonTree& node, std::vector<ComparisonCandidate>& candidates) {
  const ComparedRow row = row_in(node);
  const auto owner = ranges::find_if(candidates, [&](const ComparisonCandidate& c) {
    return row.backend == c.name && row.resolution == c.resolution && row.wheel_backend == c.wheel.backend &&
           row.rail_backend == c.rail.backend;
  });
  if (owner == candidates.end()) node.refuse("belongs to none of the candidates");
  owner->rows.push_back(row);
}

Comparison comparison_in(const JsonTree& root) {
  Comparison out;
  const JsonTree made = root.at("treadmark"), input = root.at("input");
  out.version = made.text("version");
  out.git = made.text("git");
  out.threads = made.at("threads").integer();
  out.seconds = made.number("seconds");
  if (input.has("title")) out.title = input.text("title");
  out.input_file = input.text("file");
  out.input_sha256 = input.text("sha256");
  for (const JsonTree& file : input.at("geometry").items())
    out.geometry_sha256.emplace_back(file.text("file"), file.text("sha256"));
  if (const auto values = input.find("values"))
    for (const auto& [name, value] : values->entries()) out.inputs.emplace_back(name, value.text());
  out.settings = root.at("settings").texts();
  out.truth = root.text("truth");
  out.complete = root.flag("complete");
  for (const JsonTree& node : root.at("candidates").items()) out.candidates.push_back(candidate_in(node));
  for (const JsonTree& node : root.at("rows").items()) add_row(node, out.candidates);
  return out;
}

bool same(const ComparisonCandidate& a, const ComparisonCandidate& b) {
  constexpr double kClose = 1e-9;
  if (a.name != b.name || a.has_resolution() != b.has_resolution()) return false;
  return !a.has_resolution() || std::fabs(a.resolution - b.resolution) <= kClose * b.resolution;
}

/// Results and surfaces of all candidates that have rows.
void add_fields(const std::filesystem::path& file, Comparison& comparison) {
  std::vector<ComparisonCandidate> stored = read_comparison_fields(file).candidates;
  const auto refuse_without = [&](const std::string& whose) {
    throw Error(ErrorKind::input_data, "the fields do not belong to the comparison: there are none of " + whose,
                {file.string(), 0, 0}, "give a folder that one comparison wrote, or take the file of the fields away");
  };
  for (ComparisonCandidate& candidate : comparison.candidates) {
    if (candidate.rows.empty()) continue;
    const auto found = ranges::find_if(stored, [&](const ComparisonCandidate& c) { return same(c, candidate); });
    if (found == stored.end()) refuse_without(candidate_label(candidate));
    candidate.results = std::move(found->results);
    candidate.surfaces = std::move(found->surfaces);
    stored.erase(found);
  }
  if (comparison.candidates.front().results.empty()) refuse_without("the truth");
}

}  // namespace

Comparison read_comparison(const std::filesystem::path& folder) {
  Comparison out = comparison_in(read_json_file(folder / "compare.json"));
  const bool any_row = ranges::any_of(out.candidates, [](const auto& c) { return !c.rows.empty(); });
  std::error_code code;
  if (any_row && std::filesystem::is_regular_file(folder / "fields.h5", code)) add_fields(folder / "fields.h5", out);
  return out;
}

}  // namespace treadmark::io
