// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/geometry/pages/geometry_page.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using treadmark::testing::run_program;

const std::vector<std::string> kPair{"geometry", "--wheel", "S1002",      "--rail", "60E1",
                                     "--cant",   "1:40",    "--gauge-mm", "1435"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(GeometryCommand, WritesJsonByItsSchema) {
  const auto result =
      run_program(with(kPair, {"--json", "-", "--amplitudes-mm", "1:8:0.5", "--gauges-mm", "1434,1436"}));
  ASSERT_EQ(result.status, 0) << result.err;
  const json out = json::parse(result.out);
  const json schema = json::parse(geometry_schema());
  EXPECT_EQ(treadmark::testing::first_violation(out, schema, schema), "");
  const json& g = out.at("geometry");
  EXPECT_EQ(g.at("conicity").at("tan_gamma_e").size(), 15u);
  EXPECT_NEAR(g.at("conicity_3mm").get<double>(), 0.174, 0.003);
  const json& functions = g.at("functions");
  const std::size_t rows = functions.at("y_mm").size();
  for (const auto& [name, values] : functions.items()) EXPECT_EQ(values.size(), rows) << name;
  EXPECT_EQ(functions.size(), columns<FunctionRow>().size());
  // the same numbers in two ways
  for (std::size_t i = 0; i < rows; ++i)
    EXPECT_NEAR(functions["delta_r_mm"][i].get<double>(),
                functions["radius_right_mm"][i].get<double>() - functions["radius_left_mm"][i].get<double>(), 1e-9);
  EXPECT_EQ(g.at("gauge_sweep").at("tan_gamma_e").size(), 2u);
  EXPECT_FALSE(g.at("jumps").empty());
}

TEST(GeometrySchema, IsMadeOfItsRows) {
  using treadmark::testing::expect_rows, treadmark::testing::is_required;
  const json schema = json::parse(geometry_schema()), g = schema["properties"]["geometry"];
  const json &members = g["properties"], &load = members["load"];
  expect_rows<GeometryResult>(g);
  expect_rows<FunctionRow>(members["functions"], true);
  expect_rows<ConicityRow>(members["conicity"], true);
  expect_rows<ConicityRow>(members["with_new"]["properties"]["conicity"], true);
  expect_rows<geometry::Jump>(members["jumps"]["items"]);
  expect_rows<geometry::FurtherTouch>(members["second_contacts"]["items"]);
  expect_rows<geometry::LoadedFunctions>(load);
  for (const char* side : {"left", "right"}) {
    expect_rows<geometry::ShiftLimit>(members["limits"]["properties"][side]);
    expect_rows<geometry::LoadedSide>(load["properties"][side]);
  }
  for (const Column<geometry::LoadedPosition>& column : columns<geometry::LoadedPosition>()) {
    const std::string key(column.key);
    EXPECT_EQ(members["functions"]["properties"][key]["type"], "array") << key;
    EXPECT_FALSE(is_required(members["functions"], key)) << key << " needs a load";
  }
  EXPECT_FALSE(is_required(g, "load"));
  for (const char* asked : {"roll", "yaw_mrad", "step_mm", "smoothing_mm", "pitch_deg", "position_mm"})
    EXPECT_TRUE(is_required(members["method"], asked)) << asked;
  EXPECT_EQ(members["method"]["properties"]["roll"]["enum"], json({"none", "free"}));
  EXPECT_EQ(load["properties"]["largest_pressure"]["properties"]["side"]["enum"], json({"right", "left", nullptr}));
}

TEST(GeometryCommand, WritesAFolder) {
  const treadmark::testing::TemporaryFolder folder;
  const auto result = run_program(with(kPair, {"-o", (folder.path() / "out").string(), "--gauges-mm", "1432:1437:1"}));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("conicity at 3 mm        0.17"));
  for (const char* name : {"geometry.json", "functions.csv", "conicity.csv", "charts.svg", "contact_points.svg",
                           "gauges.csv", "gauges.svg"})
    EXPECT_GT(std::filesystem::file_size(folder.path() / "out" / name), 200u) << name;
}

// JSON, text, lists and pages have the numbers by the same rows.
TEST(GeometryCommand, ANumberIsTheSameEverywhere) {
  GeometryRequest request;
  request.wheel = "S1002", request.rail = "60E1", request.cant = parse_cant("1:40"), request.gauge = 1.435;
  request.settings.amplitudes = {2e-3, 3e-3};
  SectionStore store;
  const GeometryResult result = run_geometry(request, store);
  const json g = json::parse(geometry_json(result)).at("geometry");
  EXPECT_NEAR(g.at("track").at("clearance_mm").get<double>(),
              1e3 * (result.analysis.gauge - result.analysis.active_faces), 1e-9);
  EXPECT_EQ(g.at("equilibrium_reason"), nullptr);
  EXPECT_FALSE(g.contains("conicity_3mm_noise")) << "the profiles are exact";
  const std::string text = geometry_text(result);
  EXPECT_THAT(text,
              HasSubstr(fmt::format("clearance               {:.3f} mm\n", g["track"]["clearance_mm"].get<double>())));
  EXPECT_THAT(
      text, HasSubstr(fmt::format("equivalent conicity     {:.4f}\n", g["conicity_at"]["tan_gamma_e"].get<double>())));
  EXPECT_EQ(geometry_page(result).sections.front().blocks.size(), 2u);
  const ResultList list = run_pairs({request});
  EXPECT_EQ(list.settings, "amplitudes_mm = [2, 3]") << "what is other than usual";
  const auto listed = [&](const char* name) {
    const auto at = ranges::find(list.numbers, name, &ListColumn::name);
    return list.rows[0].numbers.at(static_cast<std::size_t>(at - list.numbers.begin()));
  };
  EXPECT_NEAR(listed("clearance_mm"), g["track"]["clearance_mm"].get<double>(), 1e-9);
  EXPECT_NEAR(listed("tan_gamma_e_3mm"), g["conicity_3mm"].get<double>(), 1e-12);
  EXPECT_NEAR(listed("flange_thickness_left_mm"), g["wheelset"]["flange_thickness_left_mm"].get<double>(), 1e-9);
}

TEST(GeometryCommand, TakesCases) {
  const treadmark::testing::TemporaryFolder folder;
  const auto by_name = run_program(with(kPair, {"--json", "-"}));
  folder.write("case.toml", treadmark::testing::standard_case("1.0"));
  const auto by_case = run_program({"geometry", (folder.path() / "case.toml").string(), "--json", "-"});
  ASSERT_EQ(by_case.status, 0) << by_case.err;
  const json a = json::parse(by_name.out).at("geometry"), b = json::parse(by_case.out).at("geometry");
  EXPECT_NEAR(a.at("conicity_3mm").get<double>(), b.at("conicity_3mm").get<double>(),
              1e-3);  // 1:40 is an angle there, a tangent here
  EXPECT_EQ(b.at("track").at("gauge_mm").get<double>(), 1435.0);
}

TEST(GeometryCommand, TheEffectOfWear) {
  const treadmark::testing::TemporaryFolder folder;
  const auto result = run_program(with(kPair, {"--new-wheel", "1:40", "--json", "-", "--amplitudes-mm", "1,3"}));
  ASSERT_EQ(result.status, 0) << result.err;
  const json out = json::parse(result.out), g = out.at("geometry");
  const json schema = json::parse(geometry_schema());
  EXPECT_EQ(treadmark::testing::first_violation(out, schema, schema), "");
  EXPECT_NEAR(g["conicity_3mm"].get<double>(), 0.174, 3e-3);
  // a tread 1:40 has the conicity of its cone
  EXPECT_NEAR(g["with_new"]["conicity_3mm"].get<double>(), 0.025, 1e-3);
  EXPECT_EQ(g["with_new"]["rail"], "");
  std::vector<std::string> worn = kPair;
  worn[2] = "1:40";
  const auto both = run_program(with(worn, {"--new-wheel", "S1002", "--new-rail", "60E1", "--json", "-"}));
  const auto alone = run_program(with(kPair, {"--json", "-"}));
  EXPECT_EQ(json::parse(both.out)["geometry"]["with_new"]["conicity"]["tan_gamma_e"],
            json::parse(alone.out)["geometry"]["conicity"]["tan_gamma_e"]);
  EXPECT_EQ(run_program(with(kPair, {"--new-wheel", "60E1"})).status, 3);
}

TEST(GeometryCommand, ListsOfPairsGoOnAfterABadOne) {
  const treadmark::testing::TemporaryFolder folder;
  write_file(folder.path() / "bad.prw", "no profile\n");
  write_file(folder.path() / "pairs.csv",
             "name,wheel,rail,gauge_mm,diameter_left_mm\n"
             "one,S1002,60E1,1435,\n"
             "broken,bad.prw,60E1,1435,\n"
             "\"wide, very\",S1002,60E1,1600,\n"
             "other,S1002,60E1,1437,919.9\n");
  const auto result = run_program({"geometry", "--pairs", (folder.path() / "pairs.csv").string(), "--cant", "1:40",
                                   "--amplitudes-mm", "2,3", "--csv", (folder.path() / "out.csv").string()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("2 of 4 pairs failed"));
  std::ifstream in(folder.path() / "out.csv");
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_THAT(lines[0], HasSubstr(",tan_gamma_e_at_2mm,tan_gamma_e_at_3mm"));
  EXPECT_THAT(lines[1], HasSubstr("one,S1002,,60E1,,ok,,1435,"));
  EXPECT_THAT(lines[2], HasSubstr("failed"));
  EXPECT_THAT(lines[2], HasSubstr("bad.prw"));
  EXPECT_THAT(lines[3], HasSubstr("falls through the gauge"));
  EXPECT_THAT(lines[4], HasSubstr(",ok,"));
}

TEST(GeometryCommand, PairsDoNotDependOnThreads) {
  GeometryRequest usual;
  usual.wheel = "S1002", usual.rail = "60E1", usual.cant = 0.025;
  usual.settings.amplitudes = {3e-3};
  std::vector<GeometryRequest> requests;
  for (int k = 0; k < 6; ++k) {
    requests.push_back(usual);
    requests.back().gauge = 1.433 + 1e-3 * k;
  }
  std::string one, all;
  {
    const ThreadLimit limit(1);
    one = list_csv(run_pairs(requests));
  }
  all = list_csv(run_pairs(requests));
  EXPECT_EQ(one, all);
}

TEST(GeometryCommand, SaysWhatIsWrongWithAList) {
  const treadmark::testing::TemporaryFolder folder;
  const auto error_of = [&](const std::string& text) {
    const std::string file = (folder.path() / "list.csv").string();
    write_file(file, text);
    try {
      read_pair_list(file, {});
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(error_of("wheel,rial\n"), HasSubstr("list.csv:1: 'rial' is no column"));
  EXPECT_THAT(error_of("wheel,gauge_mm\nS1002,wide\n"), HasSubstr("list.csv:2: 'wide' is no number for gauge_mm"));
  EXPECT_THAT(error_of("wheel,gauge_mm\nS1002,-1435\n"),
              HasSubstr("list.csv:2: gauge_mm = -1435 must be greater than 0"));
  EXPECT_THAT(error_of("wheel,axle_load_kN\n"), HasSubstr("'axle_load_kN' is no column"));
  EXPECT_THAT(error_of("wheel\nS1002,60E1\n"), HasSubstr("more cells (2) than the list has columns (1)"));
  EXPECT_THAT(error_of("wheel,rail\n"), HasSubstr("no pairs"));
}

// Options are made from the keys: limits, units, words and defaults.
TEST(GeometryCommand, OptionsAreThoseOfTheKeys) {
  const std::string help = run_program({"geometry", "--help"}).out;
  for (const io::KeyInfo& key : geometry_keys().infos) EXPECT_THAT(help, HasSubstr(key.doc.substr(0, 20))) << key.path;
  EXPECT_THAT(help, HasSubstr("--gauge-height-mm MM"));
  EXPECT_THAT(help, HasSubstr("--cant 1:N"));
  EXPECT_EQ(run_program(with(kPair, {"--step-mm", "3"})).status, 2);
  EXPECT_EQ(run_program(with(kPair, {"--roll", "some"})).status, 2);
  EXPECT_EQ(run_program(with(kPair, {"--set", "track.gauge_mm=1434"})).status, 2) << "there is no case";
  const auto echo = [](const std::vector<std::string>& more) {
    return json::parse(run_program(with(kPair, more)).out)["geometry"]["method"];
  };
  const json method =
      echo({"--yaw-mrad", "-2", "--step-mm", "0.2", "--pitch-deg", "5", "--roll", "free", "--json", "-"});
  EXPECT_EQ(method, json::parse(R"({"roll": "free", "smoothing_mm": 0.0, "yaw_mrad": -2.0, "step_mm": 0.2,
                                    "pitch_deg": 5.0, "position_mm": 0.0})"));
}

TEST(GeometryCommand, ExitStatuses) {
  EXPECT_EQ(run_program({"geometry"}).status, 2);
  EXPECT_EQ(run_program(with(kPair, {"--amplitudes-mm", "40"})).status, 2);
  EXPECT_EQ(run_program(with(kPair, {"--wheel-left", "nothing.prw"})).status, 3);
  EXPECT_EQ(run_program({"geometry", "--wheel", "S1002", "--rail", "60E1", "--gauge-mm", "1600"}).status, 1);
}

}  // namespace
}  // namespace treadmark::app
