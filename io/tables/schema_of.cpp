// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/tables/schema_of.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::io {
namespace {

Json of_type(std::string_view type, bool or_null) {
  return {{"type", or_null ? Json::array({type, "null"}) : Json(type)}};
}

/// "number?: radius".
Json of_words(std::string_view words) {
  const std::size_t colon = words.find(": ");
  std::string_view type = words.substr(0, colon);
  const bool or_null = type.ends_with('?');
  if (or_null) type.remove_suffix(1);
  Json out = of_type(type, or_null);
  if (colon != words.npos) out["description"] = words.substr(colon + 2);
  return out;
}

std::string name_in_template(std::string_view key, bool always) { return std::string(key) + (always ? "" : "?"); }

/// Adds rows to the properties of a template.
void add_rows(Json& properties, const SchemaRows& rows) {
  for (const SchemaRow& row : rows) {
    const std::string_view path = row.key;
    Json* object = &properties;
    bool always = row.always;
    std::size_t begin = 0;
    for (std::size_t dot; (dot = path.find('.', begin)) != path.npos; begin = dot + 1) {
      const bool there = ranges::any_of(
          rows, [&](const SchemaRow& one) { return one.always && one.key.starts_with(path.substr(0, dot + 1)); });
      object = &(*object)[name_in_template(path.substr(begin, dot - begin), there)]["properties"];
      always = always || !there;
    }
    Json said = of_type(row.type, row.or_null);
    if (row.listed) said = {{"type", "array"}, {"items", std::move(said)}};
    if (!row.meaning.empty()) said["description"] = row.meaning;
    Json& own = (*object)[name_in_template(path.substr(begin), always)];
    if (!own.is_null()) said.update(own, true);
    own = std::move(said);
  }
}

Json filled(const Json& node, const SchemaTables& tables) {
  if (node.is_string()) return of_words(node.get<std::string>());
  if (node.is_array()) {
    Json out{{"type", "array"}};
    if (node.size() > 1) out.update({{"minItems", node.at(1)}, {"maxItems", node.at(1)}});
    out["items"] = filled(node.at(0), tables);
    return out;
  }
  Json out = node, members = node.value("properties", Json::object());
  if (node.contains("rows")) add_rows(members, tables.at(node.at("rows").get<std::string>()));
  out.erase("rows"), out.erase("properties");
  for (const char* inner : {"items", "additionalProperties"})
    if (out.contains(inner) && !out[inner].is_boolean()) out[inner] = filled(out[inner], tables);
  if (out.contains("$defs"))
    for (auto& [name, definition] : out["$defs"].items()) definition = filled(definition, tables);
  if (members.empty()) return out;

  if (!out.contains("type")) out["type"] = "object";
  Json required = Json::array(), properties = Json::object();
  for (const auto& [name, member] : members.items()) {
    const bool optional = name.ends_with('?');
    const std::string key = name.substr(0, name.size() - (optional ? 1 : 0));
    if (properties.contains(key)) throw std::logic_error("a schema says twice whether " + key + " may be missing");
    if (!optional) required.push_back(key);
    properties[key] = filled(member, tables);
  }
  if (!required.empty()) out["required"] = std::move(required);
  out["additionalProperties"] = false;
  out["properties"] = std::move(properties);
  return out;
}

}  // namespace

SchemaRows listed(SchemaRows rows) {
  return changed(std::move(rows), [](SchemaRow& row) {
    row.listed = true;
    row.or_null = row.or_null || !row.always;
  });
}

std::string filled_schema(std::string_view text, const SchemaTables& tables) {
  return dumped(filled(Json::parse(text), tables), 2);
}

}  // namespace treadmark::io
