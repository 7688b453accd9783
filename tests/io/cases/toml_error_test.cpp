// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/tests/io/cases/parsed_cases.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

const std::string kBarePatch = "[patch]\nnormal_force_N = 1e3\nmx = 10\nmy = 8\n";
const std::string kHertz =
    kBarePatch + "hertz.given = \"curvatures\"\nhertz.curvature_x_per_m = 1\nhertz.curvature_y_per_m = 1\n";

class TomlError : public ::testing::TestWithParam<Wrong> {};
TEST_P(TomlError, TellsPositionAndReason) {
  EXPECT_THAT(study_refusal(GetParam().text), ::testing::HasSubstr(GetParam().expected));
}

INSTANTIATE_TEST_SUITE_P(
    Keys, TomlError,
    ::testing::Values(
        Wrong{kRail + "wheelset.pich_deg = 3\n",
              "folder/study.toml:4:10: unknown key 'wheelset.pich_deg' (did you mean 'wheelset.pitch_deg'?)"},
        Wrong{kRail + "wheelset.pitch = 3\n", "did you mean 'wheelset.pitch_deg'?"},
        Wrong{kRail + "[weelset]\ny_mm = 1\n", "folder/study.toml:4:2: unknown key 'weelset'"},
        Wrong{kRail + "track.vertical_force_N = 3\n", "did you mean 'wheelset.vertical_force_N'?"},
        Wrong{kRail + "zzzzzzzz = 3\n", "unknown key 'zzzzzzzz' (see docs/case-file.md"},
        Wrong{kRail + "[[cases]]\nwheelset.y = 3\n", "unknown key 'wheelset.y' (did you mean 'wheelset.y_mm'?)"},
        Wrong{kRail + "wheel.flats = [ { lenth_mm = 3 } ]\n", "unknown key 'lenth_mm' (did you mean 'length_mm'?)"},
        Wrong{kRail + "wheelset = 3\n", "not valid TOML"},
        Wrong{"wheelset = 3\n", "folder/study.toml:1:12: wheelset must be a table, found an integer"},
        Wrong{kRail + "title = 3\n", "title must be text"},
        Wrong{kRail + "cases = 3\n", "cases must be a list of tables"},
        Wrong{kRail + "cases = []\n", "cases must be a list of tables"},
        Wrong{kRail + "cases = [1]\n", "[[cases]] must be tables"}));

INSTANTIATE_TEST_SUITE_P(
    Types, TomlError,
    ::testing::Values(
        Wrong{kRail + "wheelset.y_mm = \"3\"\n", "folder/study.toml:4:17: wheelset.y_mm must be a number, found text"},
        Wrong{kRail + "wheelset.y_mm = true\n", "found true or false"},
        Wrong{kRail + "wheelset.y_mm = [1, 2]\n", "must be a number, found a list"},
        Wrong{kRail + "wheelset.y_mm = nan\n", "must be finite"},
        Wrong{kRail + "wheelset.y_mm = inf\n", "must be finite"},
        Wrong{kRail + "wheelset.y_mm = 2026-01-01\n", "dates"},
        Wrong{kRail + "discretisation.max_elements = 1e4\n", "must be an integer, found a number"},
        Wrong{kRail + "discretisation.reference_search_mesh = 1\n", "must be true or false"},
        Wrong{kRail + "case.side = 1\n", "must be one word"},
        Wrong{kRail + "case.side = \"middle\"\n", "case.side = \"middle\" is not one of \"left\", \"right\""},
        Wrong{kRail + "track.cant = \"40\"\n", "does not look like \"1:40\""},
        Wrong{kRail + "track.cant = \"1:0\"\n", "between 1:1 and flat"},
        Wrong{kRail + "wheel.backend = \"Bad Name\"\n", "does not look like \"mesh-flat\": small letters"},
        Wrong{kRail + "wheel.flats = 3\n", "must be a list of tables"},
        Wrong{kRail + "wheel.flats = [3]\n", "found an integer in it"}, Wrong{kRail + "y_mm = [1\n", "not valid TOML"},
        Wrong{kHertz + "gap.coefficients_si = [1, \"a\"]\n", "found text in it"}));

INSTANTIATE_TEST_SUITE_P(
    Ranges, TomlError,
    ::testing::Values(Wrong{kRail + "discretisation.dx_mm = 0\n",
                            "folder/study.toml:4:24: discretisation.dx_mm = 0 must be greater than 0"},
                      Wrong{kRail + "discretisation.max_elements = 5\n", "must be at least 100"},
                      Wrong{kRail + "material.poisson_ratio = 0.6\n", "must be at most 0.5"},
                      Wrong{kRail + "friction.coefficient = 0\n", "must be at least 0.0001"},
                      Wrong{kRail + "track.cant_deg = 60\n", "at most 45"},
                      Wrong{kRail + "track.cant_rad = 1\n", "must be at most"},
                      Wrong{kRail + "wheel.flats = [ { length_mm = -1 } ]\n",
                            "length_mm = -1 must be greater than 0"}));

INSTANTIATE_TEST_SUITE_P(
    Consistency, TomlError,
    ::testing::Values(
        Wrong{kRail + "wheelset.z_mm = 1\n", "wheelset.vertical_force_N and wheelset.z_mm exclude each other"},
        Wrong{kRail + "wheelset.roll_deg = 1\nwheelset.roll_rad = 1\n", "exclude each other"},
        Wrong{kRail + "track.gauge_mm = 1435\ntrack.rail_y_mm = 750\n", "exclude each other"},
        Wrong{kRail + "track.cant = \"1:40\"\ntrack.cant_deg = 1\n", "exclude each other"},
        Wrong{kRail + "rail.shape.file = \"a.prr\"\n", "rail.shape.standard and rail.shape.file exclude each other"},
        Wrong{kRail + "rail.shape.scale_to_mm = 1\n", "belongs to a shape given by a file"},
        Wrong{kRail + "rail.shape.start_y_mm = 1\n", "belongs to a shape given by arcs"},
        Wrong{"rail.shape.file = \"a.prr\"\nrail.shape.smoothing_method = \"weighted_spline\"\n",
              "needs smoothing_wavelength_mm"},
        Wrong{"rail.shape.file = \"a.prr\"\nrail.shape.smoothing = \"some\"\n",
              "is not one of a number, \"auto\", \"none\""},
        Wrong{"rail.shape.file = \"a.prr\"\nrail.shape.smoothing = -1\n", "must be at least 0"},
        Wrong{"rail.shape.file = \"a.prr\"\nrail.shape.smoothing = \"auto\"\nrail.shape.smoothing_lambda_mm3 = 1\n",
              "exclude each other"},
        Wrong{"rail.shape.file = \"a.prr\"\nrail.shape.smoothing_lambda_mm3 = 1\nrail.shape.smoothing_wavelength_mm = "
              "1\n",
              "exclude each other"},
        Wrong{"wheel.shape.standard = \"S1002\"\nwheelset.vertical_force_N = 1\n", "rail.shape is missing"},
        Wrong{"rail.shape.standard = \"60E1\"\nwheelset.vertical_force_N = 1\n", "wheel.shape is missing"},
        Wrong{"rail.shape.arcs = []\nwheel.shape.standard = \"S1002\"\nwheelset.z_mm = 1\n",
              "rail.shape.arcs is empty"},
        Wrong{"rail.shape.arcs = [ { radius_mm = 3 } ]\n", "length_mm of rail.shape.arcs is missing"},
        Wrong{"rail.shape.arcs = [ { length_mm = 3, radius_mm = 0 } ]\n", "radius_mm must not be 0"},
        Wrong{"rail.shape.arcs = [ { length_mm = 3, radius_mm = 1, curvature_per_m = 1 } ]\n", "exclude each other"},
        Wrong{"rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\n", "the vertical load is missing"},
        Wrong{kRail + "wheel.flats = [ { length_mm = 30 } ]\n", "a rounded flat needs depth_mm"},
        Wrong{kRail + "wheel.flats = [ { depth_mm = 3 } ]\n", "length_mm of wheel.flats is missing"},
        Wrong{kRail + "material.relaxation_time_s = 1\nmaterial.creep_ratio = 1\ncase.regime = \"shift\"\n",
              "viscoelastic bodies need steady rolling"},
        Wrong{kRail + "influence.kind = \"angle_corrected\"\n", "need the curved reference of conformal contact"},
        Wrong{kRail + "friction.amplitude_1 = 0.1\n", "belong to a falling law"},
        Wrong{kRail + "friction.law = \"linear\"\nfriction.amplitude_1 = 0.1\n",
              "half_velocity_1_m_s must be positive"},
        Wrong{kRail + "discretisation.separation_mm = 3\n", "must not be less than combination_mm"},
        Wrong{kRail + "[[cases]]\nwheelset.y_mm = [1, 2]\nwheelset.pitch_deg = [1]\n",
              "another one of the same entry has"},
        Wrong{kRail + "[[cases]]\nwheelset.y_mm = []\n", "is empty"},
        Wrong{kRail + "[[cases]]\npatch.mx = 3\n", "patch.mx belongs to a [patch] case"},
        Wrong{kRail + "[[cases]]\nwheelset.y_mm = [1, \"b\"]\n", "must be a number, found text"},
        Wrong{kHertz + "[wheelset]\ny_mm = 1\n", "wheelset.y_mm belongs to a wheel-rail case"}));

INSTANTIATE_TEST_SUITE_P(
    Patches, TomlError,
    ::testing::Values(
        Wrong{kBarePatch + "hertz.given = \"semi_axes\"\n", "patch.hertz.semi_axis_x_mm is missing"},
        Wrong{kBarePatch + "hertz.given = \"curvature_and_ratio\"\nhertz.curvature_x_per_m = 1\n",
              "patch.hertz.axis_ratio is missing"},
        Wrong{kBarePatch, "patch.dx_mm and patch.dy_mm are missing"},
        Wrong{"[patch]\nnormal_force_N = 1\n", "patch.mx and patch.my are missing"},
        Wrong{kBarePatch + "dx_mm = 1\ndy_mm = 1\ngap.coefficients_si = [1]\n", "a quadratic gap needs 6"},
        Wrong{kBarePatch + "dx_mm = 1\ndy_mm = 1\ngap.kind = \"per_element\"\ngap.coefficients_si = [1]\n",
              "1 values for 80 elements"},
        Wrong{kBarePatch + "dx_mm = 1\ndy_mm = 1\ngap.kind = \"circular\"\ngap.coefficients_si = [0, 0, 0, 1, 0]\n",
              "must not be 0"},
        Wrong{kHertz + "[case]\nregime = \"steady\"\n", "patch.rolling_step_mm is missing"},
        Wrong{kHertz + "force_y_relative = 0.1\n", "needs patch.force_x_relative"},
        Wrong{kHertz + "force_x_relative = 0.1\ncreepage_x = 0.1\n", "exclude each other"},
        Wrong{kHertz + "approach_mm = 0.1\n", "exclude each other"},
        Wrong{"[patch]\nmx = 2\nmy = 2\nhertz.given = \"curvatures\"\nhertz.curvature_x_per_m = "
              "1\nhertz.curvature_y_per_m = 1\n",
              "the normal load is missing"},
        Wrong{"[patch]\nnormal_force_N = 1\nmx = 3000\nmy = 3000\nhertz.given = "
              "\"curvatures\"\nhertz.curvature_x_per_m = 1\n",
              "potential contact too large"},
        Wrong{kBarePatch + "dx_mm = 1\ndy_mm = 1\nnormal_model = \"elliptic\"\ngap.coefficients_si = [1,0,1,0,0,0]\n",
              "elliptic and parabolic pressures need Hertzian geometry"}));

TEST(TomlOverrideError, NamesTheOverride) {
  EXPECT_THAT(
      study_refusal(kRail, {"wheelset.y=3"}),
      ::testing::HasSubstr("override 'wheelset.y=3': unknown key 'wheelset.y' (did you mean 'wheelset.y_mm'?)"));
  EXPECT_THAT(study_refusal(kRail, {"wheelset.y_mm"}), ::testing::HasSubstr("'=' is missing"));
  EXPECT_THAT(study_refusal(kRail, {"=3"}), ::testing::HasSubstr("key or value is missing"));
  EXPECT_THAT(study_refusal(kRail, {"wheelset.y_mm="}), ::testing::HasSubstr("key or value is missing"));
  EXPECT_THAT(study_refusal(kRail, {"wheelset.yaw_rad=5"}), ::testing::HasSubstr("wheelset.yaw_rad = 5"));
  EXPECT_EQ(study_refusal(kRail, {"wheelset.yaw_deg=-5"}), "no error");
  EXPECT_THAT(study_refusal(kRail, {"wheelset.y_mm=three"}), ::testing::HasSubstr("must be a number, found text"));
  EXPECT_THAT(study_refusal(kRail, {"wheelset.y_mm=[1"}), ::testing::HasSubstr("neither a word nor valid TOML"));
  EXPECT_THAT(study_refusal(kRail, {"wheelset.y_mm=3\n[x]"}), ::testing::HasSubstr("one line"));
  EXPECT_THAT(study_refusal(kRail, {"wheel.flats.0.depth_mm=1"}), ::testing::HasSubstr("wheel.flats has 0 entries"));
  EXPECT_THAT(study_refusal(kRail, {"rail.shape.arcs.0.length_mm=1"}),
              ::testing::HasSubstr("rail.shape.arcs has 0 entries"));
  EXPECT_THAT(study_refusal(kRail, {"wheel.flats.depth_mm=1"}), ::testing::HasSubstr("wheel.flats is a list"));
  EXPECT_THAT(study_refusal(kRail, {"wheel.flats.0=1"}), ::testing::HasSubstr("wheel.flats is a list"));
  EXPECT_THAT(study_refusal(kRail, {"patch.mx=3"}), ::testing::HasSubstr("belongs to a [patch] case"));
}

}  // namespace
}  // namespace treadmark::io
