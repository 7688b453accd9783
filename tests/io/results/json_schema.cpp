// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/io/results/json_schema.hpp"

#include <set>
#include <stdexcept>

namespace treadmark::testing {
namespace {

bool has_type(const nlohmann::json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  throw std::runtime_error("unknown type " + type);
}

}  // namespace

std::string first_violation(const nlohmann::json& value, const nlohmann::json& schema, const nlohmann::json& root,
                            const std::string& place) {
  static const std::set<std::string> kKnown{
      "$ref",  "type",     "enum",     "properties",  "required", "additionalProperties",
      "items", "minItems", "maxItems", "description", "title",    "$schema",
      "$id",   "$defs"};
  for (const auto& [word, rule] : schema.items())
    if (!kKnown.contains(word)) throw std::runtime_error("the checker does not know the word " + word);

  if (schema.contains("$ref")) {
    const std::string target = schema["$ref"];
    return first_violation(value, root.at(nlohmann::json::json_pointer(target.substr(1))), root, place);
  }
  if (schema.contains("type")) {
    bool fits = false;
    if (schema["type"].is_string())
      fits = has_type(value, schema["type"]);
    else
      for (const auto& type : schema["type"]) fits = fits || has_type(value, type);
    if (!fits) return place + ": wrong type";
  }
  if (schema.contains("enum")) {
    bool fits = false;
    for (const auto& allowed : schema["enum"]) fits = fits || allowed == value;
    if (!fits) return place + ": not one of the allowed values";
  }
  if (value.is_object()) {
    if (schema.contains("required"))
      for (const std::string key : schema["required"])
        if (!value.contains(key)) return place + "/" + key + ": missing";
    for (const auto& [key, item] : value.items()) {
      if (schema.contains("properties") && schema["properties"].contains(key)) {
        const std::string found = first_violation(item, schema["properties"][key], root, place + "/" + key);
        if (!found.empty()) return found;
      } else if (schema.contains("additionalProperties") && schema["additionalProperties"] == false) {
        return place + "/" + key + ": not in the schema";
      }
    }
  }
  if (value.is_array()) {
    if (schema.contains("minItems") && value.size() < schema["minItems"]) return place + ": too few items";
    if (schema.contains("maxItems") && value.size() > schema["maxItems"]) return place + ": too many items";
    if (schema.contains("items"))
      for (std::size_t i = 0; i < value.size(); ++i) {
        const std::string found = first_violation(value[i], schema["items"], root, place + "/" + std::to_string(i));
        if (!found.empty()) return found;
      }
  }
  return {};
}

bool is_required(const nlohmann::json& object, const std::string& key) {
  if (!object.contains("required")) return false;
  for (const std::string one : object["required"])
    if (one == key) return true;
  return false;
}

}  // namespace treadmark::testing
