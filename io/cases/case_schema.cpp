// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/case_schema.hpp"

#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "treadmark/io/cases/case_keys.hpp"

namespace treadmark::io {

namespace {

using Json = nlohmann::ordered_json;

Json properties_of(const std::vector<KeyInfo>& keys);

Json value_schema(const KeyInfo& key) {
  Json schema;
  switch (key.type) {
    case KeyType::number:
      schema["type"] = "number";
      break;
    case KeyType::integer:
      schema["type"] = "integer";
      break;
    case KeyType::flag:
      schema["type"] = "boolean";
      break;
    case KeyType::text:
    case KeyType::path:
      schema["type"] = "string";
      schema["minLength"] = 1;
      break;
    case KeyType::choice:
      schema["enum"] = key.choices;
      break;
    case KeyType::number_list:
      schema["type"] = "array";
      schema["items"]["type"] = "number";
      break;
    case KeyType::table_list:
      schema["type"] = "array";
      schema["items"] = properties_of(key.elements);
      break;
  }
  if (key.above) schema["exclusiveMinimum"] = *key.above;
  if (key.at_least) schema["minimum"] = *key.at_least;
  if (key.at_most) schema["maximum"] = *key.at_most;
  if (!key.pattern.empty()) schema["pattern"] = key.pattern;
  return schema;
}

void describe(Json& schema, const KeyInfo& key) {
  schema["description"] = key.doc;
  if (!key.default_text.empty()) schema["default"] = Json::parse(key.default_text);
}

/// Keys that exclude each other must not stand side by side; name gives their name in this object.
void add_exclusions(Json& object, const std::vector<std::pair<std::string, const KeyInfo*>>& keys) {
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = i + 1; j < keys.size(); ++j) {
      const KeyInfo &a = *keys[i].second, &b = *keys[j].second;
      if (a.group.empty() || a.group != b.group || a.alternative == b.alternative) continue;
      object["allOf"].push_back({{"not", {{"required", {keys[i].first, keys[j].first}}}}});
    }
}

Json properties_of(const std::vector<KeyInfo>& keys) {
  Json object{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  std::vector<std::pair<std::string, const KeyInfo*>> named;
  for (const KeyInfo& key : keys) {
    Json value = value_schema(key);
    describe(value, key);
    object["properties"][key.path] = std::move(value);
    if (key.required) object["required"].push_back(key.path);
    named.emplace_back(key.path, &key);
  }
  add_exclusions(object, named);
  return object;
}

/// Properties of the sections; sweep: a list may stand where one value is expected.
Json sections(bool sweep) {
  Json root{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  std::map<std::string, std::vector<std::pair<std::string, const KeyInfo*>>> by_section;
  for (const CaseKey& key : case_keys()) {
    Json* object = &root;
    std::string_view rest = key.info.path, section;
    for (std::size_t dot; (dot = rest.find('.')) != std::string_view::npos; rest.remove_prefix(dot + 1)) {
      Json& child = (*object)["properties"][std::string(rest.substr(0, dot))];
      if (child.is_null())
        child = Json{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
      object = &child;
    }
    section = std::string_view(key.info.path).substr(0, key.info.path.size() - rest.size());
    by_section[std::string(section)].emplace_back(std::string(rest), &key.info);

    Json value = value_schema(key.info);
    const bool list = key.info.type == KeyType::number_list || key.info.type == KeyType::table_list;
    if (sweep && !list) {
      Json values{{"type", "array"}, {"minItems", 1}, {"items", value}};
      value = Json{{"anyOf", {value, values}}};
    }
    describe(value, key.info);
    (*object)["properties"][std::string(rest)] = std::move(value);
  }
  for (const auto& [section, keys] : by_section) {
    Json* object = &root;
    std::string_view rest = section;
    for (std::size_t dot; (dot = rest.find('.')) != std::string_view::npos; rest.remove_prefix(dot + 1))
      object = &(*object)["properties"][std::string(rest.substr(0, dot))];
    add_exclusions(*object, keys);
  }
  for (const ExclusiveSections& e : kExclusiveSections)
    root["properties"][std::string(e.parent)]["allOf"].push_back(
        {{"not", {{"required", {std::string(e.one), std::string(e.other)}}}}});
  return root;
}

std::string type_of(const KeyInfo& key) {
  std::string text;
  switch (key.type) {
    case KeyType::number:
      text = "number";
      break;
    case KeyType::integer:
      text = "integer";
      break;
    case KeyType::flag:
      text = "true, false";
      break;
    case KeyType::text:
      text = "text";
      break;
    case KeyType::path:
      text = "file name";
      break;
    case KeyType::number_list:
      text = "list of numbers";
      break;
    case KeyType::table_list:
      text = "list of tables";
      break;
    case KeyType::choice:
      for (const std::string& one : key.choices) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", one);
      break;
  }
  if (key.above) text += fmt::format(" > {:.6g}", *key.above);
  if (key.at_least && key.at_most)
    text += fmt::format(", {:.6g} ... {:.6g}", *key.at_least, *key.at_most);
  else if (key.at_least)
    text += fmt::format(" >= {:.6g}", *key.at_least);
  else if (key.at_most)
    text += fmt::format(" <= {:.6g}", *key.at_most);
  return text;
}

constexpr std::string_view kTableHead = "| key | type | default | meaning |\n|---|---|---|---|\n";

std::string row(const KeyInfo& key, std::string_view name) {
  return fmt::format("| `{}` | {} | {} | {}{} |\n", name, type_of(key),
                     key.default_text.empty() ? "" : '`' + key.default_text + '`', key.doc,
                     key.required ? " (required)" : "");
}

/// Tables of a list's own keys and of the lists in it.
std::string list_tables(const KeyInfo& list, const std::string& path) {
  std::string text = fmt::format("### `[[{}]]`\n\n{}", path, kTableHead);
  for (const KeyInfo& element : list.elements) text += row(element, element.path);
  text += '\n';
  for (const KeyInfo& element : list.elements)
    if (element.type == KeyType::table_list) text += list_tables(element, path + '.' + element.path);
  return text;
}

}  // namespace

std::string case_file_schema() {
  Json schema;
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = "Treadmark case file";
  schema.update(sections(false));
  Json& properties = schema["properties"];
  properties["title"] = {{"type", "string"}, {"description", "name of the study; without it the name of the file"}};
  properties["cases"] = {{"type", "array"},
                         {"minItems", 1},
                         {"items", sections(true)},
                         {"description",
                          "cases; each overrides some keys, and a list where one value is expected makes one case for "
                          "each of its values"}};
  return schema.dump(2) + '\n';
}

std::string case_key_table() {
  // Sections in the order of their first key.
  std::vector<std::string> order;
  std::map<std::string, std::string> tables;
  std::string lists;
  for (const CaseKey& key : case_keys()) {
    const std::size_t dot = key.info.path.rfind('.');
    const std::string section = key.info.path.substr(0, dot);
    if (!tables.contains(section)) order.push_back(section);
    tables[section] += row(key.info, std::string_view(key.info.path).substr(dot + 1));
    if (key.info.type == KeyType::table_list) lists += list_tables(key.info, key.info.path);
  }
  std::string text;
  for (const std::string& section : order)
    text += fmt::format("### `[{}]`\n\n{}{}\n", section, kTableHead, tables[section]);
  return text + lists;
}

}  // namespace treadmark::io
