// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/case_keys.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "treadmark/tests/support/file_content.hpp"

namespace treadmark::io {
namespace {

using Json = nlohmann::json;

const Json* property(const Json& schema, const std::string& path) {
  const Json* at = &schema;
  std::stringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');) {
    const auto properties = at->find("properties");
    if (properties == at->end() || !properties->contains(part)) return nullptr;
    at = &(*properties)[part];
  }
  return at;
}

TEST(CaseSchema, HoldsEveryKeyTwice) {
  const Json schema = Json::parse(case_file_schema());
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema.at("additionalProperties"), false);
  const Json& cases = schema.at("properties").at("cases").at("items");
  for (const CaseKey& key : case_keys()) {
    SCOPED_TRACE(key.info.path);
    const Json* common = property(schema, key.info.path);
    ASSERT_NE(common, nullptr);
    EXPECT_EQ(common->at("description"), key.info.doc);
    // words may stand in place of some numbers
    const bool or_words = key.info.type == KeyType::number && !key.info.choices.empty();
    const Json& value = or_words ? common->at("anyOf").at(0) : *common;
    if (or_words) {
      EXPECT_EQ(common->at("anyOf").at(1).at("enum").size(), key.info.choices.size());
    }
    if (key.info.type == KeyType::number) {
      EXPECT_EQ(value.at("type"), "number");
    }
    if (key.info.at_least) {
      EXPECT_DOUBLE_EQ(value.at("minimum").get<double>(), *key.info.at_least);
    }
    if (key.info.type == KeyType::choice) {
      EXPECT_EQ(common->at("enum").size(), key.info.choices.size());
    }
    const Json* one = property(cases, key.info.path);
    ASSERT_NE(one, nullptr);
    EXPECT_EQ(one->contains("anyOf"), key.info.type != KeyType::number_list && key.info.type != KeyType::table_list);
  }
  EXPECT_EQ(cases.at("properties").count("cases"), 0u);
}

TEST(CaseSchema, ExcludesContradictions) {
  const Json schema = Json::parse(case_file_schema());
  const Json excluded = property(schema, "wheelset")->at("allOf");
  const Json expected = {{"not", {{"required", {"vertical_force_N", "z_mm"}}}}};
  EXPECT_NE(std::find(excluded.begin(), excluded.end(), expected), excluded.end());
}

TEST(CaseKeys, AreUniqueAndDocumented) {
  std::set<std::string> seen;
  for (const CaseKey& key : case_keys()) {
    EXPECT_TRUE(seen.insert(key.info.path).second) << key.info.path;
    EXPECT_FALSE(key.info.doc.empty()) << key.info.path;
    EXPECT_TRUE(key.set) << key.info.path;
    EXPECT_EQ(key.info.pattern.empty(), key.info.matches == nullptr) << key.info.path;
    EXPECT_EQ(key.info.type == KeyType::table_list, static_cast<bool>(key.set_element)) << key.info.path;
  }
  EXPECT_GT(seen.size(), 100u);
}

/// Defaults that the documentation shows are accepted and change nothing that they name.
TEST(CaseKeys, DefaultsPassTheirOwnChecks) {
  for (const CaseKey& key : case_keys()) {
    if (key.info.default_text.empty()) continue;
    SCOPED_TRACE(key.info.path);
    CaseTable table = parse_toml("value = " + key.info.default_text, "default");
    // A few defaults say "not given" by a value that must not be written.
    const bool absent = key.info.above && key.info.type == KeyType::number && key.info.choices.empty() &&
                        table[0].value.number() <= *key.info.above;
    if (!absent) {
      EXPECT_NO_THROW(check_value(key.info, table[0].value));
    }
  }
}

TEST(CaseDocumentation, TableOfKeysIsUpToDate) {
  treadmark::testing::expect_in_document("case-file.md", case_key_table());
}

}  // namespace
}  // namespace treadmark::io
