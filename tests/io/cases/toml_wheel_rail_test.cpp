// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "treadmark/tests/io/cases/parsed_cases.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

WheelRailCase one_rail(const std::string& text) { return rail_case(parse_study(kRail + text), 0); }

TEST(TomlElements, AreChosenUnlessTheyAreGiven) {
  const auto chosen = [](const WheelRailCase& c) {
    return std::pair(c.discretisation.choose_dx, c.discretisation.choose_ds);
  };
  EXPECT_EQ(chosen(one_rail("")), std::pair(true, true));
  const WheelRailCase along = one_rail("discretisation.dx_mm = 0.2\n");
  EXPECT_EQ(chosen(along), std::pair(false, true));
  EXPECT_DOUBLE_EQ(along.discretisation.dx, 0.2e-3);
  EXPECT_EQ(chosen(one_rail("discretisation = { dx_mm = \"auto\", ds_mm = 1 }\n")), std::pair(true, false));
  const std::string given = kRail + "discretisation = { dx_mm = 1, ds_mm = 1 }\n";
  const WheelRailCase back = rail_case(parse_study(given, {"discretisation.dx_mm=auto"}), 0);
  EXPECT_EQ(chosen(back), std::pair(true, false));
  EXPECT_DOUBLE_EQ(back.discretisation.dx, ElementGrid{}.dx) << "for what shares a raster";
  EXPECT_EQ(chosen(rail_case(parse_study(kRail, {"discretisation.ds_mm=0.3"}), 0)), std::pair(true, false));
  EXPECT_THAT(study_refusal(kRail + "discretisation.dx_mm = \"automatic\"\n"),
              HasSubstr("is not one of a number, \"auto\""));
}

TEST(TomlElements, ShareARasterInTime) {
  const auto chosen = [](const std::string& text, std::size_t i) {
    const DiscretisationInput d =
        rail_case(parse_study(kRail + "wheelset.velocity_m_s = 1\n" + text), i).discretisation;
    EXPECT_EQ(d.choose_dx, d.choose_ds);
    return d.choose_dx;
  };
  EXPECT_FALSE(chosen("case.regime = \"transient\"\n", 0));
  EXPECT_FALSE(chosen("case.regime = \"shift\"\n", 0));
  const std::string damped = "[damping]\nnormal_s = 1e-4\nmax_rate_normal_N_per_s = 3e6\n";
  EXPECT_FALSE(chosen(damped, 0));
  // What a later instant goes on from has its elements; what stands alone, its own.
  const std::string sequence =
      "[[cases]]\n[[cases]]\n[[cases]]\ncase.regime = \"transient\"\ncase.history = \"continue\"\n";
  EXPECT_TRUE(chosen(sequence, 0));
  EXPECT_FALSE(chosen(sequence, 1));
  EXPECT_FALSE(chosen(sequence, 2));
}

TEST(TomlBalance, RollerSpringsForceAndDamping) {
  const WheelRailCase c = one_rail(R"(
roller = { nominal_radius_mm = -900, pitch_rate_rad_s = 12 }
wheelset.longitudinal_force_N = -5e3
contact.reference_surface = "plane_surface_slip"
[track.springs]
stiffness_y_N_per_mm = 100
stiffness_z_N_per_mm = 0
force_y_N = -2e3
force_z_N = 3e3
first_step_y_mm = 0.2
[damping]
normal_s = 1e-4
tangential_s = 2e-4
max_rate_normal_N_per_s = 3e6
max_rate_tangential_N_per_s = 4e6
)");
  EXPECT_DOUBLE_EQ(c.roller.value().nominal_radius, -0.9);
  EXPECT_DOUBLE_EQ(c.roller.value().pitch_rate, 12.0);
  EXPECT_EQ(c.longitudinal_force, std::optional(-5e3));
  EXPECT_EQ(c.reference_surface, ReferenceSurface::plane_surface_slip);
  const RailSprings s = c.rail_springs.value();
  EXPECT_DOUBLE_EQ(s.stiffness_y, 1e5);
  EXPECT_DOUBLE_EQ(s.stiffness_z, 0.0);
  EXPECT_DOUBLE_EQ(s.force_y, -2e3);
  EXPECT_DOUBLE_EQ(s.force_z, 3e3);
  EXPECT_DOUBLE_EQ(s.first_step_y, 0.2e-3);
  const Damping d = c.damping.value();
  EXPECT_DOUBLE_EQ(d.normal, 1e-4);
  EXPECT_DOUBLE_EQ(d.tangential, 2e-4);
  EXPECT_DOUBLE_EQ(d.max_rate_normal, 3e6);
  EXPECT_DOUBLE_EQ(d.max_rate_tangential, 4e6);
  const WheelRailCase plain = one_rail("");
  EXPECT_FALSE(plain.roller || plain.longitudinal_force || plain.rail_springs || plain.damping || plain.thermal);
}

TEST(TomlRolling, SpeedsMayBeGivenInKilometresAnHour) {
  EXPECT_DOUBLE_EQ(one_rail("wheelset.velocity_km_h = 72\n").state.velocity.x, 20.0);
  EXPECT_THAT(study_refusal(kRail + "wheelset.velocity_km_h = 72\nwheelset.velocity_m_s = 20\n"),
              HasSubstr("exclude each other"));
  // What comes later counts, whatever its unit.
  EXPECT_DOUBLE_EQ(
      rail_case(parse_study(kRail + "wheelset.velocity_m_s = 3\n[[cases]]\nwheelset.velocity_km_h = 36\n"), 0)
          .state.velocity.x,
      10.0);
}

TEST(TomlRolling, NominalFollowsVelocityAndRadius) {
  const std::string rolling =
      kRail + "wheelset.rolling = \"nominal\"\nwheelset.velocity_km_h = 72\nwheelset.nominal_radius_mm = 500\n";
  EXPECT_DOUBLE_EQ(rail_case(parse_study(rolling), 0).state.velocity.pitch, -40.0);
  const CaseFile swept =
      parse_study(rolling +
                  "[[cases]]\nwheelset.velocity_m_s = [5, -10]\n[[cases]]\nwheelset.nominal_radius_mm = "
                  "400\n[[cases]]\nwheelset.vpitch_rad_s = -1\n");
  EXPECT_DOUBLE_EQ(rail_case(swept, 0).state.velocity.pitch, -10.0);
  EXPECT_DOUBLE_EQ(rail_case(swept, 1).state.velocity.pitch, 20.0);
  EXPECT_DOUBLE_EQ(rail_case(swept, 2).state.velocity.pitch, -50.0);
  EXPECT_DOUBLE_EQ(rail_case(swept, 3).state.velocity.pitch, -1.0);
  EXPECT_DOUBLE_EQ(rail_case(parse_study(rolling, {"wheelset.velocity_m_s=1"}), 0).state.velocity.pitch, -2.0);
  // On a roller the surface of that counts.
  EXPECT_DOUBLE_EQ(rail_case(parse_study(rolling + "roller = { nominal_radius_mm = 1000, pitch_rate_rad_s = 3 }\n"), 0)
                       .state.velocity.pitch,
                   -6.0);
  EXPECT_THAT(study_refusal(rolling + "wheelset.vpitch_rad_s = -40\n"), HasSubstr("exclude each other"));
}

TEST(TomlRolling, FreeIsWithoutLongitudinalForce) {
  EXPECT_EQ(one_rail("wheelset.rolling = \"free\"\n").longitudinal_force, std::optional(0.0));
  EXPECT_EQ(
      rail_case(parse_study(kRail + "wheelset.rolling = \"free\"\n[[cases]]\nwheelset.rolling = \"nominal\"\n"), 0)
          .longitudinal_force,
      std::nullopt);
  EXPECT_THAT(study_refusal(kRail + "wheelset.rolling = \"freely\"\n"), HasSubstr("nominal"));
}

TEST(TomlBalance, CasesSwitchPartsOff) {
  const CaseFile f = parse_study(
      kRail +
      "wheelset.longitudinal_force_N = 3\nroller.nominal_radius_mm = 500\ntrack.springs.force_y_N = "
      "1\ndamping.normal_s = 1\ndamping.max_rate_normal_N_per_s = 9\n"
      "heat.rail_bulk_temperature_C = 5\n[[cases]]\n[[cases]]\nwheelset.vpitch_rad_s = -4\nroller.active = false\n"
      "track.springs.active = false\ndamping.active = false\nheat.compute = false\n[[cases]]\ndamping.tangential_s = "
      "2\ndamping.max_rate_tangential_N_per_s = 9\n");
  EXPECT_TRUE(rail_case(f, 0).longitudinal_force && rail_case(f, 0).roller && rail_case(f, 0).rail_springs &&
              rail_case(f, 0).damping && rail_case(f, 0).thermal);
  EXPECT_FALSE(rail_case(f, 1).longitudinal_force || rail_case(f, 1).roller || rail_case(f, 1).rail_springs ||
               rail_case(f, 1).damping || rail_case(f, 1).thermal);
  EXPECT_DOUBLE_EQ(rail_case(f, 1).state.velocity.pitch, -4.0);
  EXPECT_DOUBLE_EQ(rail_case(f, 2).damping.value().normal, 1.0);
  EXPECT_DOUBLE_EQ(rail_case(f, 2).damping.value().tangential, 2.0);
}

TEST(TomlWheelOnRail, SharesTheKeysOfPatches) {
  const CaseFile f = parse_study(kRail + R"(
case = { element_table = "all", sensitivities = true, sequence = 4 }
contact.reference_surface = "curved"
influence = { kind = "angle_corrected", variant = 2, inclination_fit = "table" }
material = { layer_yield_MPa = 30, layer_hardening_MPa_per_mm = 5, layer_flexibility_mm_per_MPa = 1e-4, sheet_flexibility_mm_per_MPa = 1e-5, wheel_shear_modulus_GPa = 80 }
heat = { wheel_density_kg_per_m3 = 7800, plastic_fraction = 0.5 }
friction = { law = "temperature", reference_temperature_C = 20, temperature_change = -0.1, temperature_range_K = 300 }
subsurface.text_table = "tensor"
[[subsurface.blocks]]
z_mm = [0.0, 0.5]
columns = [3, 90000]
)");
  EXPECT_EQ(f.cases[0].element_table, 2);
  EXPECT_EQ(f.cases[0].sequence, 4);
  const WheelRailCase& c = rail_case(f, 0);
  EXPECT_TRUE(c.sensitivities);
  EXPECT_EQ(c.influence.kind, InfluenceInput::Kind::angle_corrected);
  EXPECT_EQ(c.influence.variant, 2);
  EXPECT_FALSE(c.influence.linear);
  EXPECT_DOUBLE_EQ(c.material.layer_yield, 30e6);
  EXPECT_DOUBLE_EQ(c.material.layer_hardening, 5e9);
  EXPECT_DOUBLE_EQ(c.material.sheet_flexibility, 1e-14);
  EXPECT_DOUBLE_EQ(c.thermal.value().body_2.density, 7800.0);
  EXPECT_DOUBLE_EQ(c.thermal.value().plastic_fraction, 0.5);
  EXPECT_EQ(c.thermal.value().conventions, Conventions::treadmark);
  EXPECT_DOUBLE_EQ(c.friction.temperature_range, 300.0);
  EXPECT_TRUE(c.subsurface.full_tensor);
  EXPECT_EQ(c.subsurface.blocks.at(0).columns.at(1), 90000);
  EXPECT_DOUBLE_EQ(one_rail("material = { creep_ratio = 1, rail_relaxation_time_s = 0.2 }\n").material.creep_ratio_2,
                   1.0);
}

const std::string kRolling = R"(
rail.shape.standard = "60E1"
wheel.shape.standard = "S1002"
[wheelset]
vertical_force_N = 1e5
velocity_m_s = 2.0
vpitch_rad_s = -4.0
pitch_rad = 0.25
nominal_radius_mm = 500
vy_m_s = 0.01
deviation_vz_m_s = 0.02
[case]
regime = "transient"
history = "continue"
[track]
irregularity_vroll_rad_s = 0.5
[discretisation]
dx_mm = 0.4
[[cases]]
case.regime = "steady"
case.history = "start"
)";

TEST(TomlSteps, MoveOnByTheVelocities) {
  const CaseFile f =
      parse_study(kRolling + "[[cases]]\ncase.steps = 400\n[[cases]]\ncase.steps = 2\nwheelset.velocity_m_s = 1.0\n");
  ASSERT_EQ(f.cases.size(), 403u);
  EXPECT_DOUBLE_EQ(rail_case(f, 0).state.position.x, 0.0);
  EXPECT_EQ(rail_case(f, 0).history, HistoryUse::start);
  constexpr double kStep = 0.4e-3 / 2.0;
  for (std::size_t i = 1; i <= 400; ++i) {
    const double t = static_cast<double>(i) * kStep;
    EXPECT_NEAR(rail_case(f, i).state.position.x, 2.0 * t, 1e-12) << i;
    EXPECT_NEAR(rail_case(f, i).state.position.pitch, 0.25 - 4.0 * t, 1e-12) << i;
    EXPECT_NEAR(rail_case(f, i).state.position.y, 0.01 * t, 1e-12) << i;
    EXPECT_NEAR(rail_case(f, i).state.wheel_offset.z, 0.02 * t, 1e-12) << i;
    EXPECT_NEAR(rail_case(f, i).track.roll, 0.5 * t, 1e-12) << i;
    EXPECT_EQ(rail_case(f, i).history, HistoryUse::keep_going) << i;
    EXPECT_EQ(f.cases[i].number, static_cast<int>(i) + 1);
    EXPECT_EQ(f.cases[i].steps, 0);
  }
  EXPECT_NEAR(rail_case(f, 402).state.position.x, 402 * 0.4e-3, 1e-12);
  EXPECT_NEAR(rail_case(f, 402).state.position.pitch, 0.25 - 4.0 * (400 * kStep + 2 * 0.4e-3), 1e-12);
}

TEST(TomlSteps, PositionsAndListsOfTheTableWin) {
  const CaseFile f =
      parse_study(kRolling +
                  "[[cases]]\ncase.steps = 2\nwheelset.pitch_deg = [14.3, 14.28]\nwheelset.vertical_force_N = "
                  "[9e4, 8e4]\nwheelset.y_mm = 3\n");
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_NEAR(rail_case(f, i).state.position.pitch, (i == 1 ? 14.3 : 14.28) * std::numbers::pi / 180.0, 1e-15);
    EXPECT_DOUBLE_EQ(rail_case(f, i).vertical_force, i == 1 ? 9e4 : 8e4);
    EXPECT_DOUBLE_EQ(rail_case(f, i).state.position.y, 3e-3);
    EXPECT_NEAR(rail_case(f, i).state.position.x, static_cast<double>(i) * 0.4e-3, 1e-15);
  }
}

TEST(TomlSteps, TimeStepSetsTheRollingStep) {
  const CaseFile f = parse_study(kRolling + "[[cases]]\ncase = { steps = 3, time_step_s = 1e-4 }\n");
  for (const std::size_t i : {1u, 2u, 3u}) {
    EXPECT_NEAR(rail_case(f, i).state.position.x, static_cast<double>(i) * 2e-4, 1e-15);
    EXPECT_DOUBLE_EQ(rail_case(f, i).discretisation.dq_relative, 0.5);
  }
  EXPECT_THAT(f.notes, IsEmpty());
}

TEST(TomlSteps, ShiftsAreDisplacements) {
  const CaseFile f = parse_study(
      kRail +
      "case = { regime = \"shift\", steps = 3 }\nwheelset.velocity_m_s = 0.0002\nwheelset.vpitch_rad_s = -0.0004\n"
      "wheelset.s_mm = 5\n");
  ASSERT_EQ(f.cases.size(), 3u);
  EXPECT_EQ(rail_case(f, 0).history, HistoryUse::start);
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_NEAR(rail_case(f, i).state.position.x, 5e-3 + static_cast<double>(i) * 2e-4, 1e-15);
    EXPECT_NEAR(rail_case(f, i).state.position.pitch, static_cast<double>(i) * -4e-4, 1e-15);
  }
  EXPECT_EQ(rail_case(f, 1).history, HistoryUse::keep_going);
}

TEST(TomlSteps, OnARollerOnlyTheWheelTurns) {
  const CaseFile f =
      parse_study(kRail +
                  "case = { regime = \"transient\", steps = 2 }\nwheelset.longitudinal_force_N = "
                  "0\nwheelset.s_mm = 1\nwheelset.nominal_radius_mm = 500\n"
                  "roller = { nominal_radius_mm = 1000, pitch_rate_rad_s = 2 }\ndiscretisation.dx_mm = 1\n");
  EXPECT_DOUBLE_EQ(rail_case(f, 1).state.position.x, 1e-3);
  EXPECT_NEAR(rail_case(f, 1).state.position.pitch, -4.0 * 1e-3 / 2.0, 1e-15);  // as if it rolled freely
}

TEST(TomlBalance, ARollerHasNoCant) {
  const std::string roller = kRail + "roller = { nominal_radius_mm = 1000, pitch_rate_rad_s = 2 }\n";
  EXPECT_EQ(parse_study(roller + "track.gauge_mm = 1435\n").cases.size(), 1u);
  EXPECT_THAT(study_refusal(roller + "track.cant = \"1:40\"\n"), HasSubstr("a roller has no cant"));
}

TEST(TomlSteps, OverridesComeBeforeTheSteps) {
  const std::string text = kRolling + "[[cases]]\ncase.steps = 3\n";
  const CaseFile finer = parse_study(text, {"discretisation.dx_mm=0.2"});
  EXPECT_NEAR(rail_case(finer, 3).state.position.x, 3 * 0.2e-3, 1e-15);
  const CaseFile fewer = parse_study(text, {"case.steps=2"});
  ASSERT_EQ(fewer.cases.size(), 4u);
  const CaseFile still = parse_study(text, {"wheelset.s_mm=7"});
  EXPECT_DOUBLE_EQ(rail_case(still, 3).state.position.x, 7e-3);
  CaseFile made = parse_study(text);
  const std::vector<std::string> late{"case.steps=2"};
  EXPECT_THROW(apply_overrides(made, late), Error);
  EXPECT_THROW(apply_override(made.cases[1], late[0]), Error);
}

TEST(TomlSteps, RepeatPatches) {
  const CaseFile f = parse_study(
      "[patch]\nnormal_force_N = 1e3\nmx = 3\nmy = 2\ndx_mm = 1\ndy_mm = 1\ngap.coefficients_si = [1, 0, 1, 0, 0, "
      "0]\n[case]\nregime = \"shift\"\nsteps = 3\n");
  ASSERT_EQ(f.cases.size(), 3u);
  EXPECT_EQ(std::get<BasicCase>(f.cases[2].content).history, HistoryUse::keep_going);
}

TEST(TomlSteps, ErrorsTellTheReason) {
  EXPECT_THAT(study_refusal(kRail + "case.steps = 2\ncase.regime = \"transient\"\n"),
              HasSubstr("case.steps needs a velocity"));
  EXPECT_THAT(study_refusal(kRolling + "[[cases]]\ncase.steps = 3\nwheelset.y_mm = [1, 2]\n"),
              HasSubstr("case.steps is 3, but a list of the same table has 2 values"));
  EXPECT_THAT(study_refusal(kRolling + "[[cases]]\ncase.steps = -1\n"), HasSubstr("must be at least 0"));
  EXPECT_THAT(study_refusal(kRolling + "[[cases]]\ncase.steps = 100000\n"), HasSubstr("more than 100000 cases"));
}

TEST(TomlSteps, StepsOverMoreThanTwoElementsAreRefused) {
  const std::string text = kRolling + "[[cases]]\nwheelset.s_mm = ";
  EXPECT_THAT(study_refusal(text + "0.9\n"),
              HasSubstr("case 2: wheel or rail move 0.9 mm through the contact since the "
                        "previous case, more than two elements (0.8 mm)"));
  EXPECT_THAT(study_refusal(text + "[0.4, 0.8, 2.0]\n"), HasSubstr("case 4: wheel or rail move 1.2 mm"));
  EXPECT_THAT(study_refusal(text + "0.9\ncase.history = \"start\"\n"), HasSubstr("no error"));
  EXPECT_THAT(study_refusal(text + "0.9\ncase.sequence = 2\n"), HasSubstr("no error"));
  const CaseFile noted = parse_study(text + "[0.6, 1.2]\n");
  EXPECT_THAT(noted.notes, ::testing::ElementsAre(HasSubstr("case 2: wheel or rail move 0.6 mm through the contact "
                                                            "since the previous case, but a rolling step is 0.4 mm")));
}

TEST(TomlSteps, AWheelThatShallRollAndDoesNotIsNoted) {
  EXPECT_THAT(parse_study(kRail).notes,
              ::testing::ElementsAre(HasSubstr("case 1: neither a speed nor rolling is given")));
  for (const char* moves : {"wheelset.velocity_km_h = 100\nwheelset.rolling = \"nominal\"\n",
                            "wheelset.vpitch_rad_s = -1\n", "case.regime = \"none\"\n"})
    EXPECT_THAT(parse_study(kRail + moves).notes, IsEmpty()) << moves;
  EXPECT_THAT(parse_study(kRail + "wheelset.velocity_m_s = 1\n").notes,
              ::testing::ElementsAre(HasSubstr("a speed is given, and no pitch rate: the wheel slides")));
}

TEST(TomlSteps, ElementsOfACaseThatContinuesStayAsTheyAre) {
  EXPECT_THAT(study_refusal(kRolling + "[[cases]]\n[[cases]]\ndiscretisation.ds_mm = 0.3\n"),
              HasSubstr("case 3: a case that continues the previous one needs elements of the same size"));
}

}  // namespace
}  // namespace treadmark::io
