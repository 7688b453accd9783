// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/table_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "treadmark/io/settings/key_info.hpp"

namespace treadmark::io {
namespace {

/// Three numbers of a list. Error(configuration) at the value.
Vec3 triple_of(KeyInfo info, const CaseValue& value) {
  info.type = KeyType::triple;
  check_value(info, value);
  if (value.list().size() != 3)
    throw Error(ErrorKind::configuration,
                fmt::format("{} has {} numbers, it needs 3: x, y, z", info.path, value.list().size()), value.where);
  const std::vector<double> numbers = numbers_of(value, unit_of_key(info.path));
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

TableReader::TableReader(const CaseTable& table, SourcePosition where, std::string path,
                         const std::vector<KeyInfo>& known)
    : table_(table), where_(std::move(where)), path_(std::move(path)), known_(known) {
  std::vector<std::string> names;
  for (const KeyInfo& key : known_) names.push_back(key.path);
  for (const CaseEntry& entry : table_) {
    if (std::find(names.begin(), names.end(), entry.key) != names.end()) continue;
    const std::string near = nearest_key(entry.key, names);
    throw Error(
        ErrorKind::configuration, fmt::format("unknown key '{}'", path_of(std::string_view(entry.key).substr(0, 100))),
        entry.key_where,
        near.empty() ? "see docs/simulation-files.md for all keys" : fmt::format("did you mean '{}'?", path_of(near)));
  }
}

std::string TableReader::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TableReader::fail(std::string message, std::string advice) const {
  throw Error(ErrorKind::configuration, std::move(message), where_, std::move(advice));
}

const CaseValue* TableReader::find(std::string_view key) const {
  const auto found =
      std::find_if(table_.begin(), table_.end(), [&](const CaseEntry& entry) { return entry.key == key; });
  return found == table_.end() ? nullptr : &found->value;
}

const CaseValue& TableReader::need(std::string_view key, std::string advice) const {
  const CaseValue* value = find(key);
  if (value == nullptr)
    fail(fmt::format("{} is missing", path_of(key)), advice.empty() ? info(key).missing : std::move(advice));
  return *value;
}

const CaseTable* TableReader::table(std::string_view key) const {
  const CaseValue* value = find(key);
  if (value == nullptr) return nullptr;
  if (!value->is_table())
    throw Error(ErrorKind::configuration, fmt::format("{} must be a table, found {}", path_of(key), value->kind()),
                value->where);
  return &value->table();
}

std::vector<const CaseValue*> TableReader::tables(std::string_view key) const {
  std::vector<const CaseValue*> result;
  const CaseValue* list = find(key);
  if (list == nullptr) return result;
  const auto wrong = [&](const CaseValue& value) {
    throw Error(ErrorKind::configuration,
                fmt::format("{0} must be a list of tables, [[{0}]], found {1}", path_of(key), value.kind()),
                value.where);
  };
  if (!list->is_list()) wrong(*list);
  for (const CaseValue& one : list->list()) {
    if (!one.is_table()) wrong(one);
    result.push_back(&one);
  }
  return result;
}

KeyInfo TableReader::info(std::string_view key) const {
  KeyInfo result = *std::find_if(known_.begin(), known_.end(), [&](const KeyInfo& one) { return one.path == key; });
  result.path = path_of(key);
  return result;
}

const CaseValue* TableReader::checked_if(std::string_view key) const {
  return find(key) == nullptr ? nullptr : &checked(key);
}

const CaseValue& TableReader::checked(std::string_view key) const {
  const CaseValue& value = need(key);
  const KeyInfo one = info(key);
  if (one.type == KeyType::text_list)
    words(key);
  else if (one.type == KeyType::triple)
    triple_of(one, value);
  else if (one.type == KeyType::triple_list)
    points(key);
  else
    check_value(one, value);
  return value;
}

std::string TableReader::text(std::string_view key) const { return checked(key).text(); }

std::string TableReader::text_or(std::string_view key, std::string otherwise) const {
  return find(key) == nullptr ? std::move(otherwise) : text(key);
}

std::vector<std::string> TableReader::words(std::string_view key) const {
  const CaseValue* list = find(key);
  if (list == nullptr) return {};
  std::vector<std::string> result;
  const auto wrong = [&](const CaseValue& value) {
    throw Error(ErrorKind::configuration,
                fmt::format("{} must be a list of texts, found {}", path_of(key), value.kind()), value.where);
  };
  if (!list->is_list()) wrong(*list);
  for (const CaseValue& one : list->list()) {
    if (!std::holds_alternative<std::string>(one.data)) wrong(one);
    result.push_back(one.text());
  }
  return result;
}

std::vector<Vec3> TableReader::points(std::string_view key) const {
  const CaseValue* list = find(key);
  if (list == nullptr) return {};
  if (!list->is_list() || list->list().empty() || !list->list().front().is_list())
    throw Error(ErrorKind::configuration, fmt::format("{} must be a list of points, [[x, y, z], ...]", path_of(key)),
                list->where);
  std::vector<Vec3> result;
  for (const CaseValue& one : list->list()) result.push_back(triple_of(info(key), one));
  return result;
}

void TableReader::exclude(std::string_view one, std::string_view other) const {
  const CaseValue* second = find(other);
  if (find(one) != nullptr && second != nullptr)
    throw Error(ErrorKind::configuration, fmt::format("{} and {} exclude each other", path_of(one), path_of(other)),
                second->where, "give one of them");
}

void TableReader::go_with(std::string_view one, std::string_view other) const {
  const CaseValue* first = find(one);
  if (first == nullptr || find(other) != nullptr) return;
  throw Error(ErrorKind::configuration, fmt::format("{} does nothing without {}", path_of(one), other), first->where,
              fmt::format("give {}, or leave it out", other));
}

void check_name(std::string_view what, const std::string& name, std::span<const std::string> known,
                const SourcePosition& where) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string near = nearest_key(name, known);
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
  throw Error(
      ErrorKind::configuration, fmt::format("{} '{}' is not known", what, name.substr(0, 100)), where,
      near.empty() ? fmt::format("there are: {}", all.substr(0, 400)) : fmt::format("did you mean '{}'?", near));
}

}  // namespace treadmark::io
