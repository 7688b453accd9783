// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/utf8.hpp"
#include "treadmark/io/results/comparison_fields.hpp"

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
  write_text_file(path, to_json(comparison));
}

}  // namespace treadmark::io
