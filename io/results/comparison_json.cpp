// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/comparison_json.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::io {

namespace {

Json value_of(const FieldValue& value) {
  if (const auto* real = std::get_if<double>(&value)) return number(*real);
  if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
  return std::get<std::string>(value);
}

/// What has a value.
Json object_of(const std::vector<NamedField>& fields) {
  Json out = Json::object();
  for (const NamedField& field : fields)
    if (!std::holds_alternative<std::monostate>(field.value)) out[std::string(field.name)] = value_of(field.value);
  return out;
}

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
  out["settings"] = comparison.settings;
  out["complete"] = comparison.complete;
  out["truth"] = comparison.truth;
  Json& candidates = out["candidates"] = Json::array();
  Json rows = Json::array();
  for (const ComparisonCandidate& candidate : comparison.candidates) {
    Json& one = candidates.emplace_back(object_of(candidate_fields(candidate)));
    one["wheel"] = object_of(body_fields(candidate.wheel));
    one["rail"] = object_of(body_fields(candidate.rail));
    for (const ComparisonRow& row : candidate.rows) rows.push_back(object_of(row_fields(candidate, row)));
  }
  out["rows"] = std::move(rows);
  return dumped(out) + "\n";
}

void write_json(const std::filesystem::path& path, const Comparison& comparison) {
  write_file(path, to_json(comparison));
}

namespace {

template <class Struct, std::size_t count>
void read_numbers(const JsonTree& node, const NamedNumber<Struct> (&numbers)[count], Struct& out) {
  for (const auto& [name, value, factor] : numbers) out.*value = node.number(name) / factor;
}

/// [m]; 0 for data as given, which has none.
double resolution_in(const JsonTree& node) {
  const double resolution = node.number("resolution_mm") / kMilli;
  return std::isnan(resolution) ? 0.0 : resolution;
}

RepresentedBody body_in(const JsonTree& node) {
  RepresentedBody out{node.text("backend"), resolution_in(node), node.number("build_s"), node.count("memory_bytes"), {},
                      node.text("note")};
  read_numbers(node, kDifferenceNumbers, out.difference);
  out.difference.points = node.count("points");
  out.difference.missing = node.count("missing");
  return out;
}

ComparisonCandidate candidate_in(const JsonTree& node) {
  ComparisonCandidate out;
  out.name = node.text("backend");
  out.resolution = resolution_in(node);
  out.wheel = body_in(node.at("wheel"));
  out.rail = body_in(node.at("rail"));
  if (const auto failure = node.find("failure")) out.failure = failure->text();
  return out;
}

ComparisonRow row_in(const JsonTree& node) {
  ComparisonRow out;
  out.case_number = node.at("case").integer();
  out.status = static_cast<Status>(node.at("status").one_of({"ok", "no_contact", "not_converged", "failed"}));
  out.ncon = node.at("ncon").integer();
  out.patches = node.at("patches").integer();
  read_numbers(node, kRowPatchNumbers, out);
  read_numbers(node, kRowTimes, out);
  out.comparable = node.has(kRowErrors[0].name);
  if (!out.comparable) return out;
  read_numbers(node, kRowErrors, out);
  const auto& [name, value, factor] = kMeanPressureError;
  out.*value = node.has(name) ? node.number(name) / factor : kNaN;
  return out;
}

ComparisonCandidate& owner_of(const JsonTree& row, std::vector<ComparisonCandidate>& candidates) {
  const double resolution = resolution_in(row);
  const auto owner = std::ranges::find_if(candidates, [&](const ComparisonCandidate& c) {
    return row.text("backend") == c.name && resolution == c.resolution &&
           row.text("wheel_backend") == c.wheel.backend && row.text("rail_backend") == c.rail.backend;
  });
  if (owner == candidates.end()) row.refuse("belongs to none of the candidates");
  return *owner;
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
  out.settings = root.at("settings").texts();
  out.truth = root.text("truth");
  out.complete = root.flag("complete");
  for (const JsonTree& node : root.at("candidates").items()) out.candidates.push_back(candidate_in(node));
  for (const JsonTree& node : root.at("rows").items()) owner_of(node, out.candidates).rows.push_back(row_in(node));
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
    const auto found = std::ranges::find_if(stored, [&](const ComparisonCandidate& c) { return same(c, candidate); });
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
  const bool any_row = std::ranges::any_of(out.candidates, [](const auto& c) { return !c.rows.empty(); });
  std::error_code code;
  if (any_row && std::filesystem::is_regular_file(folder / "fields.h5", code)) add_fields(folder / "fields.h5", out);
  return out;
}

}  // namespace treadmark::io
