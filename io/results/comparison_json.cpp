// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/comparison_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/comparison_store.hpp"

namespace treadmark::io {

namespace {

constexpr const char* kShort = "\b\f\n\r\t";  // written with a letter

std::string json_string(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const unsigned char c = static_cast<unsigned char>(text.front());
    if (length == 0)
      out += "\xEF\xBF\xBD";  // U+FFFD, the replacement character
    else if (c == '"' || c == '\\')
      out += {'\\', text.front()};
    else if (const char* short_form = std::strchr(kShort, c); c > 0 && short_form != nullptr)
      out += {'\\', "bfnrt"[short_form - kShort]};
    else if (c < 0x20)
      out += fmt::format("\\u{:04x}", c);
    else
      out += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out + '"';
}

/// As in the result file of a run: 12 digits, a point or an exponent in every real number.
std::string real(double value) {
  if (!std::isfinite(value)) return "null";
  std::string text = fmt::format("{:.12g}", value + 0.0);  // no negative zero
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

struct ValueText {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double value) const { return real(value); }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return json_string(value); }
};

/// Text of a document in the order of the calls, one blank of indentation a level.
class Document {
 public:
  void open(char bracket) { text_ += bracket, level_ += 1, first_ = true; }
  void close(char bracket) {
    level_ -= 1;
    if (!first_) new_line();
    text_ += bracket;
    first_ = false;
  }
  void item() {
    if (!first_) text_ += ',';
    new_line();
    first_ = false;
  }
  void key(std::string_view name) {
    item();
    text_ += json_string(name);
    text_ += ": ";
  }
  void value(const std::string& text) { text_ += text; }
  void entry(std::string_view name, const std::string& text) { key(name), value(text); }
  void entries(const std::vector<NamedField>& fields) {
    for (const NamedField& field : fields)
      if (!std::holds_alternative<std::monostate>(field.value)) entry(field.name, std::visit(ValueText{}, field.value));
  }
  void object(const std::vector<NamedField>& fields) {
    open('{');
    entries(fields);
    close('}');
  }
  std::string take() { return std::move(text_) + "\n"; }

 private:
  void new_line() {
    text_ += '\n';
    text_.append(level_, ' ');
  }

  std::string text_;
  std::size_t level_ = 0;
  bool first_ = true;
};

void add_origin(Document& out, const Comparison& comparison) {
  out.key("treadmark");
  out.object({{"version", comparison.version},
              {"git", comparison.git},
              {"threads", std::int64_t{comparison.threads}},
              {"seconds", comparison.seconds}});
  out.key("input");
  out.open('{');
  out.entries({{"file", comparison.input_file}, {"sha256", comparison.input_sha256}});
  out.key("geometry");
  out.open('[');
  for (const auto& [file, sha256] : comparison.geometry_sha256) {
    out.item();
    out.object({{"file", file}, {"sha256", sha256}});
  }
  out.close(']');
  if (!comparison.title.empty()) out.entries({{"title", comparison.title}});
  out.close('}');
  out.key("settings");
  out.open('[');
  for (const std::string& setting : comparison.settings) {
    out.item();
    out.value(json_string(setting));
  }
  out.close(']');
}

void add_candidates(Document& out, const Comparison& comparison) {
  out.key("candidates");
  out.open('[');
  for (const ComparisonCandidate& candidate : comparison.candidates) {
    out.item();
    out.open('{');
    out.entries(candidate_fields(candidate));
    out.key("wheel");
    out.object(body_fields(candidate.wheel));
    out.key("rail");
    out.object(body_fields(candidate.rail));
    out.close('}');
  }
  out.close(']');
  out.key("rows");
  out.open('[');
  for (const ComparisonCandidate& candidate : comparison.candidates)
    for (const ComparisonRow& row : candidate.rows) {
      out.item();
      out.object(row_fields(candidate, row));
    }
  out.close(']');
}

}  // namespace

std::string to_json(const Comparison& comparison) {
  Document out;
  out.open('{');
  add_origin(out, comparison);
  out.entry("complete", comparison.complete ? "true" : "false");
  out.entry("truth", json_string(comparison.truth));
  add_candidates(out, comparison);
  out.close('}');
  return out.take();
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
