// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "treadmark/tests/io/cases/contact_writer.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

class Contradiction3 : public ::testing::TestWithParam<Contradictory> {};

TEST_P(Contradiction3, IsRefusedAtItsDigit) {
  EXPECT_THAT(cases_refusal(GetParam().input.str()), ::testing::HasSubstr(GetParam().expected));
}
TEST_P(Contradiction3, IsNoneInASkippedCase) {
  ContactWriter skipped = GetParam().input;
  EXPECT_EQ(cases_refusal(skipped.set("RETURN", 3).str() + basic().str()), "no error");
}

const std::string kAluminium = "0.31 0.28 23000. 82000.";
ContactWriter viscoelastic_basic() { return basic().set("MATER", 1); }
ContactWriter yielding() {
  return basic().set("MATER", 4).line("layer", "8200. 1.25 30. 0.").line("rolling", "0. 1.0 30000.");
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Contradiction3,
    ::testing::Values(
        Contradictory{basic().line("rolling", "90d 0.4 30000."),
                      "test.inp:2:5: steady rolling in direction 1.5708 rad is not supported"},
        Contradictory{basic().set("BOUND", 2), "test.inp:2:4: elliptic and parabolic pressures need Hertzian geometry"},
        Contradictory{basic().set("BOUND", 4),
                      "test.inp:2:4: semi-double-elliptic pressure (SDEC) and semi-double-elliptic geometry need"},
        Contradictory{basic().line("ipotcn", "-6").line("potcon", "4 4 1. 1. 1. 1.1").line("hertz", ""),
                      "geometry need each other"},
        Contradictory{basic().set("BOUND", 5), "test.inp:2:6: KPEC needs a prescribed approach"},
        Contradictory{basic().set("BOUND", 6), "ANALYN needs a prescribed approach"},
        Contradictory{basic().set("MATER", 3).set("TANG", 1), "test.inp:3:7: the simplified theory"},
        Contradictory{basic().set("MATER", 5).set("TANG", 2),
                      "is for steady rolling, not for a shift or transient rolling"},
        Contradictory{viscoelastic_basic().set("TANG", 1), "test.inp:2:5: viscoelastic bodies need steady rolling"},
        Contradictory{viscoelastic_basic().set("TANG", 2), "viscoelastic bodies need steady rolling"},
        Contradictory{viscoelastic_basic().line("rolling", "180d 0.4 30000."),
                      "viscoelastic bodies must roll in direction 0, found 3.14159 rad"},
        Contradictory{viscoelastic_basic().line("material", kAluminium), "viscoelastic bodies must not be dissimilar"},
        Contradictory{viscoelastic_basic().set("INFLCF", 3),
                      "test.inp:3:6: viscoelastic bodies need the half-space with constant elements"},
        Contradictory{viscoelastic_basic().set("BOUND", 5).set("NORM", 0),
                      "viscoelastic bodies need the full normal and tangential problem"},
        Contradictory{yielding().line("rolling", "0. 0.4 30000."),
                      "a layer that yields needs a rolling step of one element: the step is 0.4 mm, elements are 1 mm"},
        Contradictory{yielding().set("TANG", 2).line("rolling", "30d 1.0 30000."),
                      "a layer that yields must roll in direction 0 or pi"},
        Contradictory{basic().set("INFLCF", 4).set("BOUND", 5).set("NORM", 0),
                      "angle-corrected influence coefficients need the full normal problem"},
        Contradictory{basic().set("INFLCF", 9).set("BOUND", 6).set("NORM", 0),
                      "test.inp:3:6: numerical influence coefficients need the full normal problem"},
        Contradictory{basic().set("HEAT", 3).set("TANG", 2), "test.inp:4:4: surface temperatures need steady rolling"},
        Contradictory{basic().set("FRCLAW", 6),
                      "test.inp:3:4: friction that depends on the temperature needs the thermal data"},
        Contradictory{
            basic().set("STRESS", 3).line("block", "9\n 1 1 1\n 0.\n 0.\n 1.\n 2\n 1 1 4\n 1 1 2\n 1 0. 1.\n 0"),
            "test.inp:2:8: subsurface points lie outside the 3 x 2 elements"}));

TEST(ContactContradiction, WhatGoesTogetherIsAccepted) {
  for (const ContactWriter& good :
       {viscoelastic_basic().set("TANG", 0), yielding(), yielding().set("TANG", 1), yielding().set("TANG", 2),
        basic().set("INFLCF", 4).set("MATER", 3), basic().set("FRCLAW", 6).set("HEAT", 3),
        basic().line("rolling", "-180d 0.4 30000."), basic().set("BOUND", 1).set("INFLCF", 9),
        basic().line("ibase", "1 4").line("gap", "0.001 0 0.001 0 0 0\n 2\n 0 1 0 1\n 0 1 2 3\n 0.1")})
    EXPECT_EQ(cases_refusal(good.str()), "no error") << good.str();
}

TEST(ContactContradiction, KeptDataThatWereNeverGiven) {
  const std::string first = basic().str();
  EXPECT_THAT(cases_refusal(first + keeping_basic().set("BOUND", 1).str()),
              ::testing::HasSubstr("B (BOUND) = 1 needs the line FLXZ"));
  EXPECT_THAT(cases_refusal(first + keeping_basic().set("MATER", 1).str()),
              ::testing::HasSubstr("M (MATER) = 1 needs the line FG1"));
  EXPECT_THAT(cases_refusal(first + keeping_basic().set("MATER", 2).str()),
              ::testing::HasSubstr("M (MATER) = 2 needs the line K0_MF"));
  EXPECT_THAT(cases_refusal(basic().set("MATER", 3).str() + keeping_basic().set("MATER", 2).str()),
              ::testing::HasSubstr("needs FLX"));
  EXPECT_THAT(cases_refusal(basic().set("HEAT", 1).str()),
              ::testing::HasSubstr("test.inp:4:4: H (HEAT) = 1 keeps the thermal data"));
  EXPECT_THAT(cases_refusal(first + keeping_basic().set("STRESS", 1).str()),
              ::testing::HasSubstr("S (STRESS) = 1 uses subsurface points of an earlier case"));
  EXPECT_THAT(cases_refusal(first + keeping_basic().set("VARFRC", 3).str()),
              ::testing::HasSubstr("L (FRCLAW) = 1 keeps the friction law, but none for each of 2 rows"));
  EXPECT_THAT(cases_refusal(ContactWriter(1).str() + ContactWriter(1).set("VARFRC", 2).set("FRCLAW", 1).str()),
              ::testing::HasSubstr("none for V (VARFRC) = 2"));
  const std::string other_grid = keeping_basic().set("DISCNS", 2).set("EXRHS", 1).line("potcon", "2 2 0 0 1 1").str();
  EXPECT_THAT(cases_refusal(basic().set("EXRHS", 9).str() + other_grid),
              ::testing::HasSubstr("E (EXRHS) = 1 keeps the extra rigid slip of every element"));
  const std::string fewer = keeping_basic().set("DISCNS", 2).set("STRESS", 1).line("potcon", "1 1 0 0 1 1").str();
  EXPECT_THAT(cases_refusal(basic().set("STRESS", 3).str() + fewer),
              ::testing::HasSubstr("subsurface points lie outside the 1 x 1 elements"));
}

TEST(ContactContradiction, GridOfACaseThatContinues) {
  const auto second = [](const char* grid) {
    return basic().set("TANG", 2).str() +
           keeping_basic().set("PVTIME", 0).set("TANG", 2).set("DISCNS", 2).line("potcon", grid).str();
  };
  EXPECT_EQ(cases_refusal(second("4 3 0.5 -2.0 1. 1.")), "no error");  // two columns and a row further
  EXPECT_THAT(parse_input(second("4 3 0.5 -2.0 1. 1.")).notes,
              ::testing::Not(::testing::Contains(::testing::HasSubstr("averaged"))));
  for (const char* other : {"3 2 -1.25 -1.0 1. 1.", "3 2 -1.5 -1.0 1. 0.5"})
    EXPECT_THAT(parse_input(second(other)).notes,
                ::testing::Contains(::testing::HasSubstr("averaged over each new element")));
  const std::string fine = "3 2 -1.5 -1.0 1. 0.5";
  EXPECT_EQ(cases_refusal(basic().str() + keeping_basic().set("DISCNS", 2).set("PVTIME", 0).line("potcon", fine).str()),
            "no error");  // steady rolling
  EXPECT_EQ(cases_refusal(basic().str() + keeping_basic().set("DISCNS", 2).set("TANG", 1).line("potcon", fine).str()),
            "no error");  // P = 2
}

TEST(ContactContradiction, SimplifiedTheoryKnowsNoSpinInOneDirection) {
  for (const int digit : {2, 3})
    EXPECT_THAT(cases_refusal(basic().set("EXRHS", digit).set("MATER", 3).str()),
                ::testing::HasSubstr("the simplified theory takes no slip that is given for every element"));
}

struct WrongBasicLine {
  int digits[2];  // value of the digit named in name
  const char *name, *line, *text, *expected;
};
class WrongBasicValue : public ::testing::TestWithParam<WrongBasicLine> {};
TEST_P(WrongBasicValue, IsNamedWithItsPlace) {
  const WrongBasicLine& w = GetParam();
  ContactWriter input = basic();
  input.set(w.name, w.digits[0]).set("HEAT", w.digits[1]).line(w.line, w.text);
  const std::string message = cases_refusal(input.str());
  EXPECT_THAT(message, ::testing::HasSubstr(w.expected));
  int line = 0, column = 0;
  EXPECT_EQ(std::sscanf(message.c_str(), "folder/test.inp:%d:%d:", &line, &column), 2) << message;
  EXPECT_GT(line, 4);
  EXPECT_GT(column, 1);
}
INSTANTIATE_TEST_SUITE_P(
    Lines, WrongBasicValue,
    ::testing::Values(
        WrongBasicLine{{1, 0}, "MATER", "viscoelastic", "1. 1. 0. -1.", "TC2 must not be negative"},
        WrongBasicLine{{1, 0}, "MATER", "viscoelastic", "-1. 1. 0. 0.", "FG1 must not be negative"},
        WrongBasicLine{{1, 0}, "BOUND", "flxz", "-1.", "FLXZ must not be negative"},
        WrongBasicLine{{2, 0}, "MATER", "simplified", "0. 1 1 1", "FLX must be positive"},
        WrongBasicLine{{4, 0}, "MATER", "layer", "0. 1. 0. 0.", "GG3 must be positive"},
        WrongBasicLine{{4, 0}, "MATER", "layer", "1. -1. 0. 0.", "LAYTHK must not be negative"},
        WrongBasicLine{{0, 3}, "MATER", "heat1", "0. 0. 1. 1.", "HEATCP must be positive"},
        WrongBasicLine{{4, 3}, "MATER", "betapl", "1.5", "BETAPL must lie in 0 ... 1"},
        WrongBasicLine{{6, 3}, "FRCLAW", "friction", "0.3 20. -0.4 100.", "FREF + DFHEAT = -0.1"},
        WrongBasicLine{{6, 3}, "FRCLAW", "friction", "0.3 20. -0.1 0.", "DTHEAT must be positive"},
        WrongBasicLine{{4, 0}, "INFLCF", "ifmeth", "2 4 2", "IF_METH = 2 does not exist"},
        WrongBasicLine{{4, 0}, "INFLCF", "ifmeth", "0 5 2", "VARIANT = 5 does not exist"},
        WrongBasicLine{{4, 0}, "INFLCF", "ifmeth", "0 4 1", "NN must be at least 2"},
        WrongBasicLine{
            {4, 0}, "INFLCF", "angles", "1. 0. 1. 0.", "S of the table of surface inclinations must increase"},
        WrongBasicLine{{9, 0}, "INFLCF", "cff", "''", "has no name"},
        WrongBasicLine{{3, 0}, "STRESS", "stress", "3 0", "MATFIL = 3 of the subsurface output"},
        WrongBasicLine{{3, 0}, "STRESS", "block", "4", "ISUBS = 4 does not exist"},
        WrongBasicLine{{3, 0}, "STRESS", "block", "2\n 2 1 1", "IXH must not be less than IXL"},
        WrongBasicLine{{3, 0}, "STRESS", "block", "2\n 0 1 1", "IXL = 0 is not the number"},
        WrongBasicLine{{3, 0}, "STRESS", "block", "2\n 1 0 1", "IXINC must be positive"},
        WrongBasicLine{{3, 0}, "STRESS", "block", "1\n 999999999 0. 1.", "NZ = 999999999 is more than"}));

TEST(ContactPlanformErrors, AreNamed) {
  const auto plan = [](const char* kind, const char* lines) {
    return cases_refusal(basic()
                             .line("ibase", "1 " + std::string(kind))
                             .line("gap", std::string("0.001 0 0.001 0 0 0\n ") + lines)
                             .str());
  };
  EXPECT_THAT(plan("3", "0 1 2 3 4 5 7 6"), ::testing::HasSubstr("the two rectangles of the planform has no extent"));
  EXPECT_THAT(plan("4", "0"), ::testing::HasSubstr("NPATCH must lie in 1 ... 100"));
  EXPECT_THAT(plan("4", "2\n 0 1 0 1\n 0 1 2 3\n 1.5"),
              ::testing::HasSubstr("the coupling factor 1.5 lies outside 0 ... 1"));
}

}  // namespace
}  // namespace treadmark::io
