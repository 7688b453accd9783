// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "treadmark/io/simulations/change_value.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/io/simulations/study_keys.hpp"

namespace treadmark::io {

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// The value as TOML on one line.
std::string toml_of(const CaseValue& value) {
  if (value.is_list()) {
    std::string text;
    for (const CaseValue& one : value.list()) text += (text.empty() ? "" : ", ") + toml_of(one);
    return '[' + text + ']';
  }
  if (value.is_table()) {
    std::string text;
    for (const CaseEntry& entry : value.table())
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", quoted(entry.key), toml_of(entry.value));
    return '{' + text + '}';
  }
  if (const auto* text = std::get_if<std::string>(&value.data)) return quoted(*text);
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) return std::to_string(*integer);
  return fmt::format("{}", std::get<double>(value.data));
}

VariedValue single_value(const std::string& key, const CaseValue& value) {
  VariedValue result;
  result.where = value.where;
  const bool text = std::holds_alternative<std::string>(value.data);
  const bool number = std::holds_alternative<std::int64_t>(value.data) || std::holds_alternative<double>(value.data);
  result.label = text ? value.text() : toml_of(value);
  if (number) result.number = value.number();
  result.overrides = {fmt::format("{}={}", key, toml_of(value))};
  return result;
}

/// { label = "FASTSIM", set = ["solver.tangential_model=fastsim", ...] }
VariedValue set_of_keys(const CaseValue& value, const std::string& path) {
  const TableOf table(value, path, vary_value_keys());
  VariedValue result = table.read();
  result.where = value.where;
  const auto overrides = &VariedValue::overrides;
  const CaseValue& set = table.need(overrides);
  if (result.overrides.empty()) table.refuse(overrides, fmt::format("{} is empty", table.path_of(overrides)));
  for (std::size_t i = 0; i < result.overrides.size(); ++i) {
    try {
      parse_override(result.overrides[i]);
    } catch (const Error& e) {
      throw Error(ErrorKind::configuration, fmt::format("'{}': {}", result.overrides[i].substr(0, 100), e.message()),
                  set.list()[i].where, e.advice());
    }
  }
  return result;
}

/// Members of [[study.vary]].
const auto kVariedKey = [](auto& v) -> auto& { return v.variation.key; };
const auto kVariedLabel = [](auto& v) -> auto& { return v.variation.label; };
const auto kVariedValues = [](auto& v) -> auto& { return v.variation.values; };

std::vector<VariedValue> listed_values(const TableOf<VaryInput>& table, const std::string& key) {
  const CaseValue& list = table.need(kVariedValues);
  const std::string path = table.path_of(kVariedValues);
  if (!list.is_list() || list.list().empty())
    table.refuse(kVariedValues, fmt::format("{} must be a list with at least one value", path));
  std::vector<VariedValue> values;
  for (const CaseValue& one : list.list()) {
    const bool set =
        one.is_table() && (key.empty() || find_entry(one.table(), vary_value_keys().infos.back().path) != nullptr);
    if (!set && key.empty())
      throw Error(
          ErrorKind::configuration, fmt::format("{} is missing", table.path_of(kVariedKey)), one.where,
          "name the key that has these values, or give sets of keys, { label = \"...\", set = [\"key=value\"] }");
    values.push_back(set ? set_of_keys(one, path) : single_value(key, one));
  }
  return values;
}

std::vector<VariedValue> spaced_values(const TableOf<VaryInput>& table, const VaryInput& given) {
  using V = VaryInput;
  const std::string& key = given.variation.key;
  if (key.empty())
    table.fail(fmt::format("{} is missing", table.path_of(kVariedKey)), "name the key that has these values");
  table.need(&V::to);
  table.need(&V::count);
  const auto [variation, from, to, count, logarithmic] = given;
  if (logarithmic)
    for (double V::*end : {&V::from, &V::to})
      check_value(key_info(table.path_of(end), KeyType::number, {}, kPositive), table.need(end));
  std::vector<VariedValue> values;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    double value = logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
    if (i == count - 1) value = to;
    values.push_back(single_value(key, {table.where(), value}));
    values.back().label = fmt::format("{:.6g}", value);
  }
  return values;
}

Variation read_variation(const TableOf<VaryInput>& table) {
  using V = VaryInput;
  VaryInput given = table.read();
  Variation& variation = given.variation;
  if (variation.key.find('=') != std::string::npos)
    table.refuse(kVariedKey, fmt::format("{} must be a key only", table.path_of(kVariedKey)),
                 "its values stand in values = [...]");
  table.exclude(kVariedValues, &V::from);
  const bool spaced = table.find(&V::from) != nullptr;
  const auto needs_from = [&](auto member) {
    if (!spaced && table.find(member) != nullptr)
      table.refuse(member, fmt::format("{} needs {}", table.path_of(member), table.path_of(&V::from)));
  };
  needs_from(&V::to);
  needs_from(&V::count);
  needs_from(&V::logarithmic);
  variation.values = spaced ? spaced_values(table, given) : listed_values(table, variation.key);
  if (table.find(kVariedLabel) == nullptr) variation.label = variation.key;
  // it names the values in the results, too
  if (variation.key.empty() &&
      (variation.label == "." || variation.label.find_first_of(std::string_view("/\0", 2)) != std::string::npos))
    table.refuse(
        kVariedLabel,
        fmt::format("{} without a key is the name of a dataset, which has no slash", table.path_of(kVariedLabel)),
        "write it without, or name the key");
  return variation;
}

}  // namespace

std::vector<Variation> read_variations(const TableOf<StudyFile>& study) {
  std::vector<Variation> variations;
  std::set<std::string> seen, names;
  for (const CaseValue* one : study.tables(&StudyFile::variations)) {
    const TableOf table(*one, study.path_of(&StudyFile::variations), vary_keys());
    variations.push_back(read_variation(table));
    const Variation& added = variations.back();
    std::set<std::string> keys;
    for (const VariedValue& value : added.values)
      for (const std::string& assignment : value.overrides) keys.insert(parse_override(assignment).path);
    for (const std::string& key : keys)
      if (!seen.insert(key).second) table.fail(fmt::format("{} is varied twice", key));
    if (const std::string& name = added.key.empty() ? added.label : added.key;
        !name.empty() && !names.insert(name).second)
      table.fail(fmt::format("two variations are called {}", name), "give each a label of its own");
  }
  double count = 1.0;
  for (const Variation& variation : variations) count *= static_cast<double>(variation.values.size());
  if (count > kMostValues)
    study.fail(fmt::format("a study of {:.0f} runs is too large, at most {:.0f}", count, kMostValues));
  return variations;
}

std::vector<StudyRun> runs_of(const std::vector<Variation>& variations, const std::vector<std::string>& common) {
  std::size_t count = 1;
  for (const Variation& variation : variations) count *= variation.values.size();
  std::vector<StudyRun> runs(count);
  for (std::size_t i = 0; i < count; ++i) {
    StudyRun& run = runs[i];
    run.number = static_cast<int>(i) + 1;
    run.values.resize(variations.size());
    std::size_t rest = i;
    for (std::size_t v = variations.size(); v-- > 0;) {
      const std::size_t choices = variations[v].values.size();
      run.values[v] = rest % choices;
      rest /= choices;
    }
    run.overrides = common;
    for (std::size_t v = 0; v < variations.size(); ++v) {
      const auto& own = variations[v].values[run.values[v]].overrides;
      run.overrides.insert(run.overrides.end(), own.begin(), own.end());
    }
  }
  return runs;
}

}  // namespace treadmark::io
