// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Which number stands under which key: every one of measure.json is written down here a second time, and a key without
// its line fails.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"

namespace treadmark::app {
namespace {

using measures::Measure;
using nlohmann::json;

constexpr double kMm = 1e-3, kMm2 = 1e-6, kDegree = std::numbers::pi / 180.0;

/// A number, its key and the unit of the key.
struct Line {
  const char* key;
  double unit;
  Measure* number;
};

/// Each is so many of its unit as it stands down the list, with a tenth of that as uncertainty.
void count_up(const std::vector<Line>& lines) {
  double n = 0.0;
  for (const Line& line : lines) n += 1.0, *line.number = {n * line.unit, 0.1 * n * line.unit, {}};
}

void expect_counted(const std::vector<Line>& lines, const json& found) {
  double n = 0.0;
  for (const Line& line : lines) {
    n += 1.0;
    ASSERT_TRUE(found.contains(line.key)) << line.key;
    EXPECT_NEAR(found[line.key].get<double>(), n, 1e-9) << line.key;
    EXPECT_NEAR(found["uncertainty"][line.key].get<double>(), 0.1 * n, 1e-9) << line.key;
  }
  EXPECT_EQ(found["uncertainty"].size(), lines.size());
  EXPECT_TRUE(found["reasons"].empty());
}

std::vector<Line> lines_of(WheelNumbers& w) {
  return {{"flange_height_mm", kMm, &w.flange_height},
          {"flange_thickness_mm", kMm, &w.flange_thickness},
          {"flange_gradient_mm", kMm, &w.flange_gradient},
          {"flange_angle_deg", kDegree, &w.flange_angle},
          {"diameter_mm", kMm, &w.diameter},
          {"hollow_mm", kMm, &w.hollow},
          {"rollover_mm", kMm, &w.rollover},
          {"rim_width_mm", kMm, &w.rim_width},
          {"tread_wear_mm", kMm, &w.tread_wear},
          {"flange_wear_mm", kMm, &w.flange_wear},
          {"area_lost_mm2", kMm2, &w.area_lost},
          {"area_gained_mm2", kMm2, &w.area_gained},
          {"diameter_lost_mm", kMm, &w.diameter_lost},
          {"runout_mm", kMm, &w.runout},
          {"axial_runout_mm", kMm, &w.axial_runout},
          {"eccentricity_mm", kMm, &w.eccentricity},
          {"flat_depth_mm", kMm, &w.flat_depth},
          {"flat_length_mm", kMm, &w.flat_length},
          {"back_to_back_mm", kMm, &w.back_to_back},
          {"active_faces_mm", kMm, &w.active_faces}};
}

std::vector<Line> lines_of(RailNumbers& r) {
  return {{"w1_mm", kMm, &r.w1},
          {"w2_mm", kMm, &r.w2},
          {"w3_mm", kMm, &r.w3},
          {"equivalent_wear_mm", kMm, &r.equivalent},
          {"loss_mm2", kMm2, &r.loss},
          {"loss_top_mm2", kMm2, &r.loss_top},
          {"loss_side_mm2", kMm2, &r.loss_side},
          {"loss_percent", 0.01, &r.loss_part},
          {"lip_mm2", kMm2, &r.lip},
          {"face_angle_deg", kDegree, &r.face_angle},
          {"head_width_mm", kMm, &r.head_width},
          {"crown_radius_mm", kMm, &r.crown_radius},
          {"inclination_deg", kDegree, &r.inclination},
          {"roughness_exceedance_db", 1.0, &r.roughness_exceedance}};
}

/// Each number stands in five places.
template <class Numbers>
void expect_in_schema(const json& body, const char* sections) {
  using treadmark::testing::is_required;
  const json &members = body["properties"], number = json({"number", "null"});
  Numbers numbers;
  const std::vector<Line> lines = lines_of(numbers);
  for (const Line& line : lines) {
    const auto type = [&](const json& object) -> const json& { return object["properties"][line.key]["type"]; };
    EXPECT_EQ(type(body), number) << line.key;
    EXPECT_TRUE(is_required(body, line.key)) << line.key;
    EXPECT_EQ(type(members["uncertainty"]), number) << line.key;
    EXPECT_EQ(type(members["reasons"]), "string") << line.key;
    EXPECT_EQ(members[sections]["properties"][line.key]["items"]["type"], number) << line.key;
    for (const char* object : {"uncertainty", "reasons", sections})
      EXPECT_FALSE(is_required(members[object], line.key)) << object << ' ' << line.key;
  }
  EXPECT_EQ(members["uncertainty"]["properties"].size(), lines.size());
  EXPECT_EQ(members["reasons"]["properties"].size(), lines.size());
  EXPECT_EQ(members[sections]["properties"].size(), lines.size() + 1) << "and the place";
}

TEST(MeasureSchema, IsMadeOfItsRows) {
  const json schema = json::parse(measure_schema());
  expect_in_schema<WheelNumbers>(schema["$defs"]["wheel"], "round");
  expect_in_schema<RailNumbers>(schema["$defs"]["rail"], "along");
}

TEST(MeasureNumbers, NoLimitIsSureWhereTheUncertaintyIsNotKnown) {
  RailNumbers numbers;
  Limits limits;
  limits.rail = {{"w1_mm", {}, 2.0}};
  const struct {
    double uncertainty;
    bool sure;
    const char* words;
  } rows[] = {{0.1e-3, true, ""},
              {1.5e-3, false, ", nearer than its uncertainty"},
              {measures::kUnknown, false, ", its uncertainty is not known"}};
  for (const auto& row : rows) {
    numbers.w1 = {1e-3, row.uncertainty, {}};
    const std::vector<LimitResult> found = compare_limits(numbers, limits);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].verdict, Verdict::within);
    EXPECT_EQ(found[0].sure, row.sure);
    EXPECT_EQ(how_sure(found[0]), row.words);
  }
}

TEST(MeasureNumbers, OfAWheel) {
  WheelNumbers numbers;
  const std::vector<Line> lines = lines_of(numbers);
  ASSERT_EQ(number_rows(numbers).size(), lines.size());
  count_up(lines);
  MeasuredFile file;
  file.numbers = numbers;
  file.noise = 12e-6;
  measures::RoundMeasures round;
  round.scatter = 31e-6, round.gaps = 0.25;
  round.flats = {{0.5, {41e-3, 1e-3, {}}, {0.42e-3, 2e-5, {}}, 43e-3, 44e-3}};
  round.orders = {{2, 51e-6, 0.52, 53e-6, 54.0, 0.55}, {3, 61e-6, 0.62, 63e-6, 64.0, 0.65}};
  round.bands = {{0.16, 71.0}};
  file.revolution = round;
  file.further_runouts = {{20e-3, {81e-6, 1e-6, {}}}};
  for (const double u : {0.1, 0.2}) {
    WheelNumbers at = numbers;
    at.flange_height.value = 29e-3 + 0.01 * u;
    file.round.push_back({u, at});
  }
  const json all = json::parse(file_document(file)), w = all["wheel"];
  expect_counted(lines, w);
  EXPECT_NEAR(all["noise_mm"], 0.012, 1e-12);
  EXPECT_NEAR(w["scatter_mm"], 0.031, 1e-12);
  EXPECT_NEAR(w["missing_part"], 0.25, 1e-12);
  EXPECT_EQ(w["flats"].size(), 1u);
  EXPECT_EQ(w["flats"][0], json({{"theta_rad", 0.5},
                                 {"length_mm", 41.0},
                                 {"length_uncertainty_mm", 1.0},
                                 {"depth_mm", 0.42},
                                 {"depth_uncertainty_mm", 0.02},
                                 {"chord_length_mm", 43.0},
                                 {"rounded_length_mm", 44.0}}));
  EXPECT_EQ(w["orders"][1], json({{"order", 3},
                                  {"amplitude_mm", 0.061},
                                  {"uncertainty_mm", 0.063},
                                  {"phase_rad", 0.62},
                                  {"wavelength_mm", 650.0},
                                  {"level_db", 64.0}}));
  EXPECT_EQ(w["level_db"], json({54.0, 64.0}));
  EXPECT_EQ(w["bands"][0], json({{"wavelength_mm", 160.0}, {"level_db", 71.0}}));
  EXPECT_EQ(w["runouts"][0], json({{"y_mm", 20.0}, {"runout_mm", 0.081}}));
  EXPECT_EQ(w["round"]["theta_rad"], json({0.1, 0.2}));
  EXPECT_EQ(w["round"]["flange_height_mm"], json({30.0, 31.0}));
  EXPECT_EQ(w["round"]["active_faces_mm"], json({20.0, 20.0}));
}

TEST(MeasureNumbers, OfARail) {
  RailNumbers numbers;
  const std::vector<Line> lines = lines_of(numbers);
  ASSERT_EQ(number_rows(numbers).size(), lines.size());
  count_up(lines);
  numbers.residual = 15e-6;
  MeasuredFile file;
  file.numbers = numbers;
  measures::RoughnessMeasures rough;
  rough.bands = {{0.1, 11.0, 12.0, 5.0, 14.0}, {0.08, 21.0, 22.0, 3.0, 24.0}};
  rough.waves = {{10e-3, 30e-3, 31e-6, 32e-6}};
  rough.length = 41.0, rough.step = 0.042, rough.segments = 43, rough.spikes = 44;
  file.roughness = rough;
  const json r = json::parse(file_document(file))["rail"];
  expect_counted(lines, r);
  EXPECT_NEAR(r["alignment_residual_mm"], 0.015, 1e-12);
  EXPECT_EQ(r["inclination"], "1:4.3");  // 13 degrees
  EXPECT_EQ(r["roughness"], json({{"wavelength_m", {0.1, 0.08}},
                                  {"level_db", {11.0, 21.0}},
                                  {"limit_db", {5.0, 3.0}},
                                  {"exceedance_db", {6.0, 18.0}},
                                  {"spread_db", {12.0, 22.0}},
                                  {"floor_db", {14.0, 24.0}},
                                  {"length_m", 41.0},
                                  {"step_m", 0.042},
                                  {"segments", 43},
                                  {"spikes", 44}}));
  EXPECT_EQ(r["waves"][0],
            json({{"shortest_mm", 10.0}, {"longest_mm", 30.0}, {"rms_mm", 0.031}, {"peak_to_peak_mm", 0.032}}));
}

}  // namespace
}  // namespace treadmark::app
