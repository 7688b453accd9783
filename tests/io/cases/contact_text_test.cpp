// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/contact_program/contact_text.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace treadmark::io {
namespace {

TEST(ContactText, RecordSpansLinesAndDropsTrailingWords) {
  ContactText text("% comment\n\n 1 2 % two\n\n   3 words behind\n 4 5 6\n", "a.inp");
  text.begin_record("first");
  EXPECT_EQ(text.integer("A"), 1);
  EXPECT_EQ(text.integer("B"), 2);
  EXPECT_EQ(text.integer("C"), 3);
  EXPECT_EQ(text.where().line, 5);
  EXPECT_EQ(text.where().column, 4);
  text.begin_record("second");
  EXPECT_EQ(text.integer("D"), 4);
  EXPECT_EQ(text.optional_integer(), 5);
}

TEST(ContactText, OptionalValuesStayOnTheirLine) {
  ContactText text("1\n2\n3 x 4\n", "a.inp");
  text.begin_record("first");
  text.integer("A");
  EXPECT_FALSE(text.optional_real());
  text.begin_record("second");
  EXPECT_EQ(text.integer("B"), 2);
  text.begin_record("third");
  EXPECT_EQ(text.integer("C"), 3);
  EXPECT_FALSE(text.optional_real());  // stops at the first word that is no number
}

TEST(ContactText, RealsKnowFortranExponents) {
  ContactText text(" 1e-5 1d-5 .5 -.5 5. +3 0.8200E+05 1D3", "a.inp");
  text.begin_record("reals");
  for (const double expected : {1e-5, 1e-5, 0.5, -0.5, 5.0, 3.0, 82000.0, 1000.0})
    EXPECT_DOUBLE_EQ(text.real("R"), expected);
}

TEST(ContactText, ExponentsNeedNoLetter) {
  ContactText text(".1-07 1.5+3 -2.5-3 1-5 6.-2 1.5-3d", "a.inp");
  text.begin_record("reals");
  for (const double expected : {1e-8, 1500.0, -2.5e-3, 1e-5, 0.06}) EXPECT_DOUBLE_EQ(text.real("R"), expected);
  EXPECT_DOUBLE_EQ(text.angle("A"), 1.5e-3 * std::numbers::pi / 180.0);
  ContactText wrong("1-5-3", "a.inp");
  wrong.begin_record("reals");
  EXPECT_THROW(wrong.real("R"), Error);
}

TEST(ContactText, IntegersMayBeWholeReals) {
  ContactText text("0.0 1. -3.0 2e2\n 1 2.0", "a.inp");
  text.begin_record("integers");
  for (const long expected : {0, 1, -3, 200}) EXPECT_EQ(text.integer("I"), expected);
  EXPECT_EQ(text.integer("I"), 1);
  EXPECT_EQ(text.optional_integer(), 2);
  for (const char* wrong : {"0.5", "1e30", "1.5 2"}) {
    ContactText half(wrong, "a.inp");
    half.begin_record("integers");
    EXPECT_THROW(half.integer("I"), Error) << wrong;
  }
  ContactText behind("1 0.5", "a.inp");
  behind.begin_record("integers");
  behind.integer("I");
  EXPECT_THROW(behind.optional_integer(), Error);  // a value that would be lost
}

TEST(ContactText, CommasSeparate) {
  ContactText text("1,2 , 3,\n 4, 'a,b', .5,6.\n", "a.inp");
  text.begin_record("values");
  for (const long expected : {1, 2, 3, 4}) EXPECT_EQ(text.integer("I"), expected);
  EXPECT_EQ(text.quoted("Q"), "a,b");
  EXPECT_DOUBLE_EQ(text.real("R"), 0.5);
  EXPECT_DOUBLE_EQ(text.real("R"), 6.0);
  EXPECT_TRUE(text.at_end());
}

TEST(ContactText, CommasThatMayMeanSomethingElseAreRefused) {
  const auto error_of = [](const char* text) {
    ContactText input(text, "a.inp");
    input.begin_record("values");
    try {
      for (int i = 0; i < 4; ++i) input.real("R");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(error_of("0.28 0,28 82000 82000").find("a.inp:1:6: '0,28' may be two values"), std::string::npos);
  EXPECT_NE(error_of("1,,2 3 4").find("nothing between two commas"), std::string::npos);
  EXPECT_EQ(error_of("1,2,3,4"), "no error");
  EXPECT_EQ(error_of("1,2, 3, 4 R1, R2"), "no error");
  EXPECT_EQ(error_of("0.28,0.28 82000. 82000."), "no error");
}

TEST(ContactText, AnglesHaveSuffixes) {
  ContactText text("90d -25.0d 180.d 0.5r 0.5 90D", "a.inp");
  text.begin_record("angles");
  const double degree = std::numbers::pi / 180.0;
  for (const double expected : {90 * degree, -25 * degree, 180 * degree, 0.5, 0.5, 90 * degree})
    EXPECT_DOUBLE_EQ(text.angle("A"), expected);
}

TEST(ContactText, QuotesProtectBlanksAndPercent) {
  ContactText text("'my file%1.prr' 0 it's 1", "a.inp");
  text.begin_record("profile");
  EXPECT_EQ(text.quoted("the file name"), "my file%1.prr");
  EXPECT_EQ(text.integer("MIRRORY"), 0);
}

TEST(ContactText, CommentWithApostropheStaysAComment) {
  ContactText text("1 % the wheel's flat 2\n3 'a' % x'y\n", "a.inp");
  text.begin_record("first");
  EXPECT_EQ(text.integer("A"), 1);
  EXPECT_EQ(text.integer("B"), 3);
  EXPECT_EQ(text.quoted("Q"), "a");
  EXPECT_FALSE(text.optional_integer());
}

struct WrongWord {
  const char* text;
  const char* expected;
};
class ContactTextError : public ::testing::TestWithParam<WrongWord> {};

TEST_P(ContactTextError, NamesValueAndPosition) {
  ContactText text(GetParam().text, "a.inp");
  try {
    text.begin_record("the line MX");
    text.integer("MX");
    text.real("DX");
    text.quoted("NAME");
    FAIL() << "no error for " << GetParam().text;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_NE(std::string(error.what()).find(GetParam().expected), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Words, ContactTextError,
    ::testing::Values(WrongWord{"x 1", "a.inp:1:1: expected MX (an integer) of the line MX, found 'x'"},
                      WrongWord{"\n 1.5 1", "a.inp:2:2: expected MX (an integer)"},
                      WrongWord{"1 nan", "a.inp:1:3: expected DX (a number)"}, WrongWord{"1 inf", "expected DX"},
                      WrongWord{"1 0x10", "expected DX"}, WrongWord{"1 1e999", "expected DX"},
                      WrongWord{"1 1,5", "'1,5' may be two values"}, WrongWord{"1 '2'", "expected DX"},
                      WrongWord{"99999999999999999999 1", "expected MX"},
                      WrongWord{"1 2 name", "expected NAME (text in single quotes)"},
                      WrongWord{"1 2 'open", "expected NAME"},
                      WrongWord{"", "the file ends where the line MX is expected"},
                      WrongWord{"1 % 2", "the file ends in the line MX: expected DX"}));

}  // namespace
}  // namespace treadmark::io
