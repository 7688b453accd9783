// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/io/settings/key_info.hpp"

namespace treadmark::io {

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

[[noreturn]] void refuse_value(std::string message, const SourcePosition& where) {
  throw Error(ErrorKind::configuration, std::move(message), where);
}

void check_range(const KeyInfo& key, double value, const SourcePosition& where) {
  if (!std::isfinite(value)) refuse_value(fmt::format("{} must be finite", key.path), where);
  if (key.above && !(value > *key.above))
    refuse_value(fmt::format("{} = {} must be greater than {}", key.path, value, *key.above), where);
  if (key.at_least && value < *key.at_least)
    refuse_value(fmt::format("{} = {} must be at least {}", key.path, value, *key.at_least), where);
  if (key.at_most && value > *key.at_most)
    refuse_value(fmt::format("{} = {} must be at most {}", key.path, value, *key.at_most), where);
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
    refuse_value(fmt::format("{} must be {}, found {}", key.path, plain(key.type), value.kind()), value.where);
  };
  const bool integer = std::holds_alternative<std::int64_t>(value.data);
  const bool number = integer || std::holds_alternative<double>(value.data);
  const bool text = std::holds_alternative<std::string>(value.data);
  switch (key.type) {
    case KeyType::number:
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
      if (value.text().size() > kLongestText) refuse_value(fmt::format("{} is too long", key.path), value.where);
      if (key.matches != nullptr && !key.matches(value.text()))
        refuse_value(fmt::format("{} = '{}' does not look like {}", key.path, value.text().substr(0, kLongestShown),
                                 key.pattern),
                     value.where);
      return;
    case KeyType::choice:
      if (!text) wrong();
      if (std::find(key.choices.begin(), key.choices.end(), value.text()) == key.choices.end()) {
        std::string choices;
        for (const std::string& one : key.choices) choices += fmt::format("{}\"{}\"", choices.empty() ? "" : ", ", one);
        refuse_value(
            fmt::format("{} = \"{}\" is not one of {}", key.path, value.text().substr(0, kLongestShown), choices),
            value.where);
      }
      return;
    case KeyType::number_list:
    case KeyType::triple:
    case KeyType::direction:
      if (!value.is_list()) wrong();
      for (const CaseValue& one : value.list()) {
        if (!std::holds_alternative<std::int64_t>(one.data) && !std::holds_alternative<double>(one.data))
          refuse_value(fmt::format("{} must be a list of numbers, found {} in it", key.path, one.kind()), one.where);
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
