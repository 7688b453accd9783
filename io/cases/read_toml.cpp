// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/read_toml.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_text.hpp"
#include "treadmark/io/cases/validate_case.hpp"
#include "treadmark/io/profiles/sha256.hpp"

namespace treadmark::io {

namespace {

constexpr std::size_t kMostCases = 100000;

bool is_scalar_key(const std::string& path) {
  for (const CaseKey& key : case_keys())
    if (key.info.path == path) return key.info.type != KeyType::number_list && key.info.type != KeyType::table_list;
  return false;
}

/// Length of the lists that stand where one value is expected; all lists of one entry must agree.
void sweep_length(const CaseTable& table, const std::string& prefix, std::optional<std::size_t>& length) {
  for (const CaseEntry& entry : table) {
    const std::string path = prefix.empty() ? entry.key : prefix + '.' + entry.key;
    if (entry.value.is_table()) {
      sweep_length(entry.value.table(), path, length);
    } else if (entry.value.is_list() && is_scalar_key(path)) {
      const std::size_t count = entry.value.list().size();
      if (count == 0) throw Error(ErrorKind::configuration, fmt::format("the list of {} is empty", path), entry.value.where);
      if (length && *length != count)
        throw Error(ErrorKind::configuration,
                    fmt::format("the list of {} has {} values, another one of the same entry has {}", path, count, *length),
                    entry.value.where, "lists of one [[cases]] entry advance together");
      length = count;
    }
  }
}

/// The entry with the i-th value in place of every such list.
CaseTable sweep_element(const CaseTable& table, const std::string& prefix, std::size_t i) {
  CaseTable result;
  for (const CaseEntry& entry : table) {
    const std::string path = prefix.empty() ? entry.key : prefix + '.' + entry.key;
    CaseEntry one = entry;
    if (entry.value.is_table()) one.value.data = sweep_element(entry.value.table(), path, i);
    else if (entry.value.is_list() && is_scalar_key(path)) one.value = entry.value.list().at(i);
    result.push_back(std::move(one));
  }
  return result;
}

std::vector<CaseOverride> parse_overrides(std::span<const std::string> overrides) {
  std::vector<CaseOverride> parsed;
  for (const std::string& one : overrides) parsed.push_back(parse_override(one));
  return parsed;
}

void expand_entry(const CaseEntry& cases, const CaseValue& entry, const Case& defaults, const std::filesystem::path& folder,
                  std::vector<Case>& out) {
  if (!entry.is_table())
    throw Error(ErrorKind::configuration, fmt::format("[[cases]] must be tables, found {}", entry.kind()), entry.where);
  std::optional<std::size_t> count;
  sweep_length(entry.table(), "", count);
  for (std::size_t i = 0; i < count.value_or(1); ++i) {
    if (out.size() >= kMostCases)
      throw Error(ErrorKind::configuration, fmt::format("more than {} cases", kMostCases), cases.key_where);
    Case next = defaults;
    next.where = entry.where;
    if (count) apply_table(next, sweep_element(entry.table(), "", i), folder);
    else apply_table(next, entry.table(), folder);
    out.push_back(std::move(next));
  }
}

}  // namespace

CaseFile parse_case_text(std::string_view text, const std::filesystem::path& name, std::span<const std::string> overrides) {
  CaseFile result;
  result.path = name;
  result.sha256 = sha256_hex(text);
  result.title = name.stem().string();
  const std::vector<CaseOverride> changes = parse_overrides(overrides);
  const std::filesystem::path folder = name.parent_path();

  // Title and cases apart, everything at the top is common to all cases.
  const CaseTable document = parse_toml(text, name.string());
  CaseTable common;
  const CaseEntry* entries = nullptr;
  Case defaults;
  defaults.where = {name.string(), 1, 1};
  for (const CaseEntry& entry : document) {
    if (entry.key == "title") {
      if (!std::holds_alternative<std::string>(entry.value.data))
        throw Error(ErrorKind::configuration, fmt::format("title must be text, found {}", entry.value.kind()), entry.value.where);
      result.title = entry.value.text();
    } else if (entry.key == "cases") {
      if (!entry.value.is_list() || entry.value.list().empty())
        throw Error(ErrorKind::configuration, "cases must be a list of tables, [[cases]]", entry.value.where);
      entries = &entry;
    } else {
      if (entry.key == "patch") defaults.content = BasicCase{};
      common.push_back(entry);
    }
  }
  apply_table(defaults, common, folder);

  if (entries == nullptr) result.cases.push_back(defaults);
  else
    for (const CaseValue& entry : entries->value.list()) expand_entry(*entries, entry, defaults, folder, result.cases);

  int number = 0;
  for (Case& c : result.cases) {
    c.number = ++number;
    for (const CaseOverride& change : changes) apply_assignment(c, change, folder);
    validate_case(c);
  }
  settle_sequences(result.cases);
  return result;
}

void apply_overrides(CaseFile& target, std::span<const std::string> overrides) {
  const std::vector<CaseOverride> changes = parse_overrides(overrides);
  if (changes.empty()) return;
  std::vector<Case> changed = target.cases;
  for (Case& c : changed) {
    for (const CaseOverride& change : changes) apply_assignment(c, change, target.path.parent_path());
    validate_case(c);
  }
  settle_sequences(changed);
  target.cases = std::move(changed);
}

CaseFile read_case_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_case_text(read_text(file), file, overrides);
}

void apply_override(Case& target, std::string_view assignment) {
  const CaseOverride change = parse_override(assignment);
  Case changed = target;
  apply_assignment(changed, change, std::filesystem::path(target.where.file).parent_path());
  validate_case(changed);
  target = std::move(changed);
}

}  // namespace treadmark::io
