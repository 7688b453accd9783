// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/tests/io/cases/contact_writer.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ContactWriter rail() { return ContactWriter(1); }
ContactWriter keeping_rail() {
  return rail()
      .set("FRCLAW", 1)
      .set("DISCNS", 0)
      .set("INFLCF", 0)
      .set("ZTRACK", 0)
      .set("EWHEEL", 2)
      .set("GAUSEI", 1)
      .set("PVTIME", 0);
}

WheelRailCase only_rail(const ContactWriter& w) { return rail_case(parse_cases(w.str()), 0); }

TEST(ContactRoller, HasItsRadiusAndPitchRate) {
  for (const int side : {4, 5}) {
    const WheelRailCase c = only_rail(rail().set("CONFIG", side).line("velocity", "20. 1. 2. 0.1 0.2 -40."));
    EXPECT_EQ(c.side, side == 4 ? Side::left : Side::right);
    ASSERT_TRUE(c.roller);
    EXPECT_DOUBLE_EQ(c.roller->nominal_radius, 0.5);
    EXPECT_DOUBLE_EQ(c.roller->pitch_rate, 20.0);
    EXPECT_DOUBLE_EQ(c.track.cant, 0.0);
    EXPECT_DOUBLE_EQ(c.state.position.x, 1e-3);  // X_WS
    EXPECT_DOUBLE_EQ(c.state.velocity.x, 0.0);
    EXPECT_DOUBLE_EQ(c.state.velocity.y, 1e-3);
    EXPECT_DOUBLE_EQ(c.state.velocity.pitch, -40.0);
  }
  EXPECT_FALSE(only_rail(rail()).roller);
  EXPECT_DOUBLE_EQ(only_rail(rail().set("CONFIG", 5).line("track", "-1.0 750. 0.1 -500. 0.001")).roller->nominal_radius,
                   -0.5);
  EXPECT_THAT(cases_refusal(rail().set("CONFIG", 5).line("track", "14. 0 1435. 0.").str()),
              HasSubstr("test.inp:9:15: NOMRAD of a roller must not be 0"));
}

TEST(ContactRoller, IsKeptAndNeedsItsNumbers) {
  const CaseFile f =
      parse_cases(rail().set("CONFIG", 5).str() + keeping_rail().set("CONFIG", 5).set("EWHEEL", 1).str());
  EXPECT_DOUBLE_EQ(rail_case(f, 1).roller->nominal_radius, 0.5);
  EXPECT_DOUBLE_EQ(rail_case(f, 1).roller->pitch_rate, 2000.0);
  EXPECT_THAT(cases_refusal(rail().str() + keeping_rail().set("CONFIG", 5).str()),
              HasSubstr("needs NOMRAD of the roller, but no case has given it"));
  EXPECT_THAT(cases_refusal(rail().str() + keeping_rail().set("CONFIG", 5).set("ZTRACK", 3).set("EWHEEL", 1).str()),
              HasSubstr("needs the roller's pitch rate of the velocity line"));
}

TEST(ContactForces, LongitudinalForceReplacesThePitchRate) {
  const CaseFile f = parse_cases(rail().set("FORCE", 1).str() +
                                 keeping_rail().set("FORCE", 1).line("velocity", "2000. 0. 0. 0. 0. 5000.").str() +
                                 keeping_rail().set("FORCE", 1).set("EWHEEL", 1).str() + keeping_rail().str());
  EXPECT_EQ(rail_case(f, 0).longitudinal_force, std::optional(-4.0));
  EXPECT_DOUBLE_EQ(rail_case(f, 0).state.velocity.pitch, 0.0);
  EXPECT_EQ(rail_case(f, 1).longitudinal_force, std::optional(5000.0));
  EXPECT_EQ(rail_case(f, 2).longitudinal_force, std::optional(5000.0));
  EXPECT_FALSE(rail_case(f, 3).longitudinal_force);
  EXPECT_DOUBLE_EQ(rail_case(f, 3).state.velocity.pitch, -4.0);
  EXPECT_THAT(cases_refusal(rail().str() + keeping_rail().set("FORCE", 1).set("EWHEEL", 1).str()),
              HasSubstr("test.inp:17:8: F (FORCE) = 1 needs FX"));
  EXPECT_THAT(cases_refusal(rail().set("FORCE", 1).str() + keeping_rail().set("EWHEEL", 0).str()),
              HasSubstr("F (FORCE) = 0 needs VPITCH"));
}

TEST(ContactForces, RailOnSpringsInSiUnits) {
  const CaseFile f =
      parse_cases(rail().set("FORCE", 3).line("massless", "100. -2000. 50. 3000. 0.5").str() +
                  keeping_rail().set("FORCE", 3).str() + keeping_rail().set("FORCE", 3).set("ZTRACK", 2).str() +
                  keeping_rail().set("ZTRACK", 2).str());
  for (const std::size_t i : {0u, 1u}) {
    const RailSprings s = rail_case(f, i).rail_springs.value();
    EXPECT_DOUBLE_EQ(s.stiffness_y, 1e5);
    EXPECT_DOUBLE_EQ(s.force_y, -2000.0);
    EXPECT_DOUBLE_EQ(s.stiffness_z, 5e4);
    EXPECT_DOUBLE_EQ(s.force_z, 3000.0);
    EXPECT_DOUBLE_EQ(s.first_step_y, 0.5e-3);
  }
  EXPECT_DOUBLE_EQ(rail_case(f, 2).rail_springs.value().stiffness_z, 1e6);
  EXPECT_DOUBLE_EQ(rail_case(f, 2).rail_springs.value().first_step_y, 1e-3);
  EXPECT_FALSE(rail_case(f, 3).rail_springs);
  EXPECT_THAT(cases_refusal(rail().str() + keeping_rail().set("FORCE", 3).str()),
              HasSubstr("F (FORCE) = 3 needs the line KYRAIL"));
  EXPECT_THAT(cases_refusal(rail().set("FORCE", 3).line("massless", "1. 2. 3. 4. 0.").str()),
              HasSubstr("DYSTEP0 must be positive"));
}

TEST(ContactForces, DampingIsReadKeptAndDropped) {
  const CaseFile f = parse_cases(rail().line("word2", "0022033 2").line("damping", "1e-4 2e-4 3e6 4e6").str() +
                                 keeping_rail().line("word2", "0100002 1").str() + keeping_rail().str() +
                                 keeping_rail().line("word2", "0100002 1").str());
  for (const std::size_t i : {0u, 1u}) {
    const Damping d = rail_case(f, i).damping.value();
    EXPECT_DOUBLE_EQ(d.normal, 1e-4);
    EXPECT_DOUBLE_EQ(d.tangential, 2e-4);
    EXPECT_DOUBLE_EQ(d.max_rate_normal, 3e6);
    EXPECT_DOUBLE_EQ(d.max_rate_tangential, 4e6);
  }
  EXPECT_FALSE(rail_case(f, 2).damping);
  EXPECT_FALSE(rail_case(f, 3).damping);
  EXPECT_THAT(cases_refusal(rail().line("word2", "0022033 2").line("damping", "-1. 2. 3. 4.").str()),
              HasSubstr("CDAMPN must not be negative"));
}

TEST(ContactSequenceOfAWheel, FollowsThePDigit) {
  std::string text;
  for (const int p : {0, 1, 2, 3, 0}) text += rail().set("TANG", p == 2 ? 1 : 2).set("PVTIME", p).str();
  const CaseFile f = parse_cases(text);
  using H = HistoryUse;
  const std::vector<H> expected{H::start, H::normal_only, H::start, H::same_instant, H::keep_going};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(rail_case(f, i).history, expected[i]) << i;
  EXPECT_EQ(rail_case(f, 0).regime, Regime::transient);
  EXPECT_EQ(rail_case(f, 2).regime, Regime::shift);
  EXPECT_DOUBLE_EQ(rail_case(f, 2).state.velocity.x, 2.0);  // 2000 mm in the step
}

TEST(ContactSequenceOfAWheel, KeepsElementsAndSide) {
  const std::string first = rail().set("TANG", 2).str();
  EXPECT_THAT(cases_refusal(first + rail().set("TANG", 2).set("PVTIME", 0).line("grid", "0.3 0.5 1. 90d 8. 4.").str()),
              HasSubstr("test.inp:18:5: a case that continues the previous one needs elements of the same size"));
  EXPECT_THAT(cases_refusal(first + rail().set("TANG", 2).set("PVTIME", 0).set("DISCNS", 4).str()),
              HasSubstr("the same kind of reference surface"));
  EXPECT_THAT(cases_refusal(first + rail().set("TANG", 2).set("PVTIME", 0).set("CONFIG", 0).str()),
              HasSubstr("must be on the same side"));
  EXPECT_EQ(
      cases_refusal(first +
                    rail().set("TANG", 2).set("PVTIME", 2).set("CONFIG", 0).line("grid", "0.3 0.5 1. 90d 8. 4.").str()),
      "no error");
  EXPECT_EQ(cases_refusal(first + rail().set("TANG", 3).set("PVTIME", 0).line("grid", "0.3 0.5 1. 90d 8. 4.").str()),
            "no error");
}

TEST(ContactSequenceOfAWheel, StepsThatDoNotFitAreNotedOnce) {
  const auto notes = [](const std::string& position) {
    std::string text = rail().set("TANG", 2).line("position", "0. 0. 125000. 0. 0. 0.").str();
    for (int i = 0; i < 3; ++i) text += keeping_rail().set("TANG", 2).line("position", position).str();
    std::vector<std::string> found;
    for (const std::string& note : parse_cases(text).notes)
      if (note.find("through the contact") != std::string::npos) found.push_back(note);
    return found;
  };
  EXPECT_THAT(notes("0. 0. 125000. 0. 0. 0."), IsEmpty());   // nothing moves
  EXPECT_THAT(notes("0.4 0. 125000. 0. 0. 0."), IsEmpty());  // dx = 0.4 mm, DQREL = 1
  EXPECT_THAT(notes("0.6 0. 125000. 0. 0. 0."),
              ElementsAre(HasSubstr("test.inp:16:1: wheel or rail move 0.6 mm through the contact since the previous "
                                    "case, but a rolling step is 0.4 mm")));
  EXPECT_THAT(notes("0. 0. 125000. 0. 0. -0.01"),
              ElementsAre(HasSubstr("move 4.6 mm through the contact since the previous case, more than two elements "
                                    "(0.8 mm)")));
}

TEST(ContactMethods, ReferenceSurfaces) {
  using R = ReferenceSurface;
  EXPECT_EQ(only_rail(rail()).reference_surface, R::plane);
  EXPECT_EQ(only_rail(rail().set("DISCNS", 3)).reference_surface, R::plane_surface_slip);
  EXPECT_EQ(only_rail(rail().set("DISCNS", 4)).reference_surface, R::curved);
  EXPECT_EQ(only_rail(rail().set("DISCNS", 7)).reference_surface, R::plane);
  for (const int d : {3, 4}) EXPECT_EQ(only_rail(rail().set("DISCNS", d)).discretisation.method, 2);
  const CaseFile f =
      parse_cases(rail().set("DISCNS", 4).set("INFLCF", 4).line("ifmeth", "1 3").str() + keeping_rail().str());
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(rail_case(f, i).reference_surface, R::curved);
    EXPECT_EQ(rail_case(f, i).influence.kind, InfluenceInput::Kind::angle_corrected);
    EXPECT_EQ(rail_case(f, i).influence.variant, 3);
    EXPECT_FALSE(rail_case(f, i).influence.linear);
    EXPECT_THAT(rail_case(f, i).influence.position, IsEmpty());
  }
}

TEST(ContactMethods, BodiesHeatAndFriction) {
  EXPECT_DOUBLE_EQ(only_rail(rail().set("BOUND", 1)).material.sheet_flexibility, 1e-14);
  EXPECT_DOUBLE_EQ(only_rail(rail().set("MATER", 1)).material.creep_ratio_1, 1.0);
  EXPECT_DOUBLE_EQ(only_rail(rail().line("material", "0.31 0.28 23000. 82000.")).material.shear_modulus_1, 23e9);
  const WheelRailCase yielding =
      only_rail(rail().set("MATER", 4).set("HEAT", 3).line("layer", "8200. 1.25 30. 5.").line("betapl", "0.8"));
  EXPECT_DOUBLE_EQ(yielding.material.layer_yield, 30e6);
  EXPECT_DOUBLE_EQ(yielding.material.layer_hardening, 5e9);
  EXPECT_DOUBLE_EQ(yielding.thermal.value().plastic_fraction, 0.8);
  const CaseFile f = parse_cases(rail().set("HEAT", 3).set("FRCLAW", 6).str() + keeping_rail().set("HEAT", 1).str());
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(rail_case(f, i).friction.kind, FrictionLaw::Kind::temperature);
    EXPECT_DOUBLE_EQ(rail_case(f, i).thermal.value().body_1.heat_capacity, 450.0);
  }
}

TEST(ContactOutputOfAWheel, PointsAndTables) {
  const CaseFile f =
      parse_cases(rail().set("STRESS", 3).set("MATFIL", 2).str() + keeping_rail().set("STRESS", 1).str() +
                  keeping_rail().str() + keeping_rail().set("STRESS", 2).line("stress", "2 0").str());
  EXPECT_EQ(rail_case(f, 0).subsurface.blocks.size(), 7u);
  EXPECT_EQ(f.cases[0].element_table, 2);
  EXPECT_EQ(rail_case(f, 1).subsurface.blocks.size(), 7u);
  EXPECT_THAT(rail_case(f, 2).subsurface.blocks, IsEmpty());
  EXPECT_TRUE(rail_case(f, 3).subsurface.full_tensor);
  EXPECT_THAT(f.notes, ::testing::Not(::testing::Contains(HasSubstr("MATFIL"))));
}

class Contradiction1 : public ::testing::TestWithParam<Contradictory> {};
TEST_P(Contradiction1, IsRefusedAtItsDigit) {
  EXPECT_THAT(cases_refusal(GetParam().input.str()), HasSubstr(GetParam().expected));
}
TEST_P(Contradiction1, IsNoneInASkippedCase) {
  ContactWriter skipped = GetParam().input;
  EXPECT_EQ(cases_refusal(skipped.set("RETURN", 3).str() + rail().str()), "no error");
}

ContactWriter viscoelastic_rail() { return rail().set("MATER", 1); }

INSTANTIATE_TEST_SUITE_P(
    Cases, Contradiction1,
    ::testing::Values(
        Contradictory{rail().set("FORCE", 1).set("TANG", 0),
                      "test.inp:2:8: a prescribed longitudinal force needs friction"},
        Contradictory{rail().set("FORCE", 3).line("massless", "0. 0. 1. 0."),
                      "test.inp:2:8: a rail on springs needs a positive lateral stiffness"},
        Contradictory{rail().set("FORCE", 3).line("massless", "1. 0. -1. 0."), "must not be negative"},
        Contradictory{rail().set("FORCE", 3).set("NORM", 0).line("massless", "1. 0. 0. 0."),
                      "needs a positive vertical stiffness"},
        Contradictory{rail().set("CONFIG", 4).set("VARFRC", 2),
                      "test.inp:3:4: friction cannot vary along the track of a wheel on a roller"},
        Contradictory{rail().set("INFLCF", 4),
                      "test.inp:3:6: angle-corrected influence coefficients need the curved reference"},
        Contradictory{rail().set("BOUND", 5).set("DISCNS", 4),
                      "test.inp:2:5: conformal contact needs the full normal problem"},
        Contradictory{rail().set("MATER", 3).set("DISCNS", 3),
                      "test.inp:3:5: the simplified theory takes one creepage for a patch"},
        Contradictory{rail().set("MATER", 5).set("DISCNS", 4), "the simplified theory takes one creepage for a patch"},
        Contradictory{rail().set("MATER", 5).set("TANG", 2),
                      "test.inp:3:7: the simplified theory (fastrip) is for steady rolling"},
        Contradictory{rail().set("MATER", 2).set("TANG", 1),
                      "test.inp:3:7: the simplified theory (fastsim_one_flexibility) is for rolling, not for a shift"},
        Contradictory{viscoelastic_rail().set("TANG", 2), "test.inp:2:6: viscoelastic bodies need steady rolling"},
        Contradictory{viscoelastic_rail().line("velocity", "-2000. 0. 0. 0. 0. 4."),
                      "viscoelastic bodies must roll forward"},
        Contradictory{viscoelastic_rail().line("material", "0.31 0.28 23000. 82000."),
                      "test.inp:7:3: viscoelastic bodies must not be dissimilar"},
        Contradictory{viscoelastic_rail().set("INFLCF", 3),
                      "viscoelastic bodies need the half-space with constant elements"},
        Contradictory{rail().set("MATER", 4).line("layer", "8200. 1.25 30. 5.").line("grid", "0.4 0.5 0.5 90d 8. 4."),
                      "test.inp:8:14: a layer that yields needs a rolling step of one element: the step is 0.2 mm, "
                      "elements are 0.4 mm"},
        Contradictory{rail().set("HEAT", 3).set("TANG", 2), "test.inp:4:4: surface temperatures need steady rolling"},
        Contradictory{rail().set("FRCLAW", 6),
                      "test.inp:3:4: friction that depends on the temperature needs the thermal data"}));

TEST(ContactContradiction1, WhatGoesTogetherIsAccepted) {
  for (const ContactWriter& good :
       {viscoelastic_rail(), viscoelastic_rail().set("TANG", 0), rail().set("FORCE", 1).set("TANG", 1),
        rail().set("FORCE", 3).line("massless", "1. 0. 0. 0."),
        rail().set("DISCNS", 4).set("INFLCF", 4).set("VARFRC", 1), rail().set("BOUND", 5).set("TANG", 2),
        rail().set("DISCNS", 3).set("TANG", 1),
        rail().set("MATER", 4).line("layer", "8200. 1.25 30. 5.").set("TANG", 2),
        rail().set("FRCLAW", 6).set("HEAT", 3).set("VARFRC", 1)})
    EXPECT_EQ(cases_refusal(good.str()), "no error") << good.str();
}

}  // namespace
}  // namespace treadmark::io
