// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/change_value.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/simulations/table_reader.hpp"

namespace treadmark::io {

namespace {

struct Step {
  std::string_view head, rest;
  bool last = false;
};

Step first_step(std::string_view path, const CaseOverride& change) {
  const std::size_t dot = path.find('.');
  Step step{path.substr(0, dot), dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1),
            dot == std::string_view::npos};
  if (step.head.empty() || (!step.last && step.rest.empty()))
    throw Error(ErrorKind::configuration, fmt::format("'{}' is no path of a key", change.path), change.value.where);
  return step;
}

bool is_text(const CaseValue& value) { return std::holds_alternative<std::string>(value.data); }

void replace(CaseValue& target, const CaseOverride& change) {
  const bool scalar = !change.value.is_list() && !change.value.is_table();
  const bool word = is_text(target) && scalar && !is_text(change.value);
  target = change.value;
  if (word) target.data = change.raw;
}

const std::string* name_of(const CaseValue& element) {
  if (!element.is_table()) return nullptr;
  const CaseEntry* name = find_entry(element.table(), "name");
  return name != nullptr && is_text(name->value) ? &name->value.text() : nullptr;
}

/// Number of the element that is meant.
std::size_t element_of(const std::vector<CaseValue>& list, std::string_view which, const CaseOverride& change) {
  std::size_t index = 0;
  const auto [end, error] = from_chars(which.data(), which.data() + which.size(), index);
  if (error == std::errc{} && end == which.data() + which.size()) {
    if (index < list.size()) return index;
    throw Error(ErrorKind::configuration,
                fmt::format("{}: the list has {} entries, number {} (counted from 0) does not exist", change.path,
                            list.size(), index),
                change.value.where);
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string* name = name_of(list[i]);
    if (name == nullptr) continue;
    if (*name == which) return i;
    names.push_back(*name);
  }
  check_name(fmt::format("{}: the name", change.path), std::string(which), names, change.value.where);
  return 0;
}

void change_within(CaseValue& value, std::string_view path, const CaseOverride& change);

void change_table(CaseTable& table, std::string_view path, const CaseOverride& change) {
  const Step step = first_step(path, change);
  auto found = std::find_if(table.begin(), table.end(), [&](const CaseEntry& entry) { return entry.key == step.head; });
  if (found == table.end())
    found = table.insert(table.end(), {std::string(step.head), change.value.where, {change.value.where, CaseTable{}}});
  if (step.last)
    replace(found->value, change);
  else
    change_within(found->value, step.rest, change);
}

void change_within(CaseValue& value, std::string_view path, const CaseOverride& change) {
  if (auto* table = std::get_if<CaseTable>(&value.data)) return change_table(*table, path, change);
  auto* list = std::get_if<std::vector<CaseValue>>(&value.data);
  if (list == nullptr)
    throw Error(ErrorKind::configuration,
                fmt::format("{}: nothing named '{}' is in {}", change.path, path, value.kind()), change.value.where);
  const Step step = first_step(path, change);
  CaseValue& element = list->at(element_of(*list, step.head, change));
  if (step.last)
    replace(element, change);
  else
    change_within(element, step.rest, change);
}

}  // namespace

void change_value(CaseTable& root, std::string_view path, const CaseOverride& change) {
  constexpr std::size_t kLongestPath = 1000;
  if (path.size() > kLongestPath)
    throw Error(ErrorKind::configuration, "the path of a key is too long", change.value.where);
  change_table(root, path, change);
}

const CaseEntry* find_entry(const CaseTable& root, std::string_view path) {
  const std::size_t dot = path.find('.');
  const std::string_view head = path.substr(0, dot);
  for (const CaseEntry& entry : root) {
    if (entry.key != head) continue;
    if (dot == std::string_view::npos) return &entry;
    return entry.value.is_table() ? find_entry(entry.value.table(), path.substr(dot + 1)) : nullptr;
  }
  return nullptr;
}

}  // namespace treadmark::io
