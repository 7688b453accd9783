// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/json/json_tree.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::io {
namespace {

[[noreturn]] void fail(const std::string& what, const SourcePosition& where) {
  throw Error(ErrorKind::input_data, what, where, "give a folder that this program wrote, with complete files");
}

const Json& json(const void* value) { return *static_cast<const Json*>(value); }

const char* name_of(const Json& value) {
  return value.is_null()      ? "null"
         : value.is_boolean() ? "true or false"
         : value.is_number()  ? "a number"
         : value.is_string()  ? "a text"
         : value.is_array()   ? "a list"
                              : "an object";
}

SourcePosition position(const std::string& file, const std::string& text, std::size_t byte) {
  const auto end =
      text.begin() + static_cast<std::ptrdiff_t>(std::min(std::max(byte, std::size_t{1}) - 1, text.size()));
  const auto line = std::count(text.begin(), end, '\n');
  const auto last = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
  return {file, static_cast<int>(line) + 1, static_cast<int>(end - last) + 1};
}

std::string named(const std::string& place) { return place.empty() ? "the file" : place; }

std::string joined(const std::string& place, std::string_view key) {
  return place.empty() ? std::string(key) : fmt::format("{}.{}", place, key);
}

}  // namespace

struct JsonTree::Document {
  Json root;
  std::string file;
};

void JsonTree::refuse(const std::string& what) const {
  fail(fmt::format("{} {}", named(place_), what), {document_->file, 0, 0});
}

void JsonTree::refuse_kind(const char* wanted) const {
  refuse(fmt::format("is {} where {} is expected", name_of(json(value_)), wanted));
}

bool JsonTree::has(std::string_view key) const {
  if (!json(value_).is_object()) refuse_kind("an object");
  return json(value_).contains(std::string(key));
}

bool JsonTree::is_null() const { return json(value_).is_null(); }

JsonTree JsonTree::at(std::string_view key) const {
  if (!has(key)) JsonTree(document_, value_, joined(place_, key)).refuse("is missing");
  return {document_, &json(value_).at(std::string(key)), joined(place_, key)};
}

std::optional<JsonTree> JsonTree::find(std::string_view key) const {
  if (!has(key) || at(key).is_null()) return std::nullopt;
  return at(key);
}

std::vector<JsonTree> JsonTree::items() const {
  if (!json(value_).is_array()) refuse_kind("a list");
  std::vector<JsonTree> out;
  for (const Json& item : json(value_)) out.push_back({document_, &item, fmt::format("{}[{}]", place_, out.size())});
  return out;
}

std::vector<std::pair<std::string, JsonTree>> JsonTree::entries() const {
  if (!json(value_).is_object()) refuse_kind("an object");
  std::vector<std::pair<std::string, JsonTree>> out;
  for (const auto& [key, value] : json(value_).items())
    out.emplace_back(key, JsonTree(document_, &value, joined(place_, key)));
  return out;
}

double JsonTree::number() const {
  if (is_null()) return kNaN;
  if (!json(value_).is_number()) refuse_kind("a number");
  return json(value_).get<double>();
}

std::size_t JsonTree::count() const {
  constexpr double kMost = 9007199254740992.0;  // whole numbers are exact up to here
  if (!json(value_).is_number()) refuse_kind("a whole number");
  const double value = number();
  if (!(value >= 0.0 && value <= kMost) || value != std::floor(value))
    refuse(fmt::format("is {:g} where a whole number, not negative, is expected", value));
  return to_whole<std::size_t>(value);
}

int JsonTree::integer() const {
  if (!json(value_).is_number()) refuse_kind("a whole number");
  const double value = number();
  if (!(std::fabs(value) <= 2147483647.0) || value != std::floor(value))
    refuse(fmt::format("is {:g} where a whole number is expected", value));
  return to_whole<int>(value);
}

std::string JsonTree::text() const {
  if (!json(value_).is_string()) refuse_kind("a text");
  return json(value_).get<std::string>();
}

bool JsonTree::flag() const {
  if (!json(value_).is_boolean()) refuse_kind("true or false");
  return json(value_).get<bool>();
}

std::vector<double> JsonTree::numbers() const {
  std::vector<double> out;
  for (const JsonTree& item : items()) out.push_back(item.number());
  return out;
}

std::vector<std::string> JsonTree::texts() const {
  std::vector<std::string> out;
  for (const JsonTree& item : items()) out.push_back(item.text());
  return out;
}

std::size_t JsonTree::one_of(const std::vector<std::string_view>& names) const {
  const auto found = ranges::find(names, text());
  if (found == names.end()) refuse(fmt::format("is \"{}\" where {} is expected", text(), fmt::join(names, " or ")));
  return static_cast<std::size_t>(found - names.begin());
}

namespace {

/// Where lists and objects lie deeper within each other than allowed, counted from 1; 0: nowhere. Texts that are no
/// JSON are judged up to their first fault, where the parser stops.
std::size_t too_deep_at(const std::string& text) {
  constexpr int kDeepest = 100;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
    else if (!quoted && (c == '[' || c == '{') && ++depth > kDeepest)
      return i + 1;
  }
  return 0;
}

}  // namespace

JsonTree read_json_file(const std::filesystem::path& file) {
  const std::string text = profiles::read_text(file, "result", {});
  const auto document = std::make_shared<JsonTree::Document>();
  document->file = file.string();
  if (const std::size_t byte = too_deep_at(text); byte > 0)
    fail("the file is nested too deeply", position(document->file, text, byte));
  try {
    document->root = Json::parse(text);
  } catch (const Json::parse_error& e) {
    fail("the file is no JSON, or was cut off", position(document->file, text, e.byte));
  } catch (const Json::exception&) {  // a number that is too large
    fail("the file is no JSON, or was cut off", {document->file, 0, 0});
  }
  const JsonTree root(document, &document->root, {});
  root.has("");  // refuses all but objects
  return root;
}

}  // namespace treadmark::io
