// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/key_schema.hpp"
#include "treadmark/io/tables/number.hpp"

#include <map>

#include <fmt/format.h>

namespace treadmark::io {

namespace {

Json properties_of(const std::vector<KeyInfo>& keys);

Json closed_object() { return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}}; }

/// Of a type of keys: its JSON type, that of its items, and what the documentation calls it.
struct TypeWords {
  const char *json, *items, *shown;
};
constexpr TypeWords kTypeWords[] = {{"number", "", "number"},
                                    {"integer", "", "integer"},
                                    {"boolean", "", "true, false"},
                                    {"string", "", "text"},
                                    {"", "", ""},
                                    {"string", "", "file name"},
                                    {"array", "number", "list of numbers"},
                                    {"array", "number", "3 numbers"},
                                    {"array", "number", "3 numbers or none"},
                                    {"array", "array", "list of 3 numbers each"},
                                    {"array", "string", "list of texts"},
                                    {"array", "", "list"},
                                    {"object", "", "table"},
                                    {"array", "object", "list of tables"}};
static_assert(std::size(kTypeWords) == static_cast<std::size_t>(KeyType::table_list) + 1);

const TypeWords& words_of(const KeyInfo& key) { return kTypeWords[static_cast<std::size_t>(key.type)]; }

bool is_table(const KeyInfo& key) { return key.type == KeyType::table || key.type == KeyType::table_list; }

Json value_schema(const KeyInfo& key) {
  if (key.type == KeyType::choice) return {{"enum", key.choices}};
  if (key.type == KeyType::table) {
    Json table = properties_of(key.elements);
    if (key.choices.empty()) return table;
    table["type"] = Json::array({"object", "string"});
    table["pattern"] = fmt::format("^({})$", fmt::join(key.choices, "|"));
    return table;
  }
  const TypeWords& words = words_of(key);
  Json schema{{"type", words.json}}, items;
  if (key.type == KeyType::text || key.type == KeyType::path) schema["minLength"] = 1;
  if (key.type == KeyType::table_list)
    items = properties_of(key.elements);
  else if (words.items[0] != '\0')
    items["type"] = words.items;
  if (key.type == KeyType::triple_list)
    items.update({{"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}});
  const auto limit = [&](Json& object) {
    if (key.above) object["exclusiveMinimum"] = *key.above;
    if (key.at_least) object["minimum"] = *key.at_least;
    if (key.at_most) object["maximum"] = *key.at_most;
  };
  const bool triple = key.type == KeyType::triple;
  if (triple) limit(items);
  if (!items.is_null()) schema["items"] = std::move(items);
  if (triple) schema["minItems"] = 3;
  if (triple || key.type == KeyType::direction) schema["maxItems"] = 3;
  if (!triple) limit(schema);
  if (!key.pattern.empty()) schema["pattern"] = key.pattern;
  if (key.type == KeyType::number && !key.choices.empty())
    return {{"anyOf", {std::move(schema), Json{{"enum", key.choices}}}}};
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
  if (keys.empty()) return {{"type", "object"}};
  Json object = closed_object();
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

/// Where the table of a key stands in a schema, made if it is not there; name: what is left of the path.
Json& table_of(Json& root, std::string_view path, std::string_view& name) {
  Json* object = &root;
  for (std::size_t dot; (dot = path.find('.')) != std::string_view::npos; path.remove_prefix(dot + 1)) {
    Json& child = (*object)["properties"][std::string(path.substr(0, dot))];
    if (child.is_null()) child = closed_object();
    object = &child;
  }
  name = path;
  return *object;
}

Json sections_of(std::span<const KeyInfo> keys, std::span<const ExclusiveSections> exclusive, bool sweep) {
  Json root = closed_object();
  std::map<std::string, std::vector<std::pair<std::string, const KeyInfo*>>> by_section;
  std::string_view name;
  for (const KeyInfo& key : keys) {
    Json& table = table_of(root, key.path, name);
    by_section[key.path.substr(0, key.path.size() - name.size())].emplace_back(std::string(name), &key);
    Json value = value_schema(key);
    if (sweep && !is_list(key)) {
      Json values{{"type", "array"}, {"minItems", 1}, {"items", value}};
      value = Json{{"anyOf", {value, values}}};
    }
    describe(value, key);
    table["properties"][std::string(name)] = std::move(value);
    if (key.required) table["required"].push_back(name);
  }
  for (const auto& [section, named] : by_section) add_exclusions(table_of(root, section, name), named);
  for (const ExclusiveSections& e : exclusive)
    root["properties"][std::string(e.parent)]["allOf"].push_back(
        {{"not", {{"required", {std::string(e.one), std::string(e.other)}}}}});
  return root;
}

std::string type_of(const KeyInfo& key) {
  std::string text = words_of(key).shown;
  if (key.above) text += fmt::format(" > {:.6g}", *key.above);
  if (key.at_least && key.at_most)
    text += fmt::format(", {:.6g} ... {:.6g}", *key.at_least, *key.at_most);
  else if (key.at_least)
    text += fmt::format(" >= {:.6g}", *key.at_least);
  else if (key.at_most)
    text += fmt::format(" <= {:.6g}", *key.at_most);
  for (const std::string& one : key.choices) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", one);
  return text;
}

constexpr std::string_view kTableHead = "| key | type | default | meaning |\n|---|---|---|---|\n";

std::string row(const KeyInfo& key, std::string_view name) {
  return fmt::format("| `{}` | {} | {} | {}{} |\n", name, type_of(key),
                     key.default_text.empty() ? "" : '`' + key.default_text + '`', key.doc,
                     key.required ? " (required)" : "");
}

/// The keys of a table or of those of a list, and of the tables in it.
std::string list_tables(const KeyInfo& list, const std::string& path) {
  if (list.elements.empty()) return {};
  std::string text = fmt::format("### `{}`\n\n", list.type == KeyType::table ? '[' + path + ']' : "[[" + path + "]]");
  text += kTableHead;
  for (const KeyInfo& element : list.elements) text += row(element, element.path);
  text += '\n';
  for (const KeyInfo& element : list.elements)
    if (is_table(element)) text += list_tables(element, path + '.' + element.path);
  return text;
}

}  // namespace

bool is_list(const KeyInfo& key) { return std::string_view(words_of(key).json) == "array"; }

std::string tables_schema(std::span<const KeyInfo> keys, std::span<const ExclusiveSections> exclusive, bool sweep) {
  return sections_of(keys, exclusive, sweep).dump();
}

std::string file_schema(std::string_view title, std::span<const KeyInfo> keys) {
  Json schema{{"$schema", kSchemaDialect}, {"title", title}};
  schema.update(sections_of(keys, {}, false));
  return dumped(schema, 2) + '\n';
}

std::string key_table(std::span<const KeyInfo> keys) {
  // Sections in the order of their first key.
  std::vector<std::string> order;
  std::map<std::string, std::string> tables;
  std::string lists;
  for (const KeyInfo& key : keys) {
    const std::size_t dot = key.path.rfind('.');
    const std::string section = key.path.substr(0, dot);
    if (is_table(key)) lists += list_tables(key, key.path);
    if (dot == std::string::npos) continue;  // of the file itself
    if (!tables.contains(section)) order.push_back(section);
    tables[section] += row(key, std::string_view(key.path).substr(dot + 1));
  }
  std::string text;
  for (const std::string& section : order)
    text += fmt::format("### `[{}]`\n\n{}{}\n", section, kTableHead, tables[section]);
  return text + lists;
}

}  // namespace treadmark::io
