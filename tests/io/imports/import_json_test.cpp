// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "treadmark/tests/io/imports/sample_report.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"

namespace treadmark {
namespace {

using nlohmann::json;

// A change of unit may leave one unit in the twelfth digit.
constexpr double kDigits = 1e-11;

json schema() { return json::parse(io::import_report_schema()); }

void expect_number(const json& object, const char* key, double value) {
  ASSERT_TRUE(object.contains(key)) << key;
  ASSERT_TRUE(object[key].is_number()) << key;
  EXPECT_NEAR(object[key].get<double>(), value, kDigits * std::abs(value)) << key;
}

void expect_schema(const io::ImportReport& report) {
  for (const bool with_seconds : {false, true}) {
    const json rules = schema();
    EXPECT_EQ(testing::first_violation(json::parse(io::import_json(report, with_seconds)), rules, rules), "");
  }
}

TEST(ImportJson, HasTheDocumentedCore) {
  const json out = json::parse(io::import_json(testing::sample_report(), true));
  EXPECT_EQ(out["treadmark"]["version"], "1.2.3");
  EXPECT_EQ(out["input"], "wheel left.ply");
  EXPECT_EQ(out["sha256"], std::string(64, 'a'));
  EXPECT_EQ(out["unit"], "mm");
  EXPECT_EQ(out["unit_from"], "the size of the wheel");
  EXPECT_EQ(out["points_read"], 1600000);
  EXPECT_EQ(out["points_used"], 1571000);
  EXPECT_EQ(out["removed"]["stray points"], 9100);
  EXPECT_EQ(out["removed"]["thinned"], 0);
  std::size_t removed = 0;
  for (const auto& [reason, count] : out["removed"].items()) removed += count.get<std::size_t>();
  EXPECT_EQ(removed, 1600000u - 1571000u);
  EXPECT_EQ(out["removed_why"]["stray clusters"], "fewer than 200 points, farther than 3 mm from all others");
  expect_number(out, "noise_mm", 0.035);
  expect_number(out, "residual_rms_mm", 0.036);
  expect_number(out, "residual_max_mm", 0.19);
  expect_number(out["seconds"], "read", 1.75);
  expect_number(out["seconds"], "place", 2.25);
  EXPECT_EQ(out["body"], "wheel");
  EXPECT_EQ(out["warnings"].size(), 2u);
  EXPECT_EQ(out["inputs"][1]["file"], "wheel <b>& \"second\".xyz");
  EXPECT_EQ(out["inputs"][0]["not_finite"], 3);
}

TEST(ImportJson, TheFrameTakesTheSurfaceToTheCloud) {
  const io::ImportReport report = testing::sample_report();
  const json frame = json::parse(io::import_json(report, false))["frame"];
  const Vec3 point(0.3, -0.2, 0.7);
  const Vec3 wanted = 1e3 * report.X_CS.apply(point);
  for (int i = 0; i < 3; ++i) {
    const json& row = frame["matrix"][static_cast<std::size_t>(i)];
    const double value = row[0].get<double>() * 300.0 + row[1].get<double>() * -200.0 + row[2].get<double>() * 700.0 +
                         row[3].get<double>();
    EXPECT_NEAR(value, wanted[i], 1e-9);
    const auto k = static_cast<std::size_t>(i);
    EXPECT_EQ(frame["x_axis"][k], row[0]);
    EXPECT_EQ(frame["y_axis"][k], row[1]);
    EXPECT_EQ(frame["z_axis"][k], row[2]);
    EXPECT_EQ(frame["origin_mm"][k], row[3]);
  }
  expect_number(frame, "nominal_radius_mm", 460.0);
  expect_number(frame, "axis_position_error_mm", 0.0012);
  expect_number(frame, "axis_direction_error_mrad", 0.0045);
  expect_number(frame, "undamaged_percent", 93.0);
  expect_number(frame, "pass_distance_after_mm", 0.022);
  EXPECT_EQ(frame["passes"][0]["shift_mm"], json({0.01, 0.0, -0.02}));
  EXPECT_EQ(frame["passes"][0]["turn_mrad"], json({0.0, 0.1, 0.0}));
}

TEST(ImportJson, TheRestHasTheUnitsOfItsNames) {
  const json out = json::parse(io::import_json(testing::sample_report(), false));
  EXPECT_FALSE(out.contains("seconds"));
  const json& hole = out["coverage"]["holes"][0];
  expect_number(hole, "u_deg", 1.9 / 0.46 * 180.0 / std::numbers::pi);
  expect_number(hole, "diameter_mm", 18.0);
  expect_number(hole, "area_mm2", 250.0);
  expect_number(hole, "s_mm", 50.0);
  EXPECT_EQ(hole["filled"], false);
  EXPECT_TRUE(out["coverage"]["holes"][1]["s_mm"].is_null());
  expect_number(out["coverage"], "area_mm2", 404600.0);
  expect_number(out["damage"][0], "depth_mm", 0.85);
  expect_number(out["damage"][0], "volume_mm3", 1170.0);
  expect_number(out["fit"]["levels"][1], "knot_a_mm", 2.0);
  expect_number(out["outputs"][0], "height_max_um", 3.1);
  EXPECT_EQ(out["outputs"][0]["bytes"], 1234567);
  EXPECT_EQ(out["range"]["u_deg"], json({0.0, 360.0}));
  EXPECT_EQ(out["range"]["closed"], true);
  EXPECT_EQ(out["settings_toml"], "[scan]\nunit = \"mm\"\n");
}

TEST(ImportReportSchema, IsMadeOfItsRows) {
  using Report = io::ImportReport;
  using testing::expect_rows;
  const json rules = schema(), all = rules["properties"];
  const auto members = [&](const char* object) -> const json& { return all[object]["properties"]; };
  const json &holes = members("coverage")["holes"]["items"], &damage = all["damage"]["items"], &fit = members("fit");
  expect_rows<Report::Input>(all["inputs"]["items"]);
  expect_rows<Report::Pass>(members("frame")["passes"]["items"]);
  expect_rows<Report::Hole>(holes);
  expect_rows<Report::Line>(all["line"]);
  expect_rows<Report::LinePlace>(all["line"]["properties"]["places"]["items"]);
  expect_rows<Report::Damage>(damage);
  expect_rows<Report::Sections>(fit["kept_sections"]);
  expect_rows<Report::Level>(fit["levels"]["items"]);
  expect_rows<ErrorSize>(fit["surface_errors"]);
  expect_rows<Report::ErrorPart>(fit["error_sources"]["items"]);
  for (const char* compared : {"placed", "shape"}) expect_rows<Report::Distances>(members("truth")[compared]);
  expect_rows<Report::Output>(all["outputs"]["items"]);
  for (const json* part : {&holes, &damage})
    for (const char* place : {"u_deg", "u_mm", "y_mm", "s_mm"}) EXPECT_TRUE((*part)["properties"].contains(place));
  // numbers that are there whenever their object is
  for (const char* object : {"kept_sections", "surface_errors", "residuals"})
    for (const auto& [name, member] : fit[object]["properties"].items())
      EXPECT_TRUE(member["type"].is_string()) << name;
  EXPECT_EQ(fit["residuals"]["properties"].size(), columns<Report::Distances>().size() + 2) << "below and above";
}

TEST(ImportJson, KeepsToItsSchema) {
  expect_schema(testing::sample_report());
  expect_schema(testing::sample_map_report());
  expect_schema({});
}

TEST(ImportJson, TheLineOfARail) {
  io::ImportReport report;
  EXPECT_TRUE(json::parse(io::import_json(report, false))["line"].is_null());
  io::ImportReport::Line& line = report.line.emplace();
  line.bent = true;
  line.deviation = 12.5e-3;
  line.places.push_back({2.0, Vec3(1.0, -2.0, 3.0), 1e-3, 2e-6, -1e-4, 3e-6, 2e-3, 1e-5, 0.1, 0.02});
  line.places.push_back({4.0, Vec3::Zero(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, std::nan("")});
  expect_schema(report);
  const json out = json::parse(io::import_json(report, false))["line"];
  EXPECT_EQ(out["bent"], true);
  expect_number(out, "deviation_mm", 12.5);
  EXPECT_TRUE(out["given_rms_mm"].is_null());
  expect_number(out["places"][0], "x_mm", 2000.0);
  expect_number(out["places"][0], "place_y_mm", -2000.0);
  expect_number(out["places"][0], "curvature_per_m", 1e-3);
  expect_number(out["places"][0], "twist_mrad_per_m", 2.0);
  expect_number(out["places"][0], "gradient_mrad", 20.0);
  EXPECT_TRUE(out["places"][1]["gradient_mrad"].is_null());
}

TEST(ImportJson, AMapHasNoPlacement) {
  const json out = json::parse(io::import_json(testing::sample_map_report(), false));
  EXPECT_TRUE(out["frame"].is_null());
  EXPECT_EQ(out["from_map"], true);
  EXPECT_TRUE(out["range"].contains("u_mm"));
}

TEST(ImportJson, NumbersThatDoNotExistAreNull) {
  io::ImportReport report = testing::sample_report();
  report.noise = report.X_CS.origin.x() = std::numeric_limits<double>::quiet_NaN();
  report.residual_max = report.steps[0].seconds = std::numeric_limits<double>::infinity();
  report.nominal_radius = 1e306;  // m; in mm beyond the largest double
  const std::string text = io::import_json(report, true);
  const json out = json::parse(text);
  EXPECT_TRUE(out["noise_mm"].is_null());
  EXPECT_TRUE(out["residual_max_mm"].is_null());
  EXPECT_TRUE(out["frame"]["origin_mm"][0].is_null());
  EXPECT_TRUE(out["frame"]["nominal_radius_mm"].is_null());
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find(": inf"), std::string::npos);
  expect_schema(report);
}

TEST(ImportJson, CountsOfTheSameReasonAreAdded) {
  io::ImportReport report;
  report.removed = {{"stray", 3, "first"}, {"stray", 4, "second"}};
  const json out = json::parse(io::import_json(report, false));
  EXPECT_EQ(out["removed"]["stray"], 7);
  EXPECT_EQ(out["removed_why"]["stray"], "first; second");
}

TEST(ImportJson, NamesThatAreNotUtf8AreMended) {
  io::ImportReport report;
  report.inputs = {{"caf\xe9.ply", "", "", 1, 0}};
  EXPECT_EQ(json::parse(io::import_json(report, false))["input"], "caf\xef\xbf\xbd.ply");
}

TEST(ImportJson, TimesAreAListInOrder) {
  const json out = json::parse(io::import_times_json(testing::sample_report()));
  ASSERT_EQ(out["steps"].size(), 3u);
  EXPECT_EQ(out["steps"][1]["step"], "place");
  EXPECT_EQ(out["steps"][2]["seconds"], 0.25);
}

}  // namespace
}  // namespace treadmark
