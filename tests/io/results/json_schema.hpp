// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "treadmark/model/rows.hpp"

namespace treadmark::testing {

/// First violation of a JSON schema (the words $ref, type, enum, properties, required, additionalProperties, items,
/// minItems, maxItems), or empty. Any other word that restricts makes the check throw, so that nothing is passed over.
std::string first_violation(const nlohmann::json& value, const nlohmann::json& schema, const nlohmann::json& root,
                            const std::string& place = "");

/// Whether the schema of an object says that this member must be there.
bool is_required(const nlohmann::json& object, const std::string& key);

/// Each row with a key is a member of this object, "a.b" of its member a: with its meaning, of the type of its number,
/// and may be missing where it may be not known. lists: the members are lists of these.
template <class Row>
void expect_rows(const nlohmann::json& object, bool lists = false) {
  for (const Column<Row>& column : columns<Row>()) {
    if (column.key.empty()) continue;
    const Access<Row>& access = column.access;
    SCOPED_TRACE(std::string(column.key));
    const std::size_t dot = column.key.find('.');
    const std::string name(column.key.substr(dot + 1));  // npos + 1 is 0
    const nlohmann::json& within =
        dot == column.key.npos ? object : object["properties"][std::string(column.key.substr(0, dot))];
    ASSERT_TRUE(within["properties"].contains(name));
    const nlohmann::json &found = within["properties"][name], &type = (lists ? found["items"] : found)["type"];
    const bool or_null = type.is_array();
    const char* const expected = access.word != nullptr ? "string"
                                 : access.flag          ? "boolean"
                                 : access.whole         ? "integer"
                                                        : "number";
    EXPECT_EQ(or_null ? type[0] : type, expected);
    EXPECT_EQ(or_null && type[1] != "null", false);
    EXPECT_EQ(found.value("description", ""), column.meaning);
    EXPECT_EQ(is_required(within, name), access.has == nullptr);
    EXPECT_EQ(within["additionalProperties"], false);
  }
}

}  // namespace treadmark::testing
