// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/key_words.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "treadmark/core/number_text.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {
namespace {

struct UnitWord {
  std::string_view key, shown;
  bool over = true;  ///< "m_s" is m/s, "kg_m2" kg m²
};
constexpr UnitWord kUnitWords[] = {
    {"mm", "mm"},        {"um", "µm"},      {"km", "km"},   {"m", "m"},   {"mm2", "mm²"}, {"m2", "m²"},
    {"mm3", "mm³"},      {"s", "s", false}, {"s2", "s²"},   {"kN", "kN"}, {"us", "µs"},   {"h", "h"},
    {"N", "N", false},   {"MPa", "MPa"},    {"GPa", "GPa"}, {"Pa", "Pa"}, {"rad", "rad"}, {"deg", "°"},
    {"kg", "kg", false}, {"ug", "µg"},      {"J", "J"},     {"W", "W"},   {"C", "°C"},    {"K", "K"},
    {"Hz", "Hz"},        {"percent", "%"},  {"db", "dB"},   {"per", ""}};

const UnitWord* unit_word(std::string_view text) {
  const auto* found = ranges::find(kUnitWords, text, &UnitWord::key);
  return found == std::end(kUnitWords) ? nullptr : found;
}

std::string with_blanks(std::string_view text) {
  std::string out(text);
  ranges::replace(out, '_', ' ');
  ranges::replace(out, '.', ' ');
  return out;
}

/// Without quotes, and no longer than a line.
std::string bare(std::string text) {
  constexpr std::size_t kMost = 100;
  std::erase_if(text, [](char c) { return c == '\'' || c == '"'; });
  return text.size() <= kMost ? text : std::string(cut_to_bytes(text, kMost)) + "…";
}

/// Adds "a.b.0.c" and the value of each leaf.
void flatten(const CaseValue& value, const std::string& path, std::vector<std::pair<std::string, std::string>>& out) {
  const auto text_of = [](const CaseValue& leaf) -> std::string {
    if (const auto* flag = std::get_if<bool>(&leaf.data)) return *flag ? "true" : "false";
    if (const auto* whole = std::get_if<std::int64_t>(&leaf.data)) return fmt::format("{}", *whole);
    if (const auto* number = std::get_if<double>(&leaf.data)) return fmt::format("{}", *number);
    if (const auto* text = std::get_if<std::string>(&leaf.data)) return toml_text(*text);
    return "";
  };
  const std::string below = path.empty() ? "" : path + ".";
  if (value.is_table()) {
    for (const CaseEntry& entry : value.table()) flatten(entry.value, below + entry.key, out);
  } else if (value.is_list()) {
    const auto& list = value.list();
    const bool plain = ranges::none_of(list, [](const auto& one) { return one.is_table() || one.is_list(); });
    std::string text;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (plain)
        text += (k == 0 ? "" : ", ") + text_of(list[k]);
      else
        flatten(list[k], fmt::format("{}{}", below, k), out);
    if (plain) out.emplace_back(path, "[" + text + "]");
  } else {
    out.emplace_back(path, text_of(value));
  }
}

std::string words_of(const std::vector<std::string>& values, std::string unit) {
  constexpr std::size_t kMost = 6;
  std::vector<double> numbers;
  for (const std::string& value : values)
    if (const auto number = finite_number(value)) numbers.push_back(*number);
  if (numbers.size() < values.size()) {
    const std::size_t shown = std::min(values.size(), kMost);
    std::string out;
    for (std::size_t i = 0; i < shown; ++i) out += (i > 0 ? ", " : "") + bare(values[i]);
    return values.size() > shown ? fmt::format("{} … ({} values)", out, values.size()) : out;
  }
  const auto [low, high] = ranges::minmax(numbers);
  const double kilo = unit == "N" && std::max(-low, high) >= 1e3 ? 1e-3 : 1.0;
  if (kilo < 1.0) unit = "kN";
  for (double& number : numbers) number *= kilo;
  unit = unit.empty() || unit == "°" ? unit : " " + unit;
  if (numbers.size() <= kMost) return fmt::format("{:.9g}{}", fmt::join(numbers, ", "), unit);
  return fmt::format("{:.9g} to {:.9g}{} ({} values)", kilo * low, kilo * high, unit, numbers.size());
}

}  // namespace

KeyWords words_of_key(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  const std::string section = dot == std::string_view::npos ? "" : with_blanks(path.substr(0, dot)) + ": ";
  std::string_view name = path.substr(dot + 1);  // npos + 1 = 0
  std::string unit;
  const UnitWord* after = nullptr;
  for (std::size_t last = name.rfind('_'); last != std::string_view::npos; last = name.rfind('_')) {
    const UnitWord* word = unit_word(name.substr(last + 1));
    if (word == nullptr) break;
    const bool per = word->key == "per";
    if (per || (after != nullptr && after->key != "per")) unit.insert(0, per || word->over ? "/" : " ");
    if (!per) unit.insert(0, word->shown);
    after = word;
    name = name.substr(0, last);
  }
  if (unit.starts_with('/')) unit = "1" + unit;
  return {section + with_blanks(name), std::move(unit)};
}

void InputList::add(const KeyInfo& key, const std::string& path, const std::vector<std::string>& values) {
  constexpr std::size_t kMostLeaves = 24;
  std::vector<Input> leaves;
  for (const std::string& value : values) {
    std::vector<std::pair<std::string, std::string>> said{{path, value}};
    if (key.type == KeyType::table_list && !value.empty()) {
      CaseValue list;
      list.data = parse_toml("list = " + value, "input");
      said.clear();
      flatten(list.table().front().value, path, said);
    }
    for (const auto& [place, text] : said) {
      auto leaf = ranges::find(leaves, place, &Input::path);
      if (leaf == leaves.end()) leaf = leaves.insert(leaf, {place, key.group, key.alternative, {}});
      if (!text.empty() && ranges::find(leaf->values, text) == leaf->values.end()) leaf->values.push_back(text);
    }
  }
  if (leaves.size() > kMostLeaves) leaves = {{path, key.group, key.alternative, values}};
  for (Input& leaf : leaves) {
    for (const std::string& value : leaf.values) leaf.length += value.size();
    if (leaf.values.empty()) continue;
    const auto other = ranges::find_if(inputs_, [&](const Input& one) {
      return !leaf.group.empty() && one.group == leaf.group && one.alternative != leaf.alternative;
    });
    if (other == inputs_.end())
      inputs_.push_back(std::move(leaf));
    else if (leaf.length < other->length)
      *other = std::move(leaf);
  }
}

Inputs InputList::words() const {
  Inputs out;
  for (const Input& input : inputs_) {
    KeyWords words = words_of_key(input.path);
    out.emplace_back(std::move(words.name), words_of(input.values, std::move(words.unit)));
  }
  return out;
}

}  // namespace treadmark::io
