// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/tables/schema_of.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace treadmark::io {
namespace {

using nlohmann::json;

json filled(const std::string& text, const SchemaTables& tables = {}) {
  return json::parse(filled_schema(text, tables));
}

TEST(SchemaOf, WordsStandForTypes) {
  EXPECT_EQ(filled(R"("integer")"), json::parse(R"({"type": "integer"})"));
  EXPECT_EQ(filled(R"("number?")"), json::parse(R"({"type": ["number", "null"]})"));
  EXPECT_EQ(filled(R"("string?: why: none")"),
            json::parse(R"({"type": ["string", "null"], "description": "why: none"})"));
  EXPECT_EQ(filled(R"(["number", 3])"),
            json::parse(R"({"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number"}})"));
  EXPECT_EQ(filled(R"([["boolean"]])"),
            json::parse(R"({"type": "array", "items": {"type": "array", "items": {"type": "boolean"}}})"));
}

TEST(SchemaOf, ObjectsAreClosedAndRestIsTakenAsItIs) {
  EXPECT_EQ(filled(R"({"title": "a", "properties": {"x_mm": "number", "side?": {"enum": ["left", "right"]}},
                       "$defs": {"y": "integer"}})"),
            json::parse(R"({"title": "a", "type": "object", "required": ["x_mm"], "additionalProperties": false,
                            "properties": {"x_mm": {"type": "number"}, "side": {"enum": ["left", "right"]}},
                            "$defs": {"y": {"type": "integer"}}})"));
  EXPECT_EQ(filled(R"({"type": ["object", "null"], "properties": {"x?": {"$ref": "#/$defs/x"}}})"),
            json::parse(R"({"type": ["object", "null"], "additionalProperties": false,
                            "properties": {"x": {"$ref": "#/$defs/x"}}})"));
  EXPECT_EQ(filled(R"({"type": "object", "additionalProperties": "string"})"),
            json::parse(R"({"type": "object", "additionalProperties": {"type": "string"}})"));
}

TEST(SchemaOf, RowsFillObjects) {
  const SchemaTables tables{
      {"wheel", {{"radius_mm", "number", true, true, "at the tape line"}, {"name", "string", false, false}}}};
  EXPECT_EQ(filled(R"({"rows": "wheel"})", tables), json::parse(R"({
    "type": "object", "required": ["radius_mm"], "additionalProperties": false,
    "properties": {"radius_mm": {"type": ["number", "null"], "description": "at the tape line"},
                   "name": {"type": "string"}}})"));
  EXPECT_EQ(filled(R"({"rows": "wheel", "properties": {"flats": "integer", "name?": {"enum": ["a"]}}})", tables),
            json::parse(R"({
    "type": "object", "required": ["flats", "radius_mm"], "additionalProperties": false,
    "properties": {"radius_mm": {"type": ["number", "null"], "description": "at the tape line"},
                   "name": {"type": "string", "enum": ["a"]}, "flats": {"type": "integer"}}})"));
}

TEST(SchemaOf, ListsHaveNullWhereAnItemLacksIt) {
  const SchemaTables tables{
      {"wheels", listed({{"flat", "boolean", false, true, "worn"}, {"name", "string", false, false}})}};
  EXPECT_EQ(filled(R"({"rows": "wheels"})", tables), json::parse(R"({
    "type": "object", "required": ["flat"], "additionalProperties": false, "properties": {
      "flat": {"type": "array", "items": {"type": "boolean"}, "description": "worn"},
      "name": {"type": "array", "items": {"type": ["string", "null"]}}}})"));
}

// What is known together stands in an object that may be missing; beside what is always known each may be missing.
TEST(SchemaOf, ObjectsOfRows) {
  const SchemaTables tables{{"pair",
                             {{"track.gauge_mm", "number", true, true},
                              {"roller.radius_mm", "number", true, false},
                              {"track.gap_mm", "number", true, false},
                              {"roller.rate", "number", true, false}}}};
  EXPECT_EQ(filled(R"({"rows": "pair", "properties": {"roller?": {"description": "in place of the rail"}}})", tables),
            json::parse(R"({
    "type": "object", "required": ["track"], "additionalProperties": false, "properties": {
      "track": {"type": "object", "required": ["gauge_mm"], "additionalProperties": false,
                "properties": {"gauge_mm": {"type": ["number", "null"]}, "gap_mm": {"type": ["number", "null"]}}},
      "roller": {"description": "in place of the rail", "type": "object", "required": ["radius_mm", "rate"],
                 "additionalProperties": false,
                 "properties": {"radius_mm": {"type": ["number", "null"]}, "rate": {"type": ["number", "null"]}}}}})"));
}

TEST(SchemaOf, RefusesMistakes) {
  const SchemaTables tables{{"wheel", {{"radius_mm", "number"}}}};
  EXPECT_THROW(filled(R"({"rows": "rail"})", tables), std::logic_error);
  EXPECT_THROW(filled(R"({"rows": "wheel", "properties": {"radius_mm?": "number"}})", tables), std::logic_error);
}

}  // namespace
}  // namespace treadmark::io
