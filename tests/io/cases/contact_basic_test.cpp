// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/tests/io/cases/contact_writer.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

BasicCase only_basic(const ContactWriter& w) { return basic_case(parse_cases(w.str()), 0); }

TEST(ContactHistory, FollowsThePDigitAndTheSequence) {
  std::string text;
  for (const char* id : {"3 1", "3 2"})
    for (const int p : {0, 1, 2, 3, 0}) text += basic().set("TANG", 1).set("PVTIME", p).line("module", id).str();
  const CaseFile f = parse_cases(text);
  using H = HistoryUse;
  const std::vector<H> expected{H::start, H::normal_only, H::start, H::same_instant,
                                H::keep_going};  // the first of a sequence starts
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(basic_case(f, i).history, expected[i % 5]) << i;
    EXPECT_EQ(f.cases[i].sequence, i < 5 ? 0 : 1) << i;
  }
}

TEST(ContactHistory, SkippedCasesLeaveNone) {
  const CaseFile f =
      parse_cases(basic().set("RETURN", 3).str() + basic().set("PVTIME", 0).str() + basic().set("PVTIME", 0).str());
  EXPECT_EQ(basic_case(f, 0).history, HistoryUse::start);
  EXPECT_EQ(basic_case(f, 1).history, HistoryUse::keep_going);
}

TEST(ContactHistory, CasesOfDifferentModulesAreDifferentSequences) {
  const CaseFile f = parse_cases(ContactWriter(1).str() + basic().str() + ContactWriter(1).str());
  EXPECT_EQ(f.cases[0].sequence, 0);
  EXPECT_EQ(f.cases[1].sequence, 1);
  EXPECT_EQ(f.cases[2].sequence, 0);
}

TEST(ContactRolling, TransientInAnyDirection) {
  const BasicCase c = only_basic(basic().set("TANG", 2).line("rolling", "30d 0.4 20000. 0.25"));
  EXPECT_EQ(c.regime, Regime::transient);
  EXPECT_DOUBLE_EQ(c.chi, 30 * kDegree);
  EXPECT_DOUBLE_EQ(c.dq, 0.4e-3);
  EXPECT_DOUBLE_EQ(c.velocity, 20.0);
  EXPECT_DOUBLE_EQ(c.spin_offset_factor, 0.25);
  EXPECT_EQ(only_basic(basic().set("TANG", 3).line("rolling", "180d 0.4 20000.")).regime, Regime::steady);
}

TEST(ContactMaterial, SheetViscoelasticityAndLayer) {
  EXPECT_DOUBLE_EQ(only_basic(basic().set("BOUND", 1)).material.sheet_flexibility, 1e-14);  // 1e-5 mm^3/N
  const Material v = only_basic(basic().set("MATER", 1).line("viscoelastic", "1.5 2.5 0.01 0.02")).material;
  EXPECT_DOUBLE_EQ(v.creep_ratio_1, 1.5);
  EXPECT_DOUBLE_EQ(v.creep_ratio_2, 2.5);
  EXPECT_DOUBLE_EQ(v.relaxation_time_1, 0.01);
  EXPECT_DOUBLE_EQ(v.relaxation_time_2, 0.02);
  const Material m = only_basic(basic().set("TANG", 1).set("MATER", 4).line("layer", "8200. 1.25 30. -7.")).material;
  EXPECT_DOUBLE_EQ(m.layer_flexibility, 1.25e-3 / 8.2e9);
  EXPECT_DOUBLE_EQ(m.layer_yield, 30e6);
  EXPECT_DOUBLE_EQ(m.layer_hardening, -7e9);
  for (const char* elastic : {"8200. 1.25 0. 5.", "8200. 1.25 1e-11 5.", "8200. 1.25 1e11 5."}) {
    const Material e = only_basic(basic().set("MATER", 4).line("layer", elastic)).material;
    EXPECT_DOUBLE_EQ(e.layer_yield, 0.0);
    EXPECT_DOUBLE_EQ(e.layer_hardening, 0.0);
  }
}

TEST(ContactMaterial, IsKeptButCountsOnlyWithItsDigit) {
  const CaseFile f = parse_cases(basic().set("MATER", 4).str() + keeping_basic().str() +
                                 keeping_basic().set("MATER", 4).str() + basic().set("MATER", 1).set("BOUND", 1).str() +
                                 keeping_basic().str() + keeping_basic().set("MATER", 1).set("BOUND", 1).str());
  EXPECT_DOUBLE_EQ(basic_case(f, 1).material.layer_flexibility, 0.0);
  EXPECT_DOUBLE_EQ(basic_case(f, 2).material.layer_flexibility, 1.25e-3 / 8.2e9);
  EXPECT_DOUBLE_EQ(basic_case(f, 4).material.creep_ratio_1, 0.0);
  EXPECT_DOUBLE_EQ(basic_case(f, 4).material.sheet_flexibility, 0.0);
  EXPECT_DOUBLE_EQ(basic_case(f, 5).material.creep_ratio_1, 1.0);
  EXPECT_DOUBLE_EQ(basic_case(f, 5).material.sheet_flexibility, 1e-14);
}

TEST(ContactMaterial, DissimilarBodies) {
  const BasicCase c =
      only_basic(basic().line("material", "0.31 0.28 23000. 82000.").line("solver", "500 100 30 10 1e-6"));
  EXPECT_DOUBLE_EQ(c.material.shear_modulus_1, 23e9);
  EXPECT_DOUBLE_EQ(c.material.poisson_1, 0.31);
  EXPECT_EQ(c.solver.max_coupling, 10);
}

TEST(ContactModels, SimplifiedTheories) {
  using T = TangentialModel;
  const BasicCase one = only_basic(basic().set("MATER", 2).line("simplified", "2e-5 0.9 0.8 0.7"));
  EXPECT_EQ(one.tangential_model, T::fastsim_one_flexibility);
  EXPECT_DOUBLE_EQ(one.fastsim.flexibility, 2e-14);
  EXPECT_DOUBLE_EQ(one.fastsim.alpha, 0.8);
  EXPECT_EQ(only_basic(basic().set("MATER", 3)).tangential_model, T::fastsim);
  const BasicCase strip = only_basic(basic().set("MATER", 5));
  EXPECT_EQ(strip.tangential_model, T::fastrip);
  EXPECT_DOUBLE_EQ(strip.fastsim.beta, 0.7);
}

TEST(ContactModels, ApproximatePressures) {
  EXPECT_EQ(only_basic(basic().set("NORM", 0).set("BOUND", 5)).normal_model, NormalModel::kpec);
  EXPECT_EQ(only_basic(basic().set("NORM", 0).set("BOUND", 6)).normal_model, NormalModel::analyn);
  const BasicCase c =
      only_basic(basic().set("BOUND", 4).line("ipotcn", "-6").line("potcon", "4 5 8.0 3.0 5.0 1.1").line("hertz", ""));
  EXPECT_EQ(c.normal_model, NormalModel::semi_double_elliptic);
  const HertzInput& h = std::get<HertzInput>(c.geometry);
  EXPECT_EQ(h.given, HertzInput::Given::semi_double_elliptic);
  EXPECT_DOUBLE_EQ(h.aa, 8e-3);
  EXPECT_DOUBLE_EQ(h.bb_negative, 3e-3);
  EXPECT_DOUBLE_EQ(h.bb_positive, 5e-3);
  EXPECT_DOUBLE_EQ(h.bb, 4e-3);
  EXPECT_DOUBLE_EQ(h.scale, 1.1);
}

TEST(ContactInfluence, KindsAndTheirData) {
  using Kind = InfluenceInput::Kind;
  EXPECT_EQ(only_basic(basic()).influence.kind, Kind::constant);
  EXPECT_EQ(only_basic(basic().set("INFLCF", 3)).influence.kind, Kind::bilinear);
  const InfluenceInput angle = only_basic(basic().set("INFLCF", 4).line("ifmeth", "1 3 2")).influence;
  EXPECT_EQ(angle.kind, Kind::angle_corrected);
  EXPECT_FALSE(angle.linear);
  EXPECT_EQ(angle.variant, 3);
  EXPECT_THAT(angle.position, ElementsAre(DoubleEq(-1e-3), DoubleEq(1e-3)));
  EXPECT_THAT(angle.inclination, ElementsAre(DoubleEq(0.1), DoubleEq(5 * kDegree)));
  EXPECT_TRUE(only_basic(basic().set("INFLCF", 4)).influence.linear);
  const CaseFile f = parse_cases(basic().set("INFLCF", 9).line("cff", "'sub\\table.cff'").str() +
                                 keeping_basic().str() + keeping_basic().set("INFLCF", 2).str());
  EXPECT_EQ(basic_case(f, 0).influence.kind, Kind::table);
  EXPECT_EQ(basic_case(f, 0).influence.file, "folder/sub/table.cff");
  EXPECT_EQ(basic_case(f, 1).influence.file, "folder/sub/table.cff");  // C = 0 keeps it
  EXPECT_EQ(basic_case(f, 2).influence.kind, Kind::constant);
}

TEST(ContactFriction, LawOfEachRow) {
  const auto rows = [](const char* law) { return basic().set("VARFRC", 3).set("FRCLAW", law[0] - '0'); };
  const std::string first = rows("0").str();  // the writer gives both rows
  const CaseFile f = parse_cases(first + keeping_basic().set("VARFRC", 3).str() + keeping_basic().str());
  ASSERT_EQ(basic_case(f, 0).friction_of_row.size(), 2u);
  EXPECT_DOUBLE_EQ(basic_case(f, 0).friction_of_row[1].kinetic, 0.3);
  EXPECT_EQ(basic_case(f, 1).friction_of_row.size(), 2u);
  EXPECT_THAT(basic_case(f, 2).friction_of_row, IsEmpty());
  EXPECT_DOUBLE_EQ(basic_case(f, 2).friction.kinetic, 0.3);
  const BasicCase falling = only_basic(rows("4"));
  ASSERT_EQ(falling.friction_of_row.size(), 2u);
  EXPECT_EQ(falling.friction_of_row[0].kind, FrictionLaw::Kind::exponential);
  EXPECT_DOUBLE_EQ(falling.friction_of_row[1].half_velocity_2, 0.2);
  EXPECT_DOUBLE_EQ(falling.friction_of_row[1].memory_distance, 3e-6);  // one memory line for all sets
}

TEST(ContactFriction, PolachsFormula) {
  const FrictionLaw f = only_basic(basic().set("FRCLAW", 5).line("friction", "0.3 0.4 6e-4")).friction;
  for (const double w : {0.0, 0.5, 3.0})  // Polach 2005: mu0 [A + (1 - A) exp(-B w)]
    EXPECT_NEAR(f.at(w), 0.3 * (0.4 + 0.6 * std::exp(-0.6 * w)), 1e-15);
  EXPECT_DOUBLE_EQ(f.static_friction(), 0.3);
  for (const char* wrong : {"0.3 1.5 6e-4", "0.3 0.4 0.", "0.3 0. 6e-4", "0. 0.4 6e-4"})
    EXPECT_THROW(only_basic(basic().set("FRCLAW", 5).line("friction", wrong)), Error) << wrong;
}

TEST(ContactExtraSlip, SpinInOneDirection) {
  const std::string first = basic().set("EXRHS", 2).str();
  const CaseFile f = parse_cases(first + keeping_basic().set("EXRHS", 1).str() + keeping_basic().set("EXRHS", 3).str() +
                                 keeping_basic().str());
  const SpinSlip expected[] = {SpinSlip::longitudinal, SpinSlip::longitudinal, SpinSlip::lateral, SpinSlip::both};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(basic_case(f, i).spin_slip, expected[i]) << i;
    EXPECT_THAT(basic_case(f, i).extra_slip_x, IsEmpty());
  }
}

TEST(ContactHeat, ThermalDataAndFriction) {
  const std::string first = basic()
                                .set("HEAT", 3)
                                .set("FRCLAW", 6)
                                .line("heat1", "20. 450. 50e-3 7.85e-6")
                                .line("heat2", "150. 500. 40e-3 7.8e-6")
                                .str();
  const CaseFile f = parse_cases(first + keeping_basic().set("HEAT", 1).str() + keeping_basic().set("FRCLAW", 0).str());
  for (const std::size_t i : {0u, 1u}) {
    ASSERT_TRUE(basic_case(f, i).thermal);
    EXPECT_DOUBLE_EQ(basic_case(f, i).thermal->body_1.bulk_temperature, 20.0);
    EXPECT_DOUBLE_EQ(basic_case(f, i).thermal->body_1.conductivity, 50.0);
    EXPECT_NEAR(basic_case(f, i).thermal->body_1.density, 7850.0, 1e-9);
    EXPECT_DOUBLE_EQ(basic_case(f, i).thermal->body_2.bulk_temperature, 150.0);
    EXPECT_DOUBLE_EQ(basic_case(f, i).thermal->body_2.heat_capacity, 500.0);
    EXPECT_DOUBLE_EQ(basic_case(f, i).thermal->plastic_fraction, 1.0);
    const FrictionLaw& law = basic_case(f, i).friction;
    EXPECT_EQ(law.kind, FrictionLaw::Kind::temperature);
    EXPECT_DOUBLE_EQ(law.kinetic, 0.3);
    EXPECT_DOUBLE_EQ(law.reference_temperature, 20.0);
    EXPECT_DOUBLE_EQ(law.temperature_change, -0.1);
    EXPECT_DOUBLE_EQ(law.temperature_range, 100.0);
  }
  EXPECT_FALSE(basic_case(f, 2).thermal);
  const BasicCase plastic = only_basic(basic().set("HEAT", 3).set("MATER", 4).line("betapl", "0.9"));
  EXPECT_DOUBLE_EQ(plastic.thermal->plastic_fraction, 0.9);
}

TEST(ContactSolver, MethodAndFirstSlip) {
  using S = SolverSettings;
  const auto of = [](int digit, const char* slip) {
    return only_basic(basic().set("GAUSEI", digit).line("slip", slip).line("omega", "0.5 1.0 " + std::string(slip)))
        .solver;
  };
  EXPECT_EQ(of(0, "1 1.").method, S::Method::automatic);
  EXPECT_EQ(of(2, "1 1.").method, S::Method::sweeps);
  EXPECT_EQ(of(2, "1 1.").first_slip, S::FirstSlip::below);
  EXPECT_EQ(of(4, "1 1.").method, S::Method::automatic);
  EXPECT_EQ(of(4, "1 1.").first_slip, S::FirstSlip::below);
  EXPECT_EQ(of(4, "-1 1.").first_slip, S::FirstSlip::above);
  EXPECT_EQ(of(4, "0 1.").first_slip, S::FirstSlip::last);
  EXPECT_EQ(of(3, "1 1.").first_slip, S::FirstSlip::last);
  const CaseFile f = parse_cases(basic().set("GAUSEI", 2).line("omega", "0.5 1.0 -2 1.").str() + keeping_basic().str() +
                                 keeping_basic().set("GAUSEI", 0).str());
  EXPECT_EQ(basic_case(f, 1).solver.first_slip, S::FirstSlip::above);
  EXPECT_EQ(basic_case(f, 1).solver.method, S::Method::sweeps);
  EXPECT_EQ(basic_case(f, 2).solver.method, S::Method::automatic);
  EXPECT_EQ(basic_case(f, 2).solver.first_slip, S::FirstSlip::last);
}

TEST(ContactExtraSlip, IsReadKeptAndDropped) {
  const std::string line = "1 10 2 20 3 30\n 4 40 5 50 6 60";
  const CaseFile f = parse_cases(basic().set("EXRHS", 9).line("slip", line).str() +
                                 keeping_basic().set("EXRHS", 1).set("TANG", 1).str() + keeping_basic().str() +
                                 keeping_basic().set("EXRHS", 1).str());
  EXPECT_THAT(basic_case(f, 0).extra_slip_x, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(basic_case(f, 0).extra_slip_y, ElementsAre(10, 20, 30, 40, 50, 60));
  EXPECT_DOUBLE_EQ(basic_case(f, 1).extra_slip_y.at(1), 20e-3);  // of a shift it is a length
  EXPECT_THAT(basic_case(f, 2).extra_slip_x, IsEmpty());
  EXPECT_THAT(basic_case(f, 3).extra_slip_x, IsEmpty());
}

TEST(ContactPlanform, InSiUnits) {
  const auto plan = [](const char* kind, const char* lines) {
    return only_basic(basic()
                          .set("NORM", 0)
                          .line("ibase", "1 " + std::string(kind))
                          .line("gap", std::string("0.001 0 0.001 0 0 0") + lines))
        .planform;
  };
  using Kind = PlanformInput::Kind;
  EXPECT_EQ(plan("1", "").kind, Kind::free);
  EXPECT_THAT(plan("2", "\n 1 2 3 4 5 6").coefficients,
              ElementsAre(DoubleEq(1e6), DoubleEq(2e6), DoubleEq(3e6), DoubleEq(4e3), DoubleEq(5e3), DoubleEq(6.0)));
  const PlanformInput two = plan("3", "\n 0 1 2 3\n 4 5 6 7");
  EXPECT_EQ(two.kind, Kind::two_rectangles);
  EXPECT_THAT(two.coefficients, ElementsAre(0, 1e-3, DoubleEq(2e-3), DoubleEq(3e-3), DoubleEq(4e-3), DoubleEq(5e-3),
                                            DoubleEq(6e-3), DoubleEq(7e-3)));
  const PlanformInput sub = plan("4", "\n 3\n 0 1 0 1\n 0 1 2 3\n 0 1 4 5\n 0.1 0.2\n 0.3");
  EXPECT_EQ(sub.kind, Kind::sub_patches);
  EXPECT_EQ(sub.coefficients.size(), 12u);
  EXPECT_THAT(sub.coupling, ElementsAre(1.0, 0.1, 0.2, 0.1, 1.0, 0.3, 0.2, 0.3, 1.0));
  const CaseFile f = parse_cases(basic().line("ibase", "1 2").line("gap", "0.001 0 0.001 0 0 0\n 1 2 3 4 5 6").str() +
                                 keeping_basic().str() + basic().str());
  EXPECT_EQ(basic_case(f, 1).planform.kind, Kind::quadratic);  // kept with the gap
  EXPECT_EQ(basic_case(f, 2).planform.kind, Kind::free);
}

TEST(ContactSubsurface, BlocksOfEveryKind) {
  const SubsurfaceInput s = only_basic(basic().set("STRESS", 3)).subsurface;
  ASSERT_EQ(s.blocks.size(), 7u);
  EXPECT_TRUE(s.text_table);
  EXPECT_FALSE(s.full_tensor);
  EXPECT_TRUE(s.blocks[0].at_elements);
  EXPECT_THAT(s.blocks[0].columns, IsEmpty());
  EXPECT_THAT(s.blocks[0].z, ElementsAre(0.0, DoubleEq(0.5e-3)));
  EXPECT_THAT(s.blocks[1].columns, ElementsAre(0, 1));  // counted from 1 in the file
  EXPECT_THAT(s.blocks[1].z, ElementsAre(DoubleEq(0.1e-3)));
  EXPECT_THAT(s.blocks[2].columns, ElementsAre(0, 1));
  EXPECT_THAT(s.blocks[2].rows, ElementsAre(0));
  EXPECT_THAT(s.blocks[3].z, ElementsAre(0.0, DoubleEq(1e-3)));
  EXPECT_THAT(s.blocks[4].rows, ElementsAre(0, 1));
  EXPECT_THAT(s.blocks[5].rows, ElementsAre(0));
  EXPECT_FALSE(s.blocks[6].at_elements);
  EXPECT_THAT(s.blocks[6].x, ElementsAre(0.0, DoubleEq(1e-3)));
  EXPECT_THAT(s.blocks[6].y, ElementsAre(0.0));
  EXPECT_THAT(s.blocks[6].z, ElementsAre(0.0, DoubleEq(1e-3)));
}

TEST(ContactSubsurface, PointsAreKept) {
  const CaseFile f =
      parse_cases(basic().set("STRESS", 3).str() + keeping_basic().str() + keeping_basic().set("STRESS", 1).str() +
                  keeping_basic().set("STRESS", 2).line("stress", "2 0").str() +
                  keeping_basic().set("STRESS", 2).line("stress", "0 0").str());
  EXPECT_THAT(basic_case(f, 1).subsurface.blocks, IsEmpty());
  EXPECT_EQ(basic_case(f, 2).subsurface.blocks.size(), 7u);
  EXPECT_FALSE(basic_case(f, 2).subsurface.full_tensor);
  EXPECT_TRUE(basic_case(f, 3).subsurface.full_tensor);
  EXPECT_FALSE(basic_case(f, 4).subsurface.text_table);
  EXPECT_EQ(basic_case(f, 4).subsurface.blocks.size(), 7u);
}

TEST(ContactOutput, TableOfElements) {
  for (const int module : {1, 3})
    for (const int digit : {0, 1, 2})
      EXPECT_EQ(parse_cases(ContactWriter(module).set("MATFIL", digit).str()).cases[0].element_table, digit);
}

TEST(ContactWheelRail, ApproximationsAndFrictionThatVaries) {
  const auto rail = [](const CaseFile& f, std::size_t i) { return std::get<WheelRailCase>(f.cases.at(i).content); };
  const WheelRailCase kpec =
      rail(parse_cases(ContactWriter(1).set("BOUND", 5).set("MATER", 2).set("INFLCF", 3).str()), 0);
  EXPECT_EQ(kpec.normal_model, NormalModel::kpec);
  EXPECT_EQ(kpec.tangential_model, TangentialModel::fastsim_one_flexibility);
  EXPECT_DOUBLE_EQ(kpec.fastsim.flexibility, 1e-14);
  EXPECT_EQ(kpec.influence.kind, InfluenceInput::Kind::bilinear);
  EXPECT_EQ(rail(parse_cases(ContactWriter(1).set("BOUND", 6).set("MATER", 5).str()), 0).tangential_model,
            TangentialModel::fastrip);

  const CaseFile f = parse_cases(ContactWriter(1).set("VARFRC", 1).set("FRCLAW", 4).str() +
                                 ContactWriter(1).set("VARFRC", 1).set("FRCLAW", 1).str() +
                                 ContactWriter(1).set("FRCLAW", 1).str() + ContactWriter(1).set("VARFRC", 2).str());
  using Kind = FrictionVariation::Kind;
  for (const std::size_t i : {0u, 1u}) {
    const FrictionVariation v = rail(f, i).friction_variation;
    EXPECT_EQ(v.kind, Kind::inclination);
    EXPECT_THAT(v.positions, ElementsAre(DoubleEq(-20 * kDegree), DoubleEq(-10 * kDegree)));
    ASSERT_EQ(v.laws.size(), 2u);
    EXPECT_EQ(v.laws[1].kind, FrictionLaw::Kind::exponential);
    EXPECT_DOUBLE_EQ(v.laws[0].memory_distance, 3e-6);
  }
  EXPECT_EQ(rail(f, 2).friction_variation.kind, Kind::none);
  EXPECT_EQ(rail(f, 2).friction.kind, FrictionLaw::Kind::exponential);
  EXPECT_EQ(rail(f, 3).friction_variation.kind, Kind::along_track);
  EXPECT_THAT(rail(f, 3).friction_variation.positions, ElementsAre(DoubleEq(-20e-3), DoubleEq(-10e-3)));
}

}  // namespace
}  // namespace treadmark::io
