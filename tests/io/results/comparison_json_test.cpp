// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "treadmark/core/error.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/tests/io/results/comparison_sample.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/shared_data.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using nlohmann::json;

// A change of unit may leave one unit in the twelfth digit.
constexpr double kComparisonDigits = 1e-11;

void expect_number(const json& object, const char* key, double value) {
  ASSERT_TRUE(object.contains(key)) << key;
  ASSERT_TRUE(object[key].is_number()) << key;
  EXPECT_NEAR(object[key].get<double>(), value, kComparisonDigits * std::abs(value)) << key;
}

json parse_comparison() { return json::parse(io::to_json(testing::sample_comparison())); }

TEST(ComparisonJson, BodiesHaveTheUnitsOfTheirNames) {
  const json candidate = parse_comparison()["candidates"][1];
  EXPECT_EQ(candidate["backend"], "mesh");
  EXPECT_EQ(candidate["resolution_mm"], 1.0);
  EXPECT_FALSE(candidate.contains("failure"));
  const json& rail = candidate["rail"];
  EXPECT_EQ(rail["backend"], "mesh");
  expect_number(rail, "resolution_mm", 1.0);
  expect_number(rail, "build_s", 0.5);
  EXPECT_EQ(rail["memory_bytes"], 1000000);
  expect_number(rail, "height_max_um", 4.0);
  expect_number(rail, "height_rms_um", 0.8);
  expect_number(rail, "slope_max_mrad", 1.0);
  expect_number(rail, "slope_rms_mrad", 0.25);
  expect_number(rail, "curvature_max_per_m", 2.0);
  expect_number(rail, "curvature_rms_per_m", 0.5);
  EXPECT_EQ(rail["points"], 5000);
  EXPECT_EQ(rail["missing"], 7);
  EXPECT_EQ(rail["note"], "");
  EXPECT_EQ(parse_comparison()["candidates"][2]["wheel"]["note"], "3 triangles mended");
}

TEST(ComparisonJson, ARowSumsUpBothBodiesAndItsErrors) {
  const json document = parse_comparison();
  ASSERT_EQ(document["rows"].size(), 16u);  // four candidates of four cases; the one that failed has none
  const json& row = document["rows"][5];    // the coarse mesh, case 2
  EXPECT_EQ(row["backend"], "mesh");
  EXPECT_EQ(row["wheel_backend"], "mesh");
  EXPECT_EQ(row["rail_backend"], "mesh");
  EXPECT_EQ(row["case"], 2);
  EXPECT_EQ(row["status"], "ok");
  EXPECT_EQ(row["ncon"], 340);
  EXPECT_EQ(row["patches"], 1);
  EXPECT_EQ(row["memory_bytes"], 4000000);
  expect_number(row, "resolution_mm", 1.0);
  expect_number(row, "height_max_um", 4.0);   // of the rail
  expect_number(row, "height_rms_um", 1.0);   // of the wheel
  expect_number(row, "slope_max_mrad", 1.5);  // of the wheel
  expect_number(row, "curvature_max_per_m", 3.0);
  expect_number(row, "pmax_MPa", 960.0);
  expect_number(row, "fn_N", 125000.0);
  expect_number(row, "fx_N", 7499.0);
  expect_number(row, "fs_N", -1390.0);
  expect_number(row, "x_tr_mm", 0.1);
  expect_number(row, "y_tr_mm", 759.3304);
  expect_number(row, "approach_mm", 0.108244);
  expect_number(row, "area_mm2", 85.0);
  expect_number(row, "search_s", 0.008);
  expect_number(row, "distance_s", 0.001);
  expect_number(row, "build_s", 1.25);
  expect_number(row, "pmax_error_percent", -20.0);
  expect_number(row, "area_error_percent", 10.0);
  expect_number(row, "approach_error_percent", -5.0);
  expect_number(row, "force_error_percent", 2.0);
  expect_number(row, "position_error_mm", 0.4);
}

TEST(ComparisonJson, WhatDoesNotExistIsNullOrAbsent) {
  const json document = parse_comparison();
  EXPECT_TRUE(document["candidates"][0]["resolution_mm"].is_null());
  EXPECT_TRUE(document["candidates"][0]["wheel"]["height_max_um"].is_null());  // not measured
  EXPECT_TRUE(document["rows"][0]["height_max_um"].is_null());
  expect_number(document["rows"][8], "height_max_um", 0.625);  // measured on the wheel only
  const json& without = document["rows"][3];
  EXPECT_EQ(without["status"], "no_contact");
  EXPECT_TRUE(without["pmax_MPa"].is_null());
  EXPECT_TRUE(without["approach_mm"].is_null());
  EXPECT_FALSE(without.contains("pmax_error_percent"));
  EXPECT_FALSE(without.contains("position_error_mm"));
  EXPECT_EQ(document["rows"][0]["pmax_error_percent"], 0.0);
}

TEST(ComparisonJson, NumbersThatAreNotFiniteBecomeNull) {
  io::Comparison comparison = testing::sample_comparison();
  io::ComparisonRow& row = comparison.candidates[1].rows[0];
  row.pmax = std::numeric_limits<double>::quiet_NaN();
  row.pmax_error = std::numeric_limits<double>::infinity();
  comparison.seconds = -std::numeric_limits<double>::infinity();
  const json document = json::parse(io::to_json(comparison));
  EXPECT_TRUE(document["rows"][4]["pmax_MPa"].is_null());
  EXPECT_TRUE(document["rows"][4]["pmax_error_percent"].is_null());
  EXPECT_TRUE(document["treadmark"]["seconds"].is_null());
}

TEST(ComparisonJson, NamesTheTruthAndWhyACandidateFailed) {
  const json document = parse_comparison();
  EXPECT_EQ(document["truth"], "analytic <profiles> & flats");
  EXPECT_EQ(document["candidates"][4]["failure"], "no \"grid\" <in> this\nbuild, \\ & so on");
  for (const json& row : document["rows"]) EXPECT_NE(row["backend"], "vdb");
}

TEST(ComparisonJson, TellsItsOriginInTheTextOfARun) {
  // The JSON library writes the file of a run: same words, numbers, escapes and indentation.
  io::RunResult run;
  io::Comparison comparison = testing::sample_comparison();
  run.version = comparison.version = "0.2 \t\n\x01\x7f/ Grüße \xE2\x82\xAC";
  run.git = comparison.git;
  run.threads = comparison.threads;
  run.geometry_sha256 = comparison.geometry_sha256;
  run.inputs = comparison.inputs;
  run.title = comparison.title;
  run.input_file = comparison.input_file;
  run.input_sha256 = comparison.input_sha256;
  for (const double seconds : {160.0, 0.3729, 1e-5, 1.5e300, 1.0 / 3.0, 123456789012.0, 0.0}) {
    run.seconds = comparison.seconds = seconds;
    const std::string text = io::to_json(comparison), origin = text.substr(0, text.find("\n \"settings\""));
    EXPECT_TRUE(io::to_json(run).starts_with(origin)) << origin;
    EXPECT_NE(origin.find("b.slcw"), std::string::npos);
  }
}

TEST(ComparisonJson, NamesThatAreNotUtf8DoNotSpoilTheFile) {
  for (const char* name : {"caf\xe9", "\xf8\x88\x80\x80\x80", "\xed\xa0\x80", "\xc0\x80", "cut \xe2\x82", "\xff"}) {
    io::Comparison comparison = testing::sample_comparison();
    comparison.candidates[1].name = name;
    EXPECT_TRUE(json::accept(io::to_json(comparison))) << name;
  }
}

TEST(ComparisonSchema, IsMadeOfItsRows) {
  const json schema = json::parse(io::comparison_schema());
  const json &candidate = schema["properties"]["candidates"]["items"], &body = schema["$defs"]["body"],
             &row = schema["properties"]["rows"]["items"];
  testing::expect_rows<io::ComparisonCandidate>(candidate);
  testing::expect_rows<io::RepresentedBody>(body);
  testing::expect_rows<io::ComparedRow>(row);
  EXPECT_EQ(candidate["properties"].size(), columns<io::ComparisonCandidate>().size() + 2) << "wheel and rail";
  EXPECT_EQ(body["properties"].size(), columns<io::RepresentedBody>().size());
  EXPECT_EQ(row["properties"].size(), columns<io::ComparedRow>().size());
  EXPECT_EQ(row["properties"]["status"]["enum"].size(), 4u);
}

TEST(ComparisonJson, FitsTheSchemaAndTheSchemaBites) {
  const json schema = json::parse(io::comparison_schema());
  const json document = parse_comparison();
  EXPECT_EQ(testing::first_violation(document, schema, schema), "");
  EXPECT_EQ(testing::first_violation(json::parse(io::to_json(io::Comparison())), schema, schema), "");

  json wrong = document;
  wrong["rows"][0]["pmax_MPa"] = "many";
  EXPECT_EQ(testing::first_violation(wrong, schema, schema), "/rows/0/pmax_MPa: wrong type");
  wrong = document;
  wrong["candidates"][1]["rail"].erase("points");
  EXPECT_EQ(testing::first_violation(wrong, schema, schema), "/candidates/1/rail/points: missing");
  wrong = document;
  wrong["rows"][0]["height_max_inch"] = 1.0;
  EXPECT_EQ(testing::first_violation(wrong, schema, schema), "/rows/0/height_max_inch: not in the schema");
}

TEST(ComparisonJson, AnEmptyComparisonHasEmptyLists) {
  const json document = json::parse(io::to_json(io::Comparison()));
  EXPECT_EQ(document["candidates"], json::array());
  EXPECT_EQ(document["rows"], json::array());
  EXPECT_EQ(document["complete"], true);
}

TEST(ComparisonJson, TheFileReplacesAnOlderOne) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "deep" / "compare.json";
  io::write_json(path, io::Comparison());
  io::write_json(path, testing::sample_comparison());
  EXPECT_EQ(testing::read_text(path), io::to_json(testing::sample_comparison()));
  EXPECT_EQ(folder.count_files(), 2u);  // the folder and the file
  EXPECT_THROW(io::write_json(folder.path(), io::Comparison()), Error);
}

}  // namespace
}  // namespace treadmark
