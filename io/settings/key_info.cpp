// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/settings/key_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/settings/magnitudes.hpp"
#include "treadmark/io/settings/toml_faults.hpp"

namespace treadmark::io {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Longer endings first.
constexpr KeyUnit kUnits[] = {{"_mm_per_MPa", 1e-9, "m/Pa"},
                              {"_MPa_per_mm", 1e9, "Pa/m"},
                              {"_N_per_mm", 1e3, "N/m"},
                              {"_per_m", 1.0, "1/m"},
                              {"_per_mille", 1e-3, "1"},
                              {"_rad_s", 1.0, "rad/s"},
                              {"_rad_m", 1.0, "rad/m"},
                              {"_mm_s", 1e-3, "m/s"},
                              {"_m_s", 1.0, "m/s"},
                              {"_km_h", 1.0 / 3.6, "m/s"},
                              {"_mm3", 1e-9, "m3"},
                              {"_mm3_J", 1e-9, "m3/J"},
                              {"_mm3_km", 1e-12, "m3/m"},
                              {"_W_mm2", 1e6, "W/m2"},
                              {"_ug_m_mm2", 1e-3, "kg/m3"},
                              {"_km", 1e3, "m"},
                              {"_um", 1e-6, "m"},
                              {"_us", 1e-6, "s"},
                              {"_GPa", 1e9, "Pa"},
                              {"_MPa", 1e6, "Pa"},
                              {"_deg", kDegree, "rad"},
                              {"_mrad", 1e-3, "rad"},
                              {"_rad", 1.0, "rad"},
                              {"_mm", 1e-3, "m"},
                              {"_kN", 1e3, "N"},
                              {"_N", 1.0, "N"}};

}  // namespace

KeyInfo key_info(std::string path, KeyType type, std::string doc) {
  KeyInfo info;
  info.path = std::move(path);
  info.type = type;
  info.doc = std::move(doc);
  return info;
}

KeyInfo key_info(std::string path, KeyType type, std::string doc, const KeyLimits& limits) {
  KeyInfo info = key_info(std::move(path), type, std::move(doc));
  info.above = limits.above;
  info.at_least = limits.at_least;
  info.at_most = limits.at_most;
  return info;
}

ElementPath split_element_path(const KeyInfo& list, std::string_view rest, const SourcePosition& where) {
  const std::size_t dot = rest.find('.');
  ElementPath place;
  const auto [end, error] = from_chars(rest.data(), rest.data() + std::min(dot, rest.size()), place.index);
  if (dot == std::string_view::npos || error != std::errc{} || end != rest.data() + dot)
    throw Error(ErrorKind::configuration, fmt::format("{} is a list", list.path), where,
                fmt::format("write {}.0.{}=value", list.path, list.elements.front().path));
  place.key = rest.substr(dot + 1);
  return place;
}

KeyUnit unit_at_end(std::string_view path) {
  for (const KeyUnit& unit : kUnits)
    if (path.ends_with(unit.ending)) return unit;
  return {"", 1.0, "1"};
}

double unit_of_key(std::string_view path) { return unit_at_end(path).si; }

std::vector<double> numbers_of(const CaseValue& list, double unit) {
  std::vector<double> numbers;
  for (const CaseValue& one : list.list()) numbers.push_back(one.number() * unit);
  return numbers;
}

void refuse_unknown_key(std::string_view path, const std::vector<std::string>& known, const SourcePosition& where) {
  const std::string near = nearest_key(path, known);
  throw Error(ErrorKind::configuration, fmt::format("unknown key '{}'", path.substr(0, 100)), where,
              near.empty() ? "see docs/case-file.md for all keys" : fmt::format("did you mean '{}'?", near));
}

namespace {

std::string_view leaf(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

}  // namespace

std::string nearest_key(std::string_view path, std::span<const std::string> known) {
  constexpr std::size_t kLongest = 100;
  if (path.empty() || path.size() > kLongest) return {};
  std::string best;
  std::size_t best_distance = path.size() + 1;
  for (const std::string& candidate : known) {
    std::size_t distance = edit_distance(path, candidate);
    // The same name in another section, or the unit forgotten, is as near as a slip of the finger.
    if (leaf(path) == leaf(candidate)) distance = std::min<std::size_t>(distance, 2);
    if (candidate.starts_with(std::string(path) + '_')) distance = std::min<std::size_t>(distance, 1);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  const std::size_t tolerated = std::max<std::size_t>(2, leaf(path).size() / 3);
  return best_distance <= tolerated ? best : std::string();
}

namespace {

constexpr std::size_t kLongestText = 4096;
constexpr std::size_t kLongestShown = 64;

std::string_view plain(KeyType type) {
  switch (type) {
    case KeyType::number:
      return "a number";
    case KeyType::integer:
      return "an integer";
    case KeyType::flag:
      return "true or false";
    case KeyType::text:
    case KeyType::path:
      return "text";
    case KeyType::choice:
      return "one word";
    case KeyType::number_list:
    case KeyType::triple:
    case KeyType::direction:
      return "a list of numbers";
    case KeyType::triple_list:
    case KeyType::text_list:
    case KeyType::value_list:
      return "a list";
    case KeyType::table:
      return "a table";
    case KeyType::table_list:
      return "a list of tables";
  }
  return "a value";
}

[[noreturn]] void refuse_value(std::string message, const SourcePosition& where, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), where, std::move(advice));
}

/// What to write for a text where something else is expected.
std::string advice_on_text(KeyType wanted, const std::string& text) {
  if (wanted == KeyType::flag) {
    for (const std::string_view yes : {"true", "yes", "on", "1"})
      if (edit_distance(text, yes) == 0) return "write true without quotes";
    for (const std::string_view no : {"false", "no", "off", "0"})
      if (edit_distance(text, no) == 0) return "write false without quotes";
    return {};
  }
  if (wanted != KeyType::number && wanted != KeyType::integer) return {};
  const TextFault fault = number_fault(text);
  return fault.message.empty() || fault.advice.empty() ? fault.message + fault.advice
                                                       : fault.message + ": " + fault.advice;
}

/// What to write for a number where text is expected.
std::string advice_on_number(const KeyInfo& key, double number) {
  if (key.matches != nullptr && number > 0.0) {
    std::string ratio = fmt::format("1:{:.6g}", number < 1.0 ? 1.0 / number : number);
    if (key.matches(ratio)) return fmt::format("write \"{}\"", ratio);
  }
  return key.like.empty() ? "text stands in quotes" : fmt::format("write it like {}", key.like);
}

std::string choices_of(const KeyInfo& key) {
  std::string choices = key.type == KeyType::number ? "a number" : "";
  for (const std::string& one : key.choices) choices += fmt::format("{}\"{}\"", choices.empty() ? "" : ", ", one);
  return choices;
}

void check_choice(const KeyInfo& key, const CaseValue& value) {
  if (std::find(key.choices.begin(), key.choices.end(), value.text()) != key.choices.end()) return;
  const std::string near = nearest_name(value.text(), key.choices);
  refuse_value(
      fmt::format("{} = \"{}\" is not one of {}", key.path, value.text().substr(0, kLongestShown), choices_of(key)),
      value.where, near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace

std::string advice_on_type(const KeyInfo& key, const CaseValue& value) {
  if (const auto* text = std::get_if<std::string>(&value.data)) return advice_on_text(key.type, *text);
  if (value.is_list()) return "lists of values make cases in [[cases]] of a case file, and runs in a study";
  if (key.type == KeyType::choice) return fmt::format("choose {}", choices_of(key));
  const auto* integer = std::get_if<std::int64_t>(&value.data);
  const auto* real = std::get_if<double>(&value.data);
  if (integer == nullptr && real == nullptr) return {};
  const double number = value.number();
  if (key.type == KeyType::text || key.type == KeyType::path) return advice_on_number(key, number);
  if (key.type == KeyType::flag && (number == 0.0 || number == 1.0))
    return number == 1.0 ? "write true" : "write false";
  constexpr double kMostExact = 1e15;
  if (key.type == KeyType::integer && number == std::round(number) && std::abs(number) < kMostExact)
    return fmt::format("write {:.0f}", number);
  if (key.type == KeyType::number_list || key.type == KeyType::triple || key.type == KeyType::direction)
    return "a list stands in square brackets: [1, 2, 3]";
  return {};
}

namespace {

/// The number in the unit of the key, where it is plainly in another one: both limits are magnitudes, and a thousand
/// times more or less lies between them.
std::string advice_on_unit(const KeyInfo& key, double value) {
  if (!key.at_least || !key.at_most || !(*key.at_least > 0.0 || *key.at_least == -*key.at_most)) return {};
  const std::string_view unit = unit_at_end(key.path).ending;
  if (unit != "_mm" && unit != "_N" && unit != "_um") return {};
  for (const double factor : {1e3, 1e-3})
    if (const double meant = factor * value; meant > *key.at_least && meant < *key.at_most)
      return fmt::format("the number is in {}: {:g} is meant?", unit.substr(1), meant);
  return fmt::format("the number is in {}", unit.substr(1));
}

void check_range(const KeyInfo& key, double value, const SourcePosition& where) {
  if (!std::isfinite(value)) refuse_value(fmt::format("{} must be finite", key.path), where);
  if (key.above && !(value > *key.above))
    refuse_value(fmt::format("{} = {} must be greater than {}", key.path, value, *key.above), where);
  if (key.at_least && value < *key.at_least)
    refuse_value(fmt::format("{} = {} must be at least {}", key.path, value, *key.at_least), where,
                 advice_on_unit(key, value));
  if (key.at_most && value > *key.at_most)
    refuse_value(fmt::format("{} = {} must be at most {}", key.path, value, *key.at_most), where,
                 advice_on_unit(key, value));
  const Magnitudes& meant = magnitudes_of(key.path);
  const char* advice = "is it in the unit that the name of the key ends with?";
  if (std::abs(value) > meant.greatest)
    throw Error(
        ErrorKind::configuration,
        fmt::format("{} = {:g} is beyond the greatest magnitude that is taken, {:g}", key.path, value, meant.greatest),
        where, advice);
  if (key.above == 0.0 && value < meant.least)
    throw Error(ErrorKind::configuration,
                fmt::format("{} = {:g} is below the least that is taken, {:g}", key.path, value, meant.least), where,
                advice);
}

}  // namespace

void check_exclusive(const KeyInfo& key, const SourcePosition& where, ChosenKeys& chosen) {
  if (key.group.empty()) return;
  for (const ChosenKey& other : chosen)
    if (other.key->group == key.group && other.key->alternative != key.alternative)
      throw Error(ErrorKind::configuration, fmt::format("{} and {} exclude each other", other.key->path, key.path),
                  where, "give one of them");
  chosen.push_back({&key, where});
}

void check_value(const KeyInfo& key, const CaseValue& value) {
  const auto wrong = [&] {
    refuse_value(fmt::format("{} must be {}, found {}", key.path, plain(key.type), value.kind()), value.where,
                 advice_on_type(key, value));
  };
  const bool integer = std::holds_alternative<std::int64_t>(value.data);
  const bool number = integer || std::holds_alternative<double>(value.data);
  const bool text = std::holds_alternative<std::string>(value.data);
  switch (key.type) {
    case KeyType::number:
      if (text && !key.choices.empty()) return check_choice(key, value);
      if (!number) wrong();
      check_range(key, value.number(), value.where);
      return;
    case KeyType::integer:
      if (!integer) wrong();
      check_range(key, value.number(), value.where);
      return;
    case KeyType::flag:
      if (!std::holds_alternative<bool>(value.data)) wrong();
      return;
    case KeyType::path:
    case KeyType::text:
      if (!text) wrong();
      if (value.text().empty()) refuse_value(fmt::format("{} must not be empty", key.path), value.where);
      if (key.type == KeyType::path && ranges::any_of(value.text(), [](char c) { return c >= 0 && c < ' '; }))
        refuse_value(fmt::format("{} holds a character that no name of a file has", key.path), value.where,
                     "a backslash in double quotes begins one: write / in its place, or single quotes round the name");
      if (value.text().size() > kLongestText) refuse_value(fmt::format("{} is too long", key.path), value.where);
      if (key.matches != nullptr && !key.matches(value.text()))
        refuse_value(
            fmt::format("{} = '{}' does not look like {}", key.path, value.text().substr(0, kLongestShown), key.like),
            value.where);
      return;
    case KeyType::choice:
      if (!text) wrong();
      check_choice(key, value);
      return;
    case KeyType::number_list:
    case KeyType::triple:
    case KeyType::direction:
      if (!value.is_list()) wrong();
      for (const CaseValue& one : value.list()) {
        if (!std::holds_alternative<std::int64_t>(one.data) && !std::holds_alternative<double>(one.data))
          refuse_value(fmt::format("{} must be a list of numbers, found {} in it", key.path, one.kind()), one.where,
                       one.is_list() ? "" : advice_on_type(key_info(key.path, KeyType::number, {}), one));
        check_range(key, one.number(), one.where);
      }
      return;
    case KeyType::triple_list:
    case KeyType::text_list:
    case KeyType::value_list:
    case KeyType::table:
      return;
    case KeyType::table_list:
      if (!value.is_list()) wrong();
      for (const CaseValue& one : value.list()) {
        if (!one.is_table())
          refuse_value(fmt::format("{} must be a list of tables, found {} in it", key.path, one.kind()), one.where);
        check_elements(key, one.table(), one.where, true);
      }
      return;
  }
}

void check_elements(const KeyInfo& list, const CaseTable& entries, const SourcePosition& where, bool complete) {
  std::vector<std::string> known;
  for (const KeyInfo& element : list.elements) known.push_back(element.path);
  ChosenKeys chosen;
  for (const CaseEntry& entry : entries) {
    const auto found =
        std::find_if(list.elements.begin(), list.elements.end(), [&](const KeyInfo& k) { return k.path == entry.key; });
    if (found == list.elements.end()) refuse_unknown_key(entry.key, known, entry.key_where);
    check_value(*found, entry.value);
    check_exclusive(*found, entry.key_where, chosen);
  }
  for (const KeyInfo& element : list.elements) {
    const bool given =
        std::any_of(entries.begin(), entries.end(), [&](const CaseEntry& e) { return e.key == element.path; });
    if (complete && element.required && !given)
      refuse_value(fmt::format("{} of {} is missing", element.path, list.path), where);
  }
}

}  // namespace treadmark::io
