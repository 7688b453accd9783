// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/contact_text.hpp"

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
                      WrongWord{"1 1,5", "expected DX"}, WrongWord{"1 '2'", "expected DX"},
                      WrongWord{"99999999999999999999 1", "expected MX"},
                      WrongWord{"1 2 name", "expected NAME (text in single quotes)"},
                      WrongWord{"1 2 'open", "expected NAME"},
                      WrongWord{"", "the file ends where the line MX is expected"},
                      WrongWord{"1 % 2", "the file ends in the line MX: expected DX"}));

}  // namespace
}  // namespace treadmark::io
