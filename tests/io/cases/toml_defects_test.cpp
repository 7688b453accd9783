// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/tests/io/cases/parsed_cases.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

const std::string kEverything = kRail + R"(rail.resolution_mm = 0.5
wheel.resolution_mm = 2
wheel.backend = "mesh-flat"
[[wheel.flats]]
shape = "fresh"
length_mm = 40
theta_center_deg = 10
[[wheel.polygonizations]]
harmonics = [{ order = 7, amplitude_um = 50, phase_deg = 90 }, { order = 20, amplitude_um = -10, phase_rad = 0.5 }]
y_center_mm = 2
width_mm = 60
[[wheel.spalls]]
length_mm = 25
width_mm = 15
depth_mm = 0.9
edge_mm = 3
theta_center_deg = 170
y_center_mm = -2
[[rail.squats]]
length_mm = 40
width_mm = 25
depth_mm = 0.3
x_center_mm = 10
y_center_mm = -5
second_length_mm = 35
second_width_mm = 20
second_depth_mm = 0.5
second_distance_mm = 30
second_y_offset_mm = 2
[[rail.squats]]
length_mm = 20
width_mm = 20
depth_mm = 0.1
[[rail.corrugations]]
x_start_mm = -500
x_end_mm = 500
ramp_mm = 100
y_center_mm = 3
width_mm = 50
[[rail.corrugations.waves]]
wavelength_mm = 50
amplitude_um = 20
[[rail.corrugations.waves]]
wavelength_mm = 30
amplitude_um = 5
phase_deg = 180
[[rail.gauge_corner_collapses]]
length_mm = 400
depth_mm = 2
width_mm = 15
x_center_mm = 20
y_start_mm = -15
[[rail.gauge_corner_collapses]]
length_mm = 400
depth_mm = 2
width_mm = 15
y_start_mm = 15
towards = "+y"
[[rail.spalls]]
length_mm = 30
width_mm = 20
depth_mm = 1.2
edge_mm = 4
y_center_mm = 5
[[rail.flattened_heads]]
x_start_mm = -300
x_end_mm = 300
ramp_mm = 50
depth_mm = 1
roll_deg = -1
edge_radius_mm = 20
[[rail.milling_paths]]
stations = [{ x_mm = 0, y_mm = -30, z_mm = -1 }, { x_mm = 500, y_mm = -20, z_mm = 2, roll_deg = 2 }]
section = [{ length_mm = 20, radius_mm = -100 }, { length_mm = 15 }, { length_mm = 10, curvature_per_m = 5 }]
start_y_mm = -20
start_z_mm = 1
start_angle_deg = 10
)";

const WheelRailCase& first(const CaseFile& f) { return std::get<WheelRailCase>(f.cases.at(0).content); }

Defects expected_rail() {
  Defects d;
  d.squats = {{.length = 40e-3,
               .width = 25e-3,
               .depth = 0.3e-3,
               .x_center = 10e-3,
               .y_center = -5e-3,
               .second_length = 35e-3,
               .second_width = 20e-3,
               .second_depth = 0.5e-3,
               .second_distance = 30e-3,
               .second_y_offset = 2e-3},
              {.length = 20e-3, .width = 20e-3, .depth = 0.1e-3}};
  d.corrugations = {{{{50e-3, 20e-6, 0.0}, {30e-3, 5e-6, 180.0 * kDegree}}, -0.5, 0.5, 0.1, 3e-3, 50e-3}};
  d.gauge_corner_collapses = {{0.4, 2e-3, 15e-3, 20e-3, -15e-3, -1}, {0.4, 2e-3, 15e-3, 0.0, 15e-3, 1}};
  d.spalls = {{.length = 30e-3, .width = 20e-3, .depth = 1.2e-3, .edge = 4e-3, .y_center = 5e-3}};
  d.flattened_heads = {{-0.3, 0.3, 0.05, 1e-3, -kDegree, 20e-3}};
  d.milling_paths = {{{{0.0, -30e-3, -1e-3, 0.0}, {0.5, -20e-3, 2e-3, 2.0 * kDegree}},
                      -20e-3,
                      1e-3,
                      10.0 * kDegree,
                      {{20e-3, -10.0}, {15e-3, 0.0}, {10e-3, 5.0}}}};
  return d;
}

/// Equality but for rounding of units.
void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-15 * (1.0 + std::abs(b[i]))) << i;
}
std::vector<double> numbers(const Defects& d) {
  std::vector<double> all;
  const auto put = [&](auto... v) { (all.push_back(static_cast<double>(v)), ...); };
  for (const auto& f : d.flats) put(static_cast<int>(f.shape), f.length, f.depth, f.theta_center, f.y_center, f.width);
  for (const auto& p : d.polygonizations) {
    put(p.y_center, p.width);
    for (const auto& h : p.harmonics) put(h.order, h.amplitude, h.phase);
  }
  for (const auto& s : d.wheel_spalls) put(s.length, s.width, s.depth, s.edge, s.theta_center, s.y_center);
  for (const auto& s : d.squats)
    put(s.length, s.width, s.depth, s.x_center, s.y_center, s.second_length, s.second_width, s.second_depth,
        s.second_distance, s.second_y_offset);
  for (const auto& c : d.corrugations) {
    put(c.x_start, c.x_end, c.ramp, c.y_center, c.width);
    for (const auto& w : c.waves) put(w.wavelength, w.amplitude, w.phase);
  }
  for (const auto& g : d.gauge_corner_collapses) put(g.length, g.depth, g.width, g.x_center, g.y_start, g.gauge_side);
  for (const auto& s : d.spalls) put(s.length, s.width, s.depth, s.edge, s.x_center, s.y_center);
  for (const auto& h : d.flattened_heads) put(h.x_start, h.x_end, h.ramp, h.depth, h.roll, h.edge_radius);
  for (const auto& m : d.milling_paths) {
    put(m.start_y, m.start_z, m.start_angle);
    for (const auto& s : m.stations) put(s.x, s.y, s.z, s.roll);
    for (const auto& s : m.section) put(s.length, s.curvature);
  }
  return all;
}

TEST(TomlDefects, EveryKeyFindsItsPlace) {
  const CaseFile f = parse_study(kEverything);
  const WheelRailCase& c = first(f);
  expect_near(numbers(c.rail.defects), numbers(expected_rail()));
  Defects wheel;
  wheel.flats = {{WheelFlat::Shape::fresh, 40e-3, 0.0, 10.0 * kDegree, 0.0, 0.0}};
  wheel.polygonizations = {{{{7, 50e-6, 90.0 * kDegree}, {20, -10e-6, 0.5}}, 2e-3, 60e-3}};
  wheel.wheel_spalls = {{25e-3, 15e-3, 0.9e-3, 3e-3, 170.0 * kDegree, -2e-3}};
  expect_near(numbers(c.wheel.defects), numbers(wheel));
  EXPECT_DOUBLE_EQ(c.wheel.resolution, 2e-3);
  EXPECT_DOUBLE_EQ(c.rail.resolution, 0.5e-3);
  EXPECT_EQ(c.wheel.backend, "mesh-flat");
  EXPECT_EQ(first(parse_study(kRail)).wheel.resolution, 0.0);
  EXPECT_TRUE(first(parse_study(kRail)).rail.defects.empty());
}

TEST(TomlDefects, InlineAndSpreadOutListsAreTheSame) {
  const CaseFile inline_waves = parse_study(kRail + R"([[rail.corrugations]]
x_start_mm = -500
x_end_mm = 500
ramp_mm = 100
y_center_mm = 3
width_mm = 50
waves = [{ wavelength_mm = 50, amplitude_um = 20 }, { wavelength_mm = 30, amplitude_um = 5, phase_deg = 180 }]
)");
  EXPECT_EQ(first(inline_waves).rail.defects.corrugations, first(parse_study(kEverything)).rail.defects.corrugations);
}

TEST(TomlDefects, OverridesReachIntoNestedLists) {
  const CaseFile f = parse_study(
      kEverything,
      {"rail.squats.0.depth_mm=0.2", "rail.squats.1.second_depth_mm=0.05", "rail.corrugations.0.waves.1.amplitude_um=7",
       "rail.corrugations.0.waves.0.phase_rad=0.25", "wheel.polygonizations.0.harmonics.1.order=18",
       "rail.milling_paths.0.stations.1.z_mm=3", "rail.milling_paths.0.section.0.radius_mm=-200",
       "rail.gauge_corner_collapses.0.towards=+y", "rail.flattened_heads.0.roll_deg=2", "wheel.resolution_mm=0.25"});
  const WheelRailCase& c = first(f);
  EXPECT_DOUBLE_EQ(c.rail.defects.squats.at(0).depth, 0.2e-3);
  EXPECT_DOUBLE_EQ(c.rail.defects.squats.at(1).second_depth, 0.05e-3);
  EXPECT_DOUBLE_EQ(c.rail.defects.corrugations.at(0).waves.at(1).amplitude, 7e-6);
  EXPECT_DOUBLE_EQ(c.rail.defects.corrugations.at(0).waves.at(1).wavelength, 30e-3);
  EXPECT_DOUBLE_EQ(c.rail.defects.corrugations.at(0).waves.at(0).phase, 0.25);
  EXPECT_EQ(c.wheel.defects.polygonizations.at(0).harmonics.at(1).order, 18);
  EXPECT_DOUBLE_EQ(c.rail.defects.milling_paths.at(0).stations.at(1).z, 3e-3);
  EXPECT_DOUBLE_EQ(c.rail.defects.milling_paths.at(0).section.at(0).curvature, -5.0);
  EXPECT_EQ(c.rail.defects.gauge_corner_collapses.at(0).gauge_side, 1);
  EXPECT_DOUBLE_EQ(c.rail.defects.flattened_heads.at(0).roll, 2.0 * kDegree);
  EXPECT_DOUBLE_EQ(c.wheel.resolution, 0.25e-3);
  // a nested list as a whole
  const CaseFile whole = parse_study(kEverything, {"rail.corrugations.0.waves=[{wavelength_mm=80, amplitude_um=1}]"});
  ASSERT_EQ(first(whole).rail.defects.corrugations.at(0).waves.size(), 1u);
  EXPECT_DOUBLE_EQ(first(whole).rail.defects.corrugations.at(0).waves[0].wavelength, 80e-3);
  EXPECT_DOUBLE_EQ(first(whole).rail.defects.corrugations.at(0).ramp, 0.1);
}

TEST(TomlDefects, OverrideErrorsNameTheOverride) {
  EXPECT_THAT(
      study_refusal(kEverything, {"rail.corrugations.0.waves.2.phase_deg=1"}),
      ::testing::HasSubstr("override 'rail.corrugations.0.waves.2.phase_deg=1': waves has 2 entries, number 2"));
  EXPECT_THAT(study_refusal(kEverything, {"rail.corrugations.0.waves.1.phas_deg=1"}),
              ::testing::HasSubstr("did you mean 'phase_deg'?"));
  EXPECT_THAT(study_refusal(kEverything, {"rail.corrugations.0.waves.1=1"}), ::testing::HasSubstr("waves is a list"));
  EXPECT_THAT(study_refusal(kEverything, {"rail.corrugations.0.waves.x.phase_deg=1"}),
              ::testing::HasSubstr("waves is a list"));
  EXPECT_THAT(study_refusal(kEverything, {"rail.corrugations.1.ramp_mm=1"}),
              ::testing::HasSubstr("rail.corrugations has 1 entries"));
  EXPECT_THAT(study_refusal(kEverything, {"rail.squats.0.depht_mm=1"}),
              ::testing::HasSubstr("did you mean 'depth_mm'?"));
  EXPECT_THAT(study_refusal(kEverything, {"wheel.polygonizations.0.harmonics.0.order=7.5"}),
              ::testing::HasSubstr("order must be an integer"));
}

class TomlDefectError : public ::testing::TestWithParam<Wrong> {};
TEST_P(TomlDefectError, TellsPositionAndReason) {
  EXPECT_THAT(study_refusal(kRail + GetParam().text), ::testing::HasSubstr(GetParam().expected));
}

const std::string kSquat = "length_mm = 40, width_mm = 25, depth_mm = 0.3";
const std::string kStretch = "x_start_mm = 0, x_end_mm = 100, ramp_mm = 20";
const std::string kStations = "stations = [{ x_mm = 0 }, { x_mm = 500 }]";
INSTANTIATE_TEST_SUITE_P(
    Shapes, TomlDefectError,
    ::testing::Values(
        Wrong{"[[rail.squats]]\nlength_mm = 40\nwidth_mm = 25\ndept_mm = 1\n",
              "folder/study.toml:7:1: unknown key 'dept_mm' (did you mean 'depth_mm'?)"},
        Wrong{"[[rail.squats]]\nlength_mm = 40\nwidth_mm = 25\n",
              "folder/study.toml:4:1: depth_mm of rail.squats is missing"},
        Wrong{"rail.squats = [{ " + kSquat + " }, { " + kSquat + ", second_depth_mm = 30 }]\n",
              "folder/study.toml:1:1: case 1: rail.squats[1]: a dip is too deep for its length"},
        Wrong{"rail.squats = [{ length_mm = -1, width_mm = 25, depth_mm = 0.3 }]\n",
              "folder/study.toml:4:30: length_mm = -1 must be greater than 0"},
        Wrong{"[[wheel.squats]]\n", "unknown key 'wheel.squats' (did you mean 'rail.squats'?)"},
        Wrong{"[[rail.flats]]\nlength_mm = 1\n", "unknown key 'rail.flats' (did you mean 'wheel.flats'?)"},
        Wrong{"rail.corrugations = [{ " + kStretch + " }]\n", "waves of rail.corrugations is missing"},
        Wrong{"rail.corrugations = [{ " + kStretch + ", waves = [] }]\n",
              "rail.corrugations[0]: it needs at least one wave"},
        Wrong{"rail.corrugations = [{ " + kStretch + ", waves = 3 }]\n",
              "waves must be a list of tables, found an integer"},
        Wrong{"rail.corrugations = [{ " + kStretch + ", waves = [{ wavelength_mm = 50 }] }]\n",
              "amplitude_um of waves is missing"},
        Wrong{"rail.corrugations = [{ " + kStretch + ", waves = [{ wavelength_mm = 50, amplitude_mm = 1 }] }]\n",
              "folder/study.toml:4:101: unknown key 'amplitude_mm' (did you mean 'amplitude_um'?)"},
        Wrong{"rail.corrugations = [{ " + kStretch +
                  ", waves = [{ wavelength_mm = 50, amplitude_um = 1, phase_deg = 1, phase_rad = 1 }] }]\n",
              "phase_deg and phase_rad exclude each other"},
        Wrong{"rail.corrugations = [{ " + kStretch + ", waves = [{ wavelength_mm = 1, amplitude_um = 200 }] }]\n",
              "the waves are too steep"},
        Wrong{"rail.corrugations = [{ x_start_mm = 0, x_end_mm = 100, ramp_mm = 51, waves = [{ wavelength_mm = 50, "
              "amplitude_um = 1 }] }]\n",
              "the ramps are longer than half the length"},
        Wrong{"wheel.polygonizations = [{ harmonics = [{ order = 0, amplitude_um = 1 }] }]\n",
              "order = 0 must be at least 1"},
        Wrong{"wheel.polygonizations = [{ harmonics = [{ order = 100, amplitude_um = 10000 }] }]\n",
              "wheel.polygonizations[0]: the waves are too steep"},
        Wrong{"rail.gauge_corner_collapses = [{ length_mm = 400, depth_mm = 2, width_mm = 15, y_start_mm = 0, towards "
              "= \"left\" }]\n",
              "towards = \"left\" is not one of \"-y\", \"+y\""},
        Wrong{"rail.gauge_corner_collapses = [{ length_mm = 400, depth_mm = 2, width_mm = 1, y_start_mm = 0 }]\n",
              "too deep for its width"},
        Wrong{"rail.flattened_heads = [{ " + kStretch + ", depth_mm = 1, roll_deg = 50 }]\n", "within +-45 degrees"},
        Wrong{"rail.flattened_heads = [{ " + kStretch + ", depth_mm = 20 }]\n", "the ramp is too short for the depth"},
        Wrong{"rail.milling_paths = [{ stations = [{ x_mm = 0 }], section = [{ length_mm = 1 }] }]\n",
              "it needs at least two stations"},
        Wrong{"rail.milling_paths = [{ stations = [{ x_mm = 5 }, { x_mm = 5 }], section = [{ length_mm = 1 }] }]\n",
              "the stations must have strictly increasing x"},
        Wrong{"rail.milling_paths = [{ " + kStations + ", section = [{ length_mm = 100, radius_mm = 50 }] }]\n",
              "rail.milling_paths[0]: the section is too steep (it must be a graph z(y)"},
        Wrong{"rail.milling_paths = [{ " + kStations + ", section = [{ length_mm = 10, radius_mm = 0 }] }]\n",
              "radius_mm must not be 0"},
        Wrong{"wheel.flats = [{ length_mm = 950, shape = \"fresh\" }]\n",
              "wheel.flats[0]: the length must fit on the wheel"},
        Wrong{"wheel.resolution_mm = 0\n", "must be greater than 0"}));

TEST(TomlDefects, SchemaKnowsNestedLists) {
  const auto schema = nlohmann::json::parse(case_file_schema());
  const auto& waves =
      schema.at("properties").at("rail").at("properties").at("corrugations").at("items").at("properties").at("waves");
  EXPECT_EQ(waves.at("type"), "array");
  EXPECT_EQ(waves.at("items").at("required"), (nlohmann::json{"wavelength_mm", "amplitude_um"}));
  EXPECT_EQ(waves.at("items").at("properties").at("phase_deg").at("default"), 0);
  EXPECT_EQ(waves.at("items").at("additionalProperties"), false);
  const auto& excluded = schema.at("properties").at("patch").at("allOf");
  EXPECT_NE(std::find(excluded.begin(), excluded.end(), nlohmann::json{{"not", {{"required", {"hertz", "gap"}}}}}),
            excluded.end());
  EXPECT_THAT(case_key_table(), ::testing::HasSubstr("### `[[rail.milling_paths.stations]]`"));
}

TEST(TomlPatch, HertzAndGapExcludeEachOther) {
  const std::string patch = "[patch]\nnormal_force_N = 1e3\nmx = 10\nmy = 8\ndx_mm = 1\ndy_mm = 1\n";
  const std::string hertz = "[patch.hertz]\ncurvature_x_per_m = 1\ncurvature_y_per_m = 1\n";
  const std::string gap = "[patch.gap]\ncoefficients_si = [1, 0, 1, 0, 0, 0]\n";
  EXPECT_EQ(study_refusal(patch + hertz + gap),
            "folder/study.toml:11:1: [patch.hertz] and [patch.gap] exclude each other (give one of them)");
  EXPECT_THAT(study_refusal(patch + gap + hertz),
              ::testing::HasSubstr("folder/study.toml:10:1: [patch.hertz] and [patch.gap] exclude each other"));
  EXPECT_EQ(study_refusal(patch + hertz), "no error");
  EXPECT_EQ(study_refusal(patch + gap), "no error");
  // a case of a study may replace one by the other
  const CaseFile f = parse_study(patch + hertz + "[[cases]]\npatch.gap.coefficients_si = [1, 0, 1, 0, 0, 0]\n");
  EXPECT_TRUE(std::holds_alternative<GapInput>(std::get<BasicCase>(f.cases.at(0).content).geometry));
}

}  // namespace
}  // namespace treadmark::io
