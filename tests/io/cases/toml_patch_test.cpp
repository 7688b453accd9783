// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/tests/io/cases/parsed_cases.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kGap =
    "[patch]\napproach_mm = 0.01\nmx = 3\nmy = 2\ndx_mm = 1\ndy_mm = 1\nrolling_step_mm = 1\nvelocity_m_s = 30\n"
    "gap.coefficients_si = [1, 0, 1, 0, 0, 0]\n";
const std::string kSteady = "case.regime = \"steady\"\n";

BasicCase one_patch(const std::string& text) { return basic_case(parse_study(text), 0); }
std::string patch_refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_study(text, overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_FALSE(error.where().file.empty());
    return error.what();
  }
  return "no error";
}

TEST(TomlPatch, HistoryAndSequences) {
  const CaseFile f =
      parse_study("case.history = \"continue\"\ncase.element_table = \"all\"\n" + kGap +
                  "[[cases]]\ncase.regime = \"shift\"\npatch.shift_x_mm = [0.1, 0.2]\n[[cases]]\ncase.sequence = 4\n"
                  "[[cases]]\ncase.sequence = 4\ncase.history = \"same_instant\"\ncase.element_table = \"contact\"\n"
                  "[[cases]]\ncase.history = \"normal_only\"\n[[cases]]\ncase.history = \"start\"\n");
  using H = HistoryUse;
  const std::vector<H> history{H::start,        H::keep_going,  H::start,
                               H::same_instant, H::normal_only, H::start};  // the first of each starts
  const std::vector<int> sequence{0, 0, 4, 4, 0, 0}, table{2, 2, 2, 1, 2, 2};
  ASSERT_EQ(f.cases.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(basic_case(f, i).history, history[i]) << i;
    EXPECT_EQ(f.cases[i].sequence, sequence[i]) << i;
    EXPECT_EQ(f.cases[i].element_table, table[i]) << i;
  }
  EXPECT_EQ(basic_case(parse_study(kGap + "[[cases]]\n[[cases]]\n", {"case.history=continue"}), 1).history,
            H::keep_going);
  EXPECT_EQ(one_patch(kGap).history, H::start);
}

TEST(TomlPatch, TransientRolling) {
  const BasicCase c = one_patch("case.regime = \"transient\"\n" + kGap + "rolling_direction_deg = 30\n");
  EXPECT_EQ(c.regime, Regime::transient);
  EXPECT_DOUBLE_EQ(c.chi, 30 * kDegree);
}

TEST(TomlPatch, Material) {
  const Material m =
      one_patch(
          kGap +
          "[material]\nlayer_flexibility_mm_per_MPa = 1e-4\nlayer_yield_MPa = 30\nlayer_hardening_MPa_per_mm = -7\n"
          "sheet_flexibility_mm_per_MPa = 2e-5\ncreep_ratio = 1.5\nwheel_creep_ratio = 2.5\nrelaxation_time_s = 0.01\n"
          "rail_relaxation_time_s = 0.02\n")
          .material;
  EXPECT_DOUBLE_EQ(m.layer_flexibility, 1e-13);
  EXPECT_DOUBLE_EQ(m.layer_yield, 30e6);
  EXPECT_DOUBLE_EQ(m.layer_hardening, -7e9);
  EXPECT_DOUBLE_EQ(m.sheet_flexibility, 2e-14);
  EXPECT_DOUBLE_EQ(m.creep_ratio_1, 1.5);
  EXPECT_DOUBLE_EQ(m.creep_ratio_2, 2.5);
  EXPECT_DOUBLE_EQ(m.relaxation_time_1, 0.02);
  EXPECT_DOUBLE_EQ(m.relaxation_time_2, 0.01);
}

TEST(TomlPatch, Influence) {
  using Kind = InfluenceInput::Kind;
  const InfluenceInput angle =
      one_patch(kGap +
                "[influence]\nkind = \"angle_corrected\"\nposition_mm = [-1, 1]\ninclination_deg = [2, 3]\n"
                "inclination_fit = \"table\"\nvariant = 2\n")
          .influence;
  EXPECT_EQ(angle.kind, Kind::angle_corrected);
  EXPECT_THAT(angle.position, ElementsAre(-1e-3, 1e-3));
  EXPECT_THAT(angle.inclination, ElementsAre(DoubleEq(2 * kDegree), DoubleEq(3 * kDegree)));
  EXPECT_FALSE(angle.linear);
  EXPECT_EQ(angle.variant, 2);
  const InfluenceInput table = one_patch(kGap + "[influence]\nkind = \"table\"\nfile = \"sub/a.cff\"\n").influence;
  EXPECT_EQ(table.kind, Kind::table);
  EXPECT_EQ(table.file, "folder/sub/a.cff");
  EXPECT_EQ(one_patch(kGap + "[influence]\nkind = \"bilinear\"\n").influence.kind, Kind::bilinear);
}

TEST(TomlPatch, ModelsAndSolver) {
  const BasicCase c =
      one_patch(kSteady + kGap +
                "normal_model = \"kpec\"\ntangential_model = \"fastsim_one_flexibility\"\n"
                "fastsim_flexibility_mm_per_MPa = 3e-5\n[solver]\nmethod = \"sweeps\"\nfirst_slip = \"above\"\n");
  EXPECT_EQ(c.normal_model, NormalModel::kpec);
  EXPECT_EQ(c.tangential_model, TangentialModel::fastsim_one_flexibility);
  EXPECT_DOUBLE_EQ(c.fastsim.flexibility, 3e-14);
  EXPECT_EQ(c.solver.method, SolverSettings::Method::sweeps);
  EXPECT_EQ(c.solver.first_slip, SolverSettings::FirstSlip::above);
  const BasicCase sdec = one_patch(
      "[patch]\nnormal_force_N = 1e3\nmx = 3\nmy = 2\nnormal_model = \"semi_double_elliptic\"\n"
      "hertz = { given = \"semi_double_elliptic\", semi_axis_x_mm = 8, semi_axis_y_negative_mm = 3, "
      "semi_axis_y_positive_mm = 5 }\n");
  const HertzInput& h = std::get<HertzInput>(sdec.geometry);
  EXPECT_DOUBLE_EQ(h.bb_negative, 3e-3);
  EXPECT_DOUBLE_EQ(h.bb_positive, 5e-3);
  EXPECT_DOUBLE_EQ(h.bb, 4e-3);
}

TEST(TomlPatch, HeatAndFriction) {
  const std::string law =
      "[friction]\nlaw = \"temperature\"\ncoefficient = 0.4\nreference_temperature_C = 20\ntemperature_change = -0.2\n"
      "temperature_range_K = 500\n";
  const BasicCase c =
      one_patch(kSteady + kGap + law +
                "[heat]\nwheel_bulk_temperature_C = 150\nrail_conductivity_W_per_m_K = 40\nplastic_fraction = 0.9\n");
  ASSERT_TRUE(c.thermal);
  EXPECT_DOUBLE_EQ(c.thermal->body_2.bulk_temperature, 150.0);
  EXPECT_DOUBLE_EQ(c.thermal->body_1.conductivity, 40.0);
  EXPECT_DOUBLE_EQ(c.thermal->body_2.conductivity, 50.0);
  EXPECT_DOUBLE_EQ(c.thermal->plastic_fraction, 0.9);
  EXPECT_EQ(c.friction.kind, FrictionLaw::Kind::temperature);
  EXPECT_DOUBLE_EQ(c.friction.temperature_range, 500.0);
  EXPECT_TRUE(one_patch(kSteady + kGap + "[heat]\ncompute = true\n").thermal);
  const CaseFile f =
      parse_study(kSteady + kGap + "[heat]\nrail_bulk_temperature_C = 1\n[[cases]]\nheat.compute = false\n[[cases]]\n");
  EXPECT_FALSE(basic_case(f, 0).thermal);
  EXPECT_TRUE(basic_case(f, 1).thermal);
  EXPECT_FALSE(one_patch(kGap).thermal);
}

TEST(TomlPatch, FrictionOfRows) {
  const std::string rows =
      "[friction]\nrows = [{ coefficient = 0.2 }, { law = \"linear\", coefficient = 0.1, amplitude_1 = 0.3, "
      "half_velocity_1_m_s = 2 }]\n";
  const CaseFile f = parse_study(kGap + rows, {"friction.rows.0.coefficient=0.25"});
  ASSERT_EQ(basic_case(f, 0).friction_of_row.size(), 2u);
  EXPECT_DOUBLE_EQ(basic_case(f, 0).friction_of_row[0].kinetic, 0.25);
  EXPECT_EQ(basic_case(f, 0).friction_of_row[1].kind, FrictionLaw::Kind::linear);
  EXPECT_DOUBLE_EQ(basic_case(f, 0).friction_of_row[1].half_velocity_1, 2.0);
}

TEST(TomlPatch, ExtraSlipPlanformAndSubsurface) {
  EXPECT_THAT(one_patch(kGap + "extra_slip_x = [1, 2, 3, 4, 5, 6]\nextra_slip_y = [0, 0, 0, 0, 0, 7]\n").extra_slip_y,
              ElementsAre(0, 0, 0, 0, 0, 7));
  EXPECT_DOUBLE_EQ(one_patch(kGap + "extra_shift_x_mm = [1, 2, 3, 4, 5, 6]\nextra_shift_y_mm = [0, 0, 0, 0, 0, 7]\n")
                       .extra_slip_x.at(1),
                   2e-3);

  const PlanformInput sub =
      one_patch(kGap +
                "[patch.planform]\nkind = \"sub_patches\"\nrectangles_mm = [0, 1, 0, 1, 0, 1, 2, 3, 0, 1, 4, 5]\n"
                "coupling = [0.1, 0.2, 0.3]\n")
          .planform;
  EXPECT_DOUBLE_EQ(sub.coefficients.at(7), 3e-3);
  EXPECT_THAT(sub.coupling, ElementsAre(1.0, 0.1, 0.2, 0.1, 1.0, 0.3, 0.2, 0.3, 1.0));
  EXPECT_THAT(one_patch(kGap + "planform = { kind = \"quadratic\", coefficients_si = [1, 2, 3, 4, 5, 6] }\n")
                  .planform.coefficients,
              ElementsAre(1, 2, 3, 4, 5, 6));

  const CaseFile f =
      parse_study(kGap +
                  "[subsurface]\ntext_table = \"tensor\"\n[[subsurface.blocks]]\nz_mm = [0.0, 0.5]\ncolumns = [0, 2]\n"
                  "[[subsurface.blocks]]\nx_mm = [1]\ny_mm = [-1, 1]\nz_mm = [-2]\n");
  const SubsurfaceInput& s = basic_case(f, 0).subsurface;
  ASSERT_EQ(s.blocks.size(), 2u);
  EXPECT_TRUE(s.text_table && s.full_tensor);
  EXPECT_TRUE(s.blocks[0].at_elements);
  EXPECT_THAT(s.blocks[0].columns, ElementsAre(0, 2));
  EXPECT_THAT(s.blocks[0].rows, IsEmpty());
  EXPECT_THAT(s.blocks[0].z, ElementsAre(0.0, 0.5e-3));
  EXPECT_FALSE(s.blocks[1].at_elements);
  EXPECT_THAT(s.blocks[1].y, ElementsAre(-1e-3, 1e-3));
  EXPECT_THAT(s.blocks[1].z, ElementsAre(-2e-3));
}

TEST(TomlWheelRail, ApproximationsAndFrictionThatVaries) {
  const auto rail = [](const CaseFile& f, std::size_t i) { return std::get<WheelRailCase>(f.cases.at(i).content); };
  const CaseFile f = parse_study(
      kRail +
      "influence.kind = \"bilinear\"\n[solver]\nnormal_model = \"analyn\"\ntangential_model = "
      "\"fastsim\"\nfastsim_k0 = 0.5\n"
      "[friction]\nby_inclination = [{ inclination_deg = -20, coefficient = 0.2 }, { inclination_rad = 0.1, "
      "coefficient = 0.3 }]\n"
      "[[cases]]\n[[cases]]\nfriction.along_track = [{ s_mm = 5, coefficient = 0.4, law = \"exponential\" }]\n"
      "[[cases]]\nfriction.along_track = []\n");
  EXPECT_EQ(rail(f, 0).normal_model, NormalModel::analyn);
  EXPECT_EQ(rail(f, 0).tangential_model, TangentialModel::fastsim);
  EXPECT_DOUBLE_EQ(rail(f, 0).fastsim.k0, 0.5);
  EXPECT_EQ(rail(f, 0).influence.kind, InfluenceInput::Kind::bilinear);
  using Kind = FrictionVariation::Kind;
  EXPECT_EQ(rail(f, 0).friction_variation.kind, Kind::inclination);
  EXPECT_THAT(rail(f, 0).friction_variation.positions, ElementsAre(DoubleEq(-20 * kDegree), 0.1));
  EXPECT_DOUBLE_EQ(rail(f, 0).friction_variation.laws.at(1).kinetic, 0.3);
  EXPECT_DOUBLE_EQ(rail(f, 0).friction.kinetic, 0.2);
  EXPECT_EQ(rail(f, 1).friction_variation.kind, Kind::along_track);
  EXPECT_THAT(rail(f, 1).friction_variation.positions, ElementsAre(5e-3));
  EXPECT_EQ(rail(f, 1).friction.kind, FrictionLaw::Kind::exponential);
  EXPECT_EQ(rail(f, 2).friction_variation.kind, Kind::none);
  const std::string sets =
      kRail + "friction.along_track = [{ s_mm = 5, coefficient = 0.4 }, { s_mm = 6, coefficient = 0.5 }]\n";
  EXPECT_DOUBLE_EQ(rail(parse_study(sets, {"friction.along_track.1.s_mm=9"}), 0).friction_variation.positions.at(1),
                   9e-3);
  EXPECT_THAT(patch_refusal(sets, {"friction.by_inclination.0.coefficient=0.3"}),
              HasSubstr("friction.by_inclination has 0 entries"));
}

class TomlPatchError : public ::testing::TestWithParam<Wrong> {};
TEST_P(TomlPatchError, TellsTheReason) { EXPECT_THAT(patch_refusal(GetParam().text), HasSubstr(GetParam().expected)); }

const std::string kForce =
    "[patch]\nnormal_force_N = 1e3\nmx = 3\nmy = 2\ndx_mm = 1\ndy_mm = 1\ngap.coefficients_si = [1, 0, 1, 0, 0, 0]\n";
INSTANTIATE_TEST_SUITE_P(
    Combinations, TomlPatchError,
    ::testing::Values(
        Wrong{kForce + "normal_model = \"kpec\"\n", "case 1: KPEC needs a prescribed approach"},
        Wrong{kSteady + kGap + "rolling_direction_deg = 45\n", "steady rolling in direction 0.785398 rad"},
        Wrong{"case.regime = \"transient\"\n" + kForce, "patch.rolling_step_mm is missing"},
        Wrong{kSteady + kGap + "tangential_model = \"fastsim_one_flexibility\"\n",
              "FASTSIM with one flexibility needs that flexibility"},
        Wrong{"case.regime = \"shift\"\n" + kGap + "tangential_model = \"fastrip\"\n",
              "not for a shift or transient rolling"},
        Wrong{kSteady + kGap + "tangential_model = \"fastsim\"\n[material]\nlayer_yield_MPa = 3\n",
              "the simplified theory knows no plasticity"},
        Wrong{kSteady + kGap + "[material]\ncreep_ratio = 1\nrail_shear_modulus_GPa = 26\n", "must not be dissimilar"},
        Wrong{"case.regime = \"transient\"\n" + kGap + "[material]\ncreep_ratio = 1\n",
              "viscoelastic bodies need steady rolling"},
        Wrong{kGap + "[material]\nrelaxation_time_s = -1\n", "must be at least 0"},
        Wrong{kGap + "[heat]\nrail_bulk_temperature_C = 1\n", "surface temperatures need steady rolling"},
        Wrong{kSteady + kGap + "[friction]\nlaw = \"temperature\"\n", "needs the thermal data of the bodies"},
        Wrong{kGap + "[friction]\nrows = [{ coefficient = 0.2 }]\n", "friction is given for 1 rows, but there are 2"},
        Wrong{kGap + "[friction]\nrows = [{ amplitude_1 = 0.2 }]\n", "coefficient of friction.rows is missing"},
        Wrong{kGap + "extra_slip_x = [1]\n", "the extra rigid slip has 1 values in x and 0 in y for 6 elements"},
        Wrong{kGap + "extra_slip_x = [1]\nextra_shift_x_mm = [1]\n", "exclude each other"},
        Wrong{kGap + "[influence]\nkind = \"angle_corrected\"\n", "have 0 positions and 0 inclinations"},
        Wrong{kGap + "[influence]\nkind = \"angle_corrected\"\nposition_mm = [1, 1]\ninclination_rad = [0, 0]\n",
              "the positions of surface inclinations must increase"},
        Wrong{kGap + "[influence]\nkind = \"table\"\n", "the file of influence coefficients is missing"},
        Wrong{kGap + "planform = { kind = \"quadratic\", coefficients_si = [1] }\n",
              "a quadratic planform has 1 coefficients"},
        Wrong{kGap + "planform = { kind = \"two_rectangles\", rectangles_mm = [0, 1, 0, 1] }\n",
              "the rectangles of the planform have 4 values"},
        Wrong{kGap + "planform = { kind = \"sub_patches\", rectangles_mm = [0, 1, 0, 1, 0, 1, 2, 3] }\n",
              "2 sub-patches need 1 coupling factors"},
        Wrong{kGap + "planform = { kind = \"sub_patches\", rectangles_mm = [0, 1, 1, 0], coupling = [] }\n",
              "has no extent"},
        Wrong{kForce + "planform.coupling = [1.5]\n", "must be at most 1"},
        Wrong{"[patch]\nnormal_force_N = 1\nmx = 3\nmy = 2\nhertz = { given = \"semi_double_elliptic\", semi_axis_x_mm "
              "= 8 }\n",
              "semi_axis_y_negative_mm is missing"},
        Wrong{"[patch]\nnormal_force_N = 1\nmx = 3\nmy = 2\nhertz = { given = \"semi_axes\", semi_axis_x_mm = 8, "
              "semi_axis_y_mm = 1 }\nplanform.kind = \"quadratic\"\n",
              "a restricted planform and Hertzian geometry exclude each other"},
        Wrong{kGap + "[[subsurface.blocks]]\nz_mm = [1]\nrows = [2]\n",
              "subsurface points lie outside the 3 x 2 elements"},
        Wrong{kGap + "[[subsurface.blocks]]\nz_mm = [1]\nrows = [0.5]\n", "rows must be a list of integers"},
        Wrong{kGap + "[[subsurface.blocks]]\nz_mm = [1]\nrows = [0]\nx_mm = [0]\n", "exclude each other"},
        Wrong{kGap + "[[subsurface.blocks]]\nz_mm = [1]\nx_mm = [0]\n", "a block of subsurface points is empty"},
        Wrong{kGap + "[[subsurface.blocks]]\nx_mm = [0]\n", "z_mm of subsurface.blocks is missing"}));

INSTANTIATE_TEST_SUITE_P(
    WheelRail, TomlPatchError,
    ::testing::Values(
        Wrong{kRail + "influence.position_mm = [1]\n", "belongs to a [patch] case"},
        Wrong{kRail + "influence.kind = \"table\"\n",
              "numerical influence coefficients are not supported for a wheel on a rail"},
        Wrong{kRail + "friction.law = \"temperature\"\n", "needs the thermal data of the bodies"},
        Wrong{kGap + "[roller]\nnominal_radius_mm = 500\n", "belongs to a wheel-rail case"},
        Wrong{kRail + "roller.pitch_rate_rad_s = 3\n", "the nominal radius of the roller is missing"},
        Wrong{kRail + "wheelset.vpitch_rad_s = -4\nwheelset.longitudinal_force_N = 3\n", "exclude each other"},
        Wrong{kRail + "wheelset.longitudinal_force_N = 3\ncase.regime = \"none\"\n",
              "a prescribed longitudinal force needs friction"},
        Wrong{kRail + "track.springs.stiffness_y_N_per_mm = 0\n", "must be greater than 0"},
        Wrong{kRail + "damping.normal_s = -1\n", "must be at least 0"},
        Wrong{kRail + "damping.tangential_s = 1\n", "damping.max_rate_tangential_N_per_s is missing"},
        Wrong{kRail + "contact.reference_surface = \"conformal\"\n",
              "is not one of \"plane\", \"plane_surface_slip\", \"curved\""},
        Wrong{kRail + "contact.reference_surface = \"curved\"\nsolver.tangential_model = \"fastsim\"\n",
              "the simplified theory takes one creepage for a patch"},
        Wrong{kRail + "contact.reference_surface = \"plane_surface_slip\"\nsolver.tangential_model = \"fastrip\"\n",
              "the simplified theory takes one creepage for a patch"},
        Wrong{kRail + "[[subsurface.blocks]]\nz_mm = [1]\nx_mm = [0]\n", "a block of subsurface points is empty"},
        Wrong{kRail + "discretisation.max_elements = 1000000\n[[subsurface.blocks]]\nz_mm = [1, 2, 3, 4, 5, 6, 7, 8, "
                      "9, 10, 11, 12, 13, 14, 15, "
                      "16, 17, 18, 19, 20, 21]\n",
              "21000000 subsurface points are more than 20000000"},
        Wrong{kRail + "solver.tangential_model = \"fastsim_one_flexibility\"\n",
              "solver.fastsim_flexibility_mm_per_MPa is missing"},
        Wrong{kGap + "[solver]\ntangential_model = \"fastsim\"\n", "belongs to a wheel-rail case"},
        Wrong{kRail + "friction.along_track = [{ s_mm = 5, coefficient = 0.4 }, { s_mm = 5, coefficient = 0.4 }]\n",
              "the positions of friction sets must increase"},
        Wrong{kRail + "friction.along_track = [{ s_mm = 5, coefficient = 0.4 }, { s_mm = 6, coefficient = 0.4, law = "
                      "\"linear\" }]\n",
              "must have the same law"},
        Wrong{kRail + "friction.along_track = [{ coefficient = 0.4 }]\n", "s_mm of friction.along_track is missing"},
        Wrong{kRail + "friction.along_track = []\nfriction.by_inclination = []\n", "exclude each other"}));

}  // namespace
}  // namespace treadmark::io
