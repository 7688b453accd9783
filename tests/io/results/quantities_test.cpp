// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"

namespace treadmark::io {
namespace {

using nlohmann::json;

std::string documentation(const char* file) {
  return treadmark::testing::read_text(std::string(TREADMARK_SOURCE_DIR) + "/docs/" + file);
}

/// Known in every patch or case.
template <class T>
bool always(const Quantity<T>& row) {
  return flag_of<T>(row.block) == nullptr && row.access.has == nullptr;
}

template <class T>
void expect_in_schema(const json& of_all) {
  std::set<std::string> objects;
  for (const Quantity<T>& row : quantities<T>()) {
    if (row.key.empty()) continue;
    const std::string object(row.object), key(row.key);
    SCOPED_TRACE(object + "." + key);
    const json& within = object.empty() ? of_all : of_all["properties"][object];
    json expected{{"type", "integer"}};
    if (!row.access.whole) expected["type"] = {"number", "null"};
    if (!row.meaning.empty()) expected["description"] = row.meaning;
    ASSERT_TRUE(within["properties"].contains(key));
    EXPECT_EQ(within["properties"][key], expected);
    const std::set<std::string> required = within["required"];
    const bool optional_object = !object.empty() && row.block != Block::rolling;
    EXPECT_EQ(required.contains(key), always(row) || optional_object);
    if (!object.empty()) objects.insert(object);
  }
  const auto is_row = [](const std::string& object, const std::string& key) {
    return ranges::any_of(quantities<T>(), [&](const auto& row) { return row.object == object && row.key == key; });
  };
  for (const std::string& object : objects)
    for (const auto& [key, value] : of_all["properties"][object]["properties"].items())
      EXPECT_TRUE(is_row(object, key)) << object << "." << key;
}

TEST(ResultSchema, IsMadeOfItsRows) {
  const json schema = json::parse(result_schema());
  expect_in_schema<PatchResult>(schema["$defs"]["patch"]);
  expect_in_schema<CaseResult>(schema["$defs"]["case"]);
}

TEST(Quantities, TablesOfTheDocumentationAreUpToDate) {
  const std::string text = documentation("results.md");
  for (const std::string& table : {case_quantity_table(), patch_quantity_table(), field_quantity_table()})
    EXPECT_NE(text.find(table), std::string::npos) << "docs/results.md must contain:\n" << table;
}

/// A patch that has everything, each number with a value of its own.
PatchResult whole_patch() {
  PatchResult patch;
  patch.has_reference = patch.has_rolling = true;
  double value = 100.0;
  for (const auto& row : quantities<PatchResult>())
    if (row.access.put != nullptr) row.access.put(patch, value += 1.0);
  return patch;
}

TEST(Quantities, ReachEveryFileOnce) {
  CaseResult result;
  result.patches = {whole_patch()};
  std::set<std::string> stored, keys;
  for (const Attribute& attribute : attributes_of(result.patches[0]))
    EXPECT_TRUE(stored.insert(attribute.name).second) << attribute.name;
  RunResult run;
  run.cases = {result};
  const json written = json::parse(to_json(run))["cases"][0]["patches"][0];
  const std::string text = summary(result);
  for (const auto& row : quantities<PatchResult>()) {
    SCOPED_TRACE(std::string(row.key) + " " + std::string(row.stored.name));
    EXPECT_TRUE(row.stored.name.empty() || stored.contains(std::string(row.stored.name)));
    EXPECT_TRUE(row.stored.name.empty() || row.access.put != nullptr);
    EXPECT_NE(text.find(row.label.text), std::string::npos);
    if (row.key.empty() || row.block == Block::work) continue;
    EXPECT_TRUE(keys.insert(std::string(row.object) + '.' + std::string(row.key)).second);
    const json& within = row.object.empty() ? written : written[std::string(row.object)];
    const double expected = row.unit.in_file(row.access.get(result.patches[0]));
    EXPECT_NEAR(within[std::string(row.key)].get<double>(), expected, 1e-11 * std::abs(expected));
  }
}

TEST(Quantities, ShareInSlipIsOfTheElementsInContact) {
  RunResult run;
  run.cases.resize(1);
  run.cases[0].patches.resize(2);
  run.cases[0].patches[0].ncon = 12;
  run.cases[0].patches[0].nslip = 3;
  const json patches = json::parse(to_json(run))["cases"][0]["patches"];
  EXPECT_EQ(patches[0]["slip_share"], 0.25);
  EXPECT_FALSE(patches[1].contains("slip_share"));
}

}  // namespace
}  // namespace treadmark::io
