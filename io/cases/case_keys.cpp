// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/cases/case_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/key_builder.hpp"
#include "treadmark/io/settings/key_schema.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::io {

namespace {

[[noreturn]] void fail(std::string message, const SourcePosition& where, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), where, std::move(advice));
}

const std::vector<std::string>& all_paths() {
  static const std::vector<std::string> paths = [] {
    std::vector<std::string> list;
    for (const CaseKey& key : case_keys()) list.push_back(key.info.path);
    return list;
  }();
  return paths;
}

const std::map<std::string, const CaseKey*, std::less<>>& keys_by_path() {
  static const auto index = [] {
    std::map<std::string, const CaseKey*, std::less<>> map;
    for (const CaseKey& key : case_keys()) map[key.info.path] = &key;
    return map;
  }();
  return index;
}

const std::set<std::string, std::less<>>& sections() {
  static const auto all = [] {
    std::set<std::string, std::less<>> set;
    for (const CaseKey& key : case_keys())
      for (std::size_t dot = key.info.path.find('.'); dot != std::string::npos; dot = key.info.path.find('.', dot + 1))
        set.insert(key.info.path.substr(0, dot));
    return set;
  }();
  return all;
}

struct Assignment {
  const CaseKey* key = nullptr;
  const CaseValue* value = nullptr;
  SourcePosition where;
};

void collect(const CaseTable& table, const std::string& prefix, std::vector<Assignment>& out) {
  for (const CaseEntry& entry : table) {
    const std::string path = prefix.empty() ? entry.key : prefix + '.' + entry.key;
    const auto found = keys_by_path().find(path);
    if (found != keys_by_path().end()) {
      out.push_back({found->second, &entry.value, entry.key_where});
    } else if (sections().contains(path)) {
      if (!entry.value.is_table())
        fail(fmt::format("{} must be a table, found {}", path, entry.value.kind()), entry.value.where);
      collect(entry.value.table(), path, out);
    } else {
      const std::vector<std::string> tables(sections().begin(), sections().end());
      refuse_unknown_key(path, entry.value.is_table() ? tables : all_paths(), entry.key_where);
    }
  }
}

void check_scope(const Case& c, const KeyInfo& key, const SourcePosition& where) {
  const bool patch = std::holds_alternative<BasicCase>(c.content);
  if (key.scope == KeyScope::wheel_rail && patch)
    fail(fmt::format("{} belongs to a wheel-rail case, but this is a [patch] case", key.path), where);
  if (key.scope == KeyScope::patch && !patch)
    fail(fmt::format("{} belongs to a [patch] case, but this is a wheel-rail case", key.path), where);
}

/// Where text is expected, a word that happens to be a TOML number (60E1) is that word.
CaseValue meant_value(const KeyInfo& key, const CaseOverride& assignment) {
  const bool textual = key.type == KeyType::text || key.type == KeyType::path || key.type == KeyType::choice;
  const CaseValue& value = assignment.value;
  if (!textual || value.is_list() || value.is_table() || std::holds_alternative<std::string>(value.data)) return value;
  return {value.where, assignment.raw};
}

/// The value of an override that changes the key `name` of a list's table, checked; name may lead on into a nested
/// list.
CaseValue element_value(const KeyInfo& list, const std::string& name, const CaseOverride& assignment) {
  const SourcePosition& where = assignment.value.where;
  for (const KeyInfo& element : list.elements) {
    if (element.path == name) {
      CaseValue value = meant_value(element, assignment);
      check_elements(list, {{name, where, value}}, where, false);
      return value;
    }
    if (element.type == KeyType::table_list && name.starts_with(element.path + '.'))
      return element_value(
          element, split_element_path(element, std::string_view(name).substr(element.path.size() + 1), where).key,
          assignment);
  }
  check_elements(list, {{name, where, assignment.value}}, where, false);  // says what is wrong with the name
  return assignment.value;
}

/// Where the pitch rate follows from other keys it is that of their newest values.
void keep_rolling(std::vector<CaseKey>& keys) {
  constexpr std::string_view kFrom[] = {"wheelset.velocity_", "wheelset.nominal_radius_mm", "wheelset.rolling",
                                        "roller."};
  for (CaseKey& key : keys)
    if (ranges::any_of(kFrom, [&](std::string_view name) { return key.info.path.starts_with(name); }))
      key.set = [set = std::move(key.set)](Case& c, const CaseValue& v, const std::filesystem::path& folder) {
        set(c, v, folder);
        auto& w = content_of<WheelRailCase>(c);
        if (w.rolls_by_radius) w.state.velocity.pitch = rolling_rate(w);
      };
}

}  // namespace

std::span<const CaseKey> case_keys() {
  static const std::vector<CaseKey> keys = [] {
    KeyList list;
    add_general_keys(list);
    add_wheel_rail_keys(list);
    add_balance_keys(list);
    add_shape_keys(list);
    add_defect_keys(list);
    add_patch_keys(list);
    add_patch_geometry_keys(list);
    add_heat_keys(list);
    add_subsurface_keys(list);
    keep_rolling(list.keys);
    return std::move(list.keys);
  }();
  return keys;
}

namespace {

/// A value that is refused has its limit in the message; here what is meant by one that is often tried.
void check_meant(const KeyInfo& key, const CaseValue& value) {
  const bool zero = (std::holds_alternative<double>(value.data) || std::holds_alternative<std::int64_t>(value.data)) &&
                    value.number() == 0.0;
  if (key.path == "friction.coefficient" && zero)
    fail(fmt::format("{} = 0 must be at least {}", key.path, *key.at_least), value.where,
         "contact without friction is case.regime = \"none\"");
  check_value(key, value);
}

}  // namespace

void check_exclusive_sections(std::span<const GivenKey> keys) {
  for (const ExclusiveSections& sections : kExclusiveSections) {
    const GivenKey* first[2] = {nullptr, nullptr};
    for (const GivenKey& given : keys)
      for (const int k : {0, 1})
        if (first[k] == nullptr &&
            given.path.starts_with(fmt::format("{}.{}.", sections.parent, k == 0 ? sections.one : sections.other)))
          first[k] = &given;
    if (first[0] == nullptr || first[1] == nullptr) continue;
    const GivenKey* second = first[0] > first[1] ? first[0] : first[1];
    fail(fmt::format("[{0}.{1}] and [{0}.{2}] exclude each other", sections.parent, sections.one, sections.other),
         *second->where, "give one of them");
  }
}

void apply_table(Case& target, const CaseTable& table, const std::filesystem::path& folder) {
  std::vector<Assignment> assignments;
  collect(table, "", assignments);
  ChosenKeys chosen;
  std::vector<GivenKey> given;
  for (const Assignment& a : assignments) {
    check_scope(target, a.key->info, a.where);
    check_meant(a.key->info, *a.value);
    check_exclusive(a.key->info, a.where, chosen);
    given.push_back({a.key->info.path, &a.where});
  }
  check_exclusive_sections(given);
  std::stable_sort(assignments.begin(), assignments.end(),
                   [](const Assignment& a, const Assignment& b) { return a.key < b.key; });
  for (const Assignment& a : assignments) a.key->set(target, *a.value, folder);
}

const CaseKey* case_key(std::string_view path) {
  const auto found = keys_by_path().find(path);
  return found == keys_by_path().end() ? nullptr : found->second;
}

void refuse_unknown_case_key(std::string_view path, const SourcePosition& where) {
  refuse_unknown_key(path, all_paths(), where);
}

void apply_value(Case& target, const CaseKey& key, const CaseValue& value, const std::filesystem::path& folder) {
  check_scope(target, key.info, value.where);
  check_meant(key.info, value);
  key.set(target, value, folder);
}

Case case_without_keys(bool patch) {
  Case c;
  if (patch) {
    c.content = BasicCase{};
  } else {
    ElementGrid& elements = std::get<WheelRailCase>(c.content).discretisation;
    elements.choose_dx = elements.choose_ds = true;
  }
  return c;
}

void apply_assignment(Case& target, const CaseOverride& assignment, const std::filesystem::path& folder) {
  const SourcePosition& where = assignment.value.where;
  const std::string& path = assignment.path;
  if (const CaseKey* key = case_key(path); key != nullptr)
    return apply_value(target, *key, meant_value(key->info, assignment), folder);
  // list.index.key, for example wheel.flats.0.depth_mm
  for (const CaseKey& key : case_keys()) {
    if (key.info.type != KeyType::table_list || !path.starts_with(key.info.path + '.')) continue;
    const ElementPath place =
        split_element_path(key.info, std::string_view(path).substr(key.info.path.size() + 1), where);
    check_scope(target, key.info, where);
    key.set_element(target, place.index, {{place.key, where, element_value(key.info, place.key, assignment)}}, where);
    return;
  }
  refuse_unknown_case_key(path, where);
}

namespace {

bool belongs_to(const Case& c, const KeyInfo& key) {
  return key.scope == KeyScope::any || key.scope == static_cast<KeyScope>(1 + c.content.index());
}

/// The number at the end of a path into a list of tables, "0.waves.1.amplitude_mm".
std::optional<double> number_within(const CaseValue& list, std::string_view path) {
  const CaseValue* value = &list;
  while (!path.empty()) {
    const std::string_view name = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(path.size(), name.size() + 1));
    const CaseValue* next = nullptr;
    if (value->is_list()) {
      std::size_t index = 0;
      from_chars(name.data(), name.data() + name.size(), index);
      if (index < value->list().size()) next = &value->list()[index];
    } else if (value->is_table()) {
      for (const CaseEntry& entry : value->table())
        if (entry.key == name) next = &entry.value;
    }
    if (next == nullptr) return std::nullopt;
    value = next;
  }
  const bool number = std::holds_alternative<double>(value->data) || std::holds_alternative<std::int64_t>(value->data);
  return number ? std::optional(value->number()) : std::nullopt;
}

/// The key at the end of a path into a list of tables. Errors: as split_element_path, and for a name that is none.
const KeyInfo& element_key(const KeyInfo& list, std::string_view rest) {
  const ElementPath place = split_element_path(list, rest, {});
  std::vector<std::string> known;
  for (const KeyInfo& element : list.elements) {
    if (element.path == place.key) return element;
    if (element.type == KeyType::table_list && place.key.starts_with(element.path + '.'))
      return element_key(element, std::string_view(place.key).substr(element.path.size() + 1));
    known.push_back(element.path);
  }
  refuse_unknown_key(place.key, known, {});
}

void require_number(const KeyInfo& key, const std::string& path) {
  if (key.type != KeyType::number) fail(fmt::format("{} is no number", path), {}, "name keys that are numbers");
}

}  // namespace

std::optional<double> number_of(const Case& c, const std::string& path) {
  if (const CaseKey* key = case_key(path); key != nullptr) {
    require_number(key->info, path);
    if (!belongs_to(c, key->info)) return std::nullopt;
    const std::string written = key->written ? key->written(c, {}) : std::string();
    return written.empty() ? std::nullopt : number_within(parse_toml("x = " + written, path).front().value, "");
  }
  for (const CaseKey& key : case_keys()) {
    if (key.info.type != KeyType::table_list || !path.starts_with(key.info.path + '.')) continue;
    const std::string_view rest = std::string_view(path).substr(key.info.path.size() + 1);
    require_number(element_key(key.info, rest), path);
    if (!belongs_to(c, key.info)) return std::nullopt;
    const std::string written = key.written ? key.written(c, {}) : std::string();
    return written.empty() ? std::nullopt : number_within(parse_toml("x = " + written, path).front().value, rest);
  }
  refuse_unknown_case_key(path, {});
}

std::string case_file_schema() {
  const std::vector<KeyInfo> keys = infos_of(case_keys());
  const auto tables = [&](bool sweep) { return Json::parse(tables_schema(keys, kExclusiveSections, sweep)); };
  Json schema{{"$schema", kSchemaDialect}, {"title", "Treadmark case file"}};
  schema.update(tables(false));
  Json& properties = schema["properties"];
  properties["title"] = {{"type", "string"}, {"description", "name of the study; without it the name of the file"}};
  properties["cases_file"] = {
      {"type", "string"},
      {"description", "table with commas whose heads are keys: every row is a case, in place of cases"}};
  properties["cases"] = {{"type", "array"},
                         {"minItems", 1},
                         {"items", tables(true)},
                         {"description",
                          "cases; each overrides some keys, and a list where one value is expected makes one case for "
                          "each of its values"}};
  return dumped(schema, 2) + '\n';
}

std::string case_key_table() { return key_table(infos_of(case_keys())); }

}  // namespace treadmark::io
