// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Geometry of wheelsets and measures by text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/interfaces/c/owned.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string text_of_geometry(const std::vector<const char*>& settings, tm_status expected = TM_OK) {
  char* text = nullptr;
  EXPECT_EQ(tm_geometry(settings.data(), settings.size(), &text), expected) << tm_message();
  EXPECT_EQ(text == nullptr, expected != TM_OK);
  std::string result = text == nullptr ? std::string() : text;
  tm_text_free(text);
  return result;
}

std::string text_of_measures(tm_body body, const char* file, const std::vector<const char*>& settings,
                             tm_status expected = TM_OK) {
  char* text = nullptr;
  EXPECT_EQ(tm_measure(body, file, settings.data(), settings.size(), &text), expected) << tm_message();
  EXPECT_EQ(text == nullptr, expected != TM_OK);
  std::string result = text == nullptr ? std::string() : text;
  tm_text_free(text);
  return result;
}

const std::vector<const char*> kPair{"wheel=S1002", "rail=60E1", "gauge_mm=1435", "cant=1:40"};

std::vector<const char*> with(std::vector<const char*> settings, const std::vector<const char*>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

TEST(CRequests, GeometryIsThatOfTheLibrary) {
  app::GeometryRequest request;
  request.wheel = "S1002", request.wheel_left = "cone 1:20", request.rail = "60E1";
  request.diameter = 0.9192, request.diameter_left = 0.9191;
  request.gauge = 1.4352, request.cant = app::parse_cant("1:40"), request.wheel_origins = 1.499;
  request.settings.amplitudes = {1e-3, 2.5e-3};
  request.settings.roll = geometry::Roll::free;
  request.settings.yaw = 2e-3;
  request.settings.step = 0.2e-3;
  request.gauges = {1.433, 1.4345};
  app::SectionStore store;
  const app::GeometryResult expected = app::run_geometry(request, store);
  const std::string text =
      text_of_geometry(with(kPair, {"wheel_left=cone 1:20", "diameter_mm=919.2", "diameter_left_mm=919.1",
                                    "gauge_mm=1435.2", "wheel_origins_mm=1499", "amplitudes_mm=[1, 2.5]", "roll=free",
                                    "yaw_mrad=2", "step_mm=0.2", "gauges_mm=1433,1434.5"}));
  EXPECT_EQ(json::parse(text), json::parse(app::geometry_json(expected)));
  const json schema = json::parse(app::geometry_schema());
  EXPECT_EQ(first_violation(json::parse(text), schema, schema), "");
}

// Each key reaches something that results depend on, or says so.
TEST(CRequests, EverySettingOfGeometryCounts) {
  const std::string plain = text_of_geometry(with(kPair, {"amplitudes_mm=3"}));
  const std::vector<const char*> changes{
      "wheel_left=1:40",  "rail_left=54E1", "diameter_mm=900",    "diameter_left_mm=919.9",
      "gauge_mm=1434",    "cant=1:20",      "gauge_height_mm=12", "wheel_origins_mm=1499",
      "amplitudes_mm=4",  "amplitude_mm=4", "gauges_mm=1434",     "roll=free",
      "axle_load_kN=100", "yaw_mrad=5",     "step_mm=0.05",       "second_mm=0",
      "backend=spline",   "pitch_deg=5",    "position_mm=5",      "new_wheel=1:40",
      "new_rail=54E1"};
  for (const char* change : changes)
    EXPECT_NE(text_of_geometry(with(kPair, {"amplitudes_mm=3", change})), plain) << change;
  // those that need others, and what is not in the pair at all
  const std::vector<std::string> beside{"case", "wheel", "rail", "rail_origins_mm", "scale", "resolution_mm"};
  text_of_geometry({"somethingelse=1"}, TM_BAD_REQUEST);  // the message names all that there are
  const std::string message = tm_message();
  EXPECT_EQ(static_cast<std::size_t>(ranges::count(message, ',')) + 1, changes.size() + beside.size()) << message;
  for (const std::string& key : beside) EXPECT_THAT(message, HasSubstr(key));
  EXPECT_NE(text_of_geometry({"wheel=S1002", "rail=60E1", "cant=1:40", "rail_origins_mm=1507", "amplitudes_mm=3"}),
            text_of_geometry({"wheel=S1002", "rail=60E1", "cant=1:40", "rail_origins_mm=1508", "amplitudes_mm=3"}));
  EXPECT_NE(text_of_geometry(with(kPair, {"amplitudes_mm=3", "backend=spline", "resolution_mm=2"})),
            text_of_geometry(with(kPair, {"amplitudes_mm=3", "backend=spline", "resolution_mm=0.25"})));
}

TEST(CRequests, DocumentsNameEverySetting) {
  std::ifstream in(std::string(TREADMARK_SOURCE_DIR) + "/docs/c-interface.md");
  const std::string page(std::istreambuf_iterator<char>(in), {});
  for (const auto* keys : {&app::geometry_keys().infos, &app::measure_keys().infos})
    for (const io::KeyInfo& key : *keys) EXPECT_THAT(page, HasSubstr('`' + key.path + '`'));
}

TEST(CRequests, AProfileIsReadAsTheProgramReadsIt) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "worn.csv").string();
  std::ofstream out(file);
  out << "y [mm],z [mm]\n";
  for (int i = 0; i <= 60; ++i) out << 30 - i << ',' << (i > 50 ? (i - 50) * (i - 50) / 4.0 : 0.0) << '\n';
  out.close();
  char* text = nullptr;
  ASSERT_EQ(tm_check_profile(file.c_str(), "wheel", &text), TM_OK) << tm_message();
  const json said = json::parse(text);
  tm_text_free(text);
  const app::CheckedProfile expected = app::check_profile(file, Body::wheel);
  EXPECT_EQ(said.at("body"), "wheel");
  ASSERT_FALSE(expected.judgement.facts.empty());
  EXPECT_EQ(said.at("facts"), json(expected.judgement.facts));
  EXPECT_EQ(said.at("warnings").size(), expected.judgement.remarks.size());
  EXPECT_EQ(tm_check_profile(file.c_str(), "flange", &text), TM_BAD_ARGUMENT);
  EXPECT_EQ(text, nullptr);
}

TEST(CRequests, AConeIsACone) {
  const json g =
      json::parse(text_of_geometry({"wheel=cone 1:20", "rail=circle R300", "rail_origins_mm=1500"})).at("geometry");
  for (const json& value : g.at("conicity").at("tan_gamma_e")) EXPECT_NEAR(value.get<double>(), 0.05, 1e-9);
}

TEST(CRequests, ACaseSaysItAllAndItsKeysChange) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "case.toml").string(), setting = "case=" + file;
  std::ofstream(file) << kText;
  const json g = json::parse(text_of_geometry({setting.c_str(), "track.gauge_mm=1434"})).at("geometry");
  EXPECT_NEAR(g.at("track").at("gauge_mm").get<double>(), 1434.0, 1e-9);
  EXPECT_NEAR(g.at("track").at("inclination").get<double>(), 1.0 / 40.0, 1e-9);
  EXPECT_EQ(g.at("wheelset").at("diameter_right_mm"), 920.0);
}

TEST(CRequests, MeasuresAreThoseOfTheLibrary) {
  app::MeasureRequest request;
  request.nominal = "S1002";
  request.nominal_radius = 0.46;
  const std::string text = text_of_measures(TM_WHEEL, "S1002/h30/10%", {"nominal=S1002", "nominal_radius_mm=460"});
  EXPECT_EQ(json::parse(text), json::parse(app::measure_json(app::measure_file("S1002/h30/10%", request), request)));
  const json schema = json::parse(app::measure_schema());
  EXPECT_EQ(first_violation(json::parse(text), schema, schema), "");
  // what its name says
  constexpr double kDrawn = 5e-4;  // [mm]
  EXPECT_NEAR(json::parse(text).at("wheel").at("flange_height_mm").get<double>(), 30.0, kDrawn);
  EXPECT_NEAR(json::parse(text).at("wheel").at("flange_thickness_mm").get<double>(), 32.5, kDrawn);
}

TEST(CRequests, LimitsThatDoNotHoldAreResults) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "limits.toml").string(), setting = "limits=" + file;
  std::ofstream(file) << "[wheel]\nflange_thickness_mm = { min = 33 }\n";
  EXPECT_EQ(json::parse(text_of_measures(TM_WHEEL, "S1002", {setting.c_str()})).at("status"), "outside");
  std::ofstream(file) << "[wheel]\nflange_hight_mm = { max = 36 }\n";
  text_of_measures(TM_WHEEL, "S1002", {setting.c_str()}, TM_BAD_REQUEST);
  EXPECT_THAT(tm_message(), HasSubstr("limits.toml:2:1"));
  EXPECT_THAT(tm_message(), HasSubstr("flange_height_mm"));
}

TEST(CRequests, ManyThreadsAskAtOnce) {
  const std::string alone = text_of_geometry(kPair), measured = text_of_measures(TM_RAIL, "60E1", {"nominal=60E1"});
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(text_of_geometry(kPair), alone);
        EXPECT_EQ(text_of_measures(TM_RAIL, "60E1", {"nominal=60E1"}), measured);
        text_of_geometry({"wheel=nowhere.whl"}, TM_BAD_REQUEST);
        EXPECT_THAT(tm_message(), HasSubstr("rail is missing"));
      }
    });
  for (std::thread& t : threads) t.join();
}

TEST(CRequests, AFlagCancels) {
  const int flag = 1;
  tm_set_cancel_flag(&flag);
  text_of_geometry(kPair, TM_CANCELLED);
  tm_set_cancel_flag(nullptr);
  EXPECT_EQ(tm_geometry(kPair.data(), kPair.size(), nullptr), TM_OK) << tm_message();
  EXPECT_EQ(tm_measure(TM_WHEEL, "S1002", nullptr, 0, nullptr), TM_OK) << tm_message();
}

}  // namespace
}  // namespace treadmark::testing
