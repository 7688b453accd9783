// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <sstream>

#include "treadmark/io/cases/contact_program/contact_digits.hpp"
#include "treadmark/tests/io/cases/contact_writer.hpp"
#include "treadmark/tests/support/file_content.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

ContactWriter first_case_with(int module, const DigitValue& d) {
  ContactWriter w(module);
  w.set(std::string(d.keyword), std::max(0, d.value));
  if (d.keyword == "INFLCF" && d.value <= 1) w.set("INFLCF", d.value);
  return w;
}

struct Named {
  int module;
  DigitValue digit;
};
std::vector<Named> digits_that_are(DigitSupport support) {
  std::vector<Named> list;
  for (const DigitValue& d : contact_digits())
    for (const int module : {1, 3})
      if ((d.module == 0 || d.module == module) && d.support == support) list.push_back({module, d});
  return list;
}
std::string name_of(const ::testing::TestParamInfo<Named>& info) {
  return "Module" + std::to_string(info.param.module) + std::string(info.param.digit.keyword) +
         std::to_string(std::max(0, info.param.digit.value));
}

class UnsupportedDigit : public ::testing::TestWithParam<Named> {};

TEST_P(UnsupportedDigit, IsRefusedByNameValueMeaningAndPosition) {
  const auto& [module, d] = GetParam();
  const std::string text = first_case_with(module, d).str() + "0\n";
  const std::string expected = std::string(1, d.letter) + " (" + std::string(d.keyword) +
                               ") = " + std::to_string(d.value) + ", " + std::string(d.meaning) + ", is not supported";
  const std::string message = input_refusal(text);
  ASSERT_NE(message.find(expected), std::string::npos) << message;

  // The position points at the digit itself.
  int line = 0, column = 0;
  ASSERT_EQ(std::sscanf(message.c_str(), "folder/test.inp:%d:%d:", &line, &column), 2) << message;
  std::istringstream stream(text);
  std::string written;
  for (int i = 0; i < line; ++i) std::getline(stream, written);
  EXPECT_EQ(written.at(static_cast<std::size_t>(column) - 1), '0' + d.value) << written;
}

TEST_P(UnsupportedDigit, IsReadToItsEndWhenTheCaseIsSkipped) {
  const auto& [module, d] = GetParam();
  if ((module == 1 && d.keyword == "INFLCF" && d.value == 9) || (d.keyword == "MATER" && d.value >= 6))
    return;  // no grammar known
  // What follows must be found in its place, so the refused case has been read completely.
  const std::string text = first_case_with(module, d).set("RETURN", 3).str() + ContactWriter(module).str() + "0\n";
  const CaseFile f = parse_input(text);
  ASSERT_EQ(f.cases.size(), 1u);
  EXPECT_EQ(f.cases[0].number, 2);
}

INSTANTIATE_TEST_SUITE_P(All, UnsupportedDigit, ::testing::ValuesIn(digits_that_are(DigitSupport::no)), name_of);

class SupportedDigit : public ::testing::TestWithParam<Named> {};

TEST_P(SupportedDigit, IsAcceptedInASecondCase) {
  const auto& [module, d] = GetParam();
  EXPECT_EQ(parse_input(ContactWriter(module).str() +
                        first_case_with(module, d).set("RETURN", d.keyword == "RETURN" ? d.value : 1).str(true) +
                        (d.keyword == "RETURN" && d.value % 2 == 0 ? ContactWriter(module).str(false) : "") + "0\n")
                .cases.size(),
            d.keyword == "RETURN" ? (d.value == 0   ? 3u
                                     : d.value == 1 ? 2u
                                     : d.value == 2 ? 2u
                                                    : 1u)
                                  : 2u);
}

INSTANTIATE_TEST_SUITE_P(Yes, SupportedDigit, ::testing::ValuesIn(digits_that_are(DigitSupport::yes)), name_of);
INSTANTIATE_TEST_SUITE_P(NoEffect, SupportedDigit, ::testing::ValuesIn(digits_that_are(DigitSupport::no_effect)),
                         name_of);

TEST(ContactRefusal, DigitsThatDoNotExist) {
  EXPECT_NE(input_refusal(ContactWriter(1).set("TANG", 4).str()).find("T (TANG) = 4 does not exist in module 1"),
            std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(3).line("word1", "1203100").str()).find("at most 6"), std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(1).line("module", "2").str()).find("MODULE = 2 does not exist"),
            std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(1).line("word2", "-22033").str()).find("must not be negative"),
            std::string::npos);
}

TEST(ContactRefusal, DampingOfOnePatch) {
  const std::string text = ContactWriter(3).line("word2", "022020 2").line("damping", "1. 2. 3. 4.").str();
  EXPECT_NE(input_refusal(text).find(
                "test.inp:3:10: M2 (second integer of the line VLDCMZE) = 2, damping, is not supported in module 3"),
            std::string::npos);
}

TEST(ContactRefusal, PotentialContactThatIsTooLarge) {
  EXPECT_NE(
      input_refusal(ContactWriter(3).line("potcon", "10000 10000 0 0 1 1").str()).find("potential contact too large"),
      std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(3).line("potcon", "99999999 99999999 0 0 1 1").str())
                .find("potential contact too large"),
            std::string::npos);
}

TEST(ContactRefusal, KeptMethodsOfSkippedCases) {
  const std::string oblique = ContactWriter(1).set("DISCNS", 8).set("RETURN", 3).str();
  EXPECT_NE(input_refusal(oblique + ContactWriter(1).set("DISCNS", 1).str()).find("D (DISCNS) = 1 keeps D = 8"),
            std::string::npos);
  const std::string thermal = ContactWriter(1).set("FRCLAW", 6).set("RETURN", 3).str();
  EXPECT_NE(input_refusal(thermal + ContactWriter(1).set("FRCLAW", 1).str())
                .find("test.inp:19:4: friction that depends on the temperature"),
            std::string::npos);
  const std::string corrected = ContactWriter(1).set("INFLCF", 4).set("RETURN", 3).str();
  EXPECT_NE(input_refusal(corrected + ContactWriter(1).set("INFLCF", 1).str())
                .find("angle-corrected influence coefficients need the curved reference"),
            std::string::npos);
}

TEST(ContactRefusal, AllRefusalsOfACaseAreTold) {
  const std::string message = input_refusal(ContactWriter(1).set("DISCNS", 8).set("HEAT", 3).set("TANG", 0).str());
  EXPECT_NE(message.find("D (DISCNS) = 8"), std::string::npos);
  EXPECT_NE(message.find("also line 4: surface temperatures need steady rolling"), std::string::npos) << message;
  // where reading must stop because nobody knows which lines follow
  const std::string stopped = input_refusal(ContactWriter(1).set("FORCE", 2).set("DISCNS", 8).set("INFLCF", 9).str());
  for (const char* one : {"F (FORCE) = 2", "also line 3: D (DISCNS) = 8", "also line 3: C (INFLCF) = 9"})
    EXPECT_NE(stopped.find(one), std::string::npos) << one << ": " << stopped;
  const std::string strip = input_refusal(ContactWriter(1).set("FORCE", 2).set("MATER", 6).str());
  EXPECT_NE(strip.find("also line 3: M (MATER) = 6"), std::string::npos) << strip;
}

TEST(ContactFirstCase, HasNothingToKeep) {
  EXPECT_NE(input_refusal(ContactWriter(1).set("FRCLAW", 1).str()).find("L (FRCLAW) = 1 in the first case"),
            std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(1).set("DISCNS", 0).str()).find("D (DISCNS) = 0 in the first case"),
            std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(3).set("DISCNS", 1).str()).find("D (DISCNS) = 1 in the first case"),
            std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(1).set("INFLCF", 1).str()).find("keeps the material"), std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(1).set("ZTRACK", 2).str()).find("keeps the rail"), std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(1).set("EWHEEL", 2).str()).find("keeps the wheel"), std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(3).set("RZNORM", 0).str()).find("keeps the undeformed distance"),
            std::string::npos);
}

TEST(ContactRules, NeedCertainLines) {
  ContactWriter switched(1);
  switched.set("NORM", 0).set("EWHEEL", 0);
  EXPECT_NE(input_refusal(ContactWriter(1).str() + switched.str()).find("needs E (EWHEEL) > 0"), std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(3).set("TANG", 0).str() + ContactWriter(3).set("INFLCF", 0).str())
                .find("rolling line CHI"),
            std::string::npos);
  EXPECT_NE(
      input_refusal(ContactWriter(3).str() + ContactWriter(3).set("INFLCF", 0).set("MATER", 3).str()).find("K0_MF"),
      std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(3).str() + ContactWriter(3).set("INFLCF", 0).set("MATER", 4).str()).find("GG3"),
            std::string::npos);
  EXPECT_NE(input_refusal(ContactWriter(1).line("rail", "'a.slcs' 0 1. 0.").str()).find("GAUGHT <= 0"),
            std::string::npos);
  const std::string each = ContactWriter(3).line("ibase", "9 1").line("gap", "1 2 3 4 5 6").str();
  EXPECT_NE(input_refusal(each + ContactWriter(3).set("RZNORM", 0).line("potcon", "4 4 0 0 1 1").str())
                .find("number of elements has changed"),
            std::string::npos);
}

struct WrongLine {
  int module;
  const char *line, *text, *expected;
};
class WrongValue : public ::testing::TestWithParam<WrongLine> {};
TEST_P(WrongValue, IsNamed) {
  const WrongLine& w = GetParam();
  const std::string message = input_refusal(ContactWriter(w.module).line(w.line, w.text).str() + "0\n");
  EXPECT_NE(message.find(w.expected), std::string::npos) << message;
  EXPECT_EQ(message.rfind("folder/test.inp:", 0), 0u) << message;
}
INSTANTIATE_TEST_SUITE_P(
    Lines, WrongValue,
    ::testing::Values(
        WrongLine{1, "solver", "999 abc 30 1 1e-5", "expected MAXIN (an integer) of the line MAXGS, found 'abc'"},
        WrongLine{1, "solver", "999 -1 30 1 1e-5", "MAXIN"},
        WrongLine{1, "solver", "999 1 30 1 0.0", "EPS must be positive"},
        WrongLine{1, "friction", "0.3 0.2", "must equal FSTAT"}, WrongLine{1, "friction", "0.0 0.0", "at least 0.0001"},
        WrongLine{1, "material", "0.28 0.6 82000. 82000.", "POISS2 = 0.6"},
        WrongLine{1, "material", "0.28 0.28 0. 82000.", "GG1 must be positive"},
        WrongLine{1, "grid", "0. 0.4 1. 90d 8. 4.", "DX must be positive"},
        WrongLine{1, "grid", "0.4 0.4 1. 90d 3. 4.", "D_SEP must not be less"},
        WrongLine{1, "track", "14. 0 -1435. 0.", "GAUGWD must be positive"},
        WrongLine{1, "rail", "rail.prr 0 1. 0.", "the file name (text in single quotes)"},
        WrongLine{1, "rail", "'a.prr' 2 1. 0.", "MIRRORY"}, WrongLine{1, "rail", "'a.prr' 0 0. 0.", "SCALE"},
        WrongLine{1, "rail", "'a.prr' 0 1. -1.", "SMOOTH"}, WrongLine{1, "rail", "'a.prr' 0 1. 0. 3", "MIRRORZ"},
        WrongLine{1, "rail", "'a.prr' 0 1. 0. 0 3", "PRFOPT"}, WrongLine{1, "rail", "'' 0 1. 0.", "no file name"},
        WrongLine{1, "rail", "'a.prr' 0 1. 0. 0 1\n 5 1 1 1 1", "ISMOOTH"},
        WrongLine{1, "rail", "'a.prr' 0 1. 0. 0 1\n 0 1 1 2 1", "KINKLOW"},
        WrongLine{1, "wheelset", "1360. -70. 0.", "NOMRAD must be positive"},
        WrongLine{1, "position", "0. 0. 1d5x 0. 0. 0.", "expected FZ (a number)"},
        WrongLine{1, "position", "0. 0. 1e5 0. 0. PITCH,", "expected PITCH (an angle)"},
        WrongLine{3, "kinematics", "1. x", "expected CKSI"},
        WrongLine{3, "rolling", "0. 0. 1000.", "DQ must be positive"},
        WrongLine{3, "rolling", "0. 0.4 0.", "VELOC must be positive"},
        WrongLine{3, "ipotcn", "0", "IPOTCN = 0 does not exist"},
        WrongLine{3, "ipotcn", "5", "IPOTCN = 5 does not exist"},
        WrongLine{3, "potcon", "0 2 0 0 1 1", "MX and MY must be positive"},
        WrongLine{3, "potcon", "3 2 0 0 0. 1", "DX must be positive"},
        WrongLine{3, "ibase", "4 1", "IBASE = 4 does not exist"},
        WrongLine{3, "ibase", "1 5", "IPLAN = 5 does not exist"}, WrongLine{3, "gap", "1 2 3 4 5 six", "expected B6"}));

/// A file that breaks off anywhere but between cases is an error that says so.
class Truncated : public ::testing::TestWithParam<int> {};
TEST_P(Truncated, IsToldWhereItEnds) {
  ContactWriter w(GetParam());
  w.set("FRCLAW", 4);
  const std::string text = w.str();
  std::vector<std::size_t> ends;
  for (std::size_t i = text.find('\n'); i + 1 < text.size(); i = text.find('\n', i + 1)) ends.push_back(i);
  ASSERT_GT(ends.size(), 8u);
  for (const std::size_t end : ends)
    EXPECT_NE(input_refusal(text.substr(0, end)).find("the file ends"), std::string::npos) << text.substr(0, end);
  EXPECT_NE(input_refusal("").find("contains no case"), std::string::npos);
  EXPECT_NE(input_refusal("% only a comment\n").find("contains no case"), std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(Modules, Truncated, ::testing::Values(1, 3));

TEST(ContactDocumentation, TableOfDigitsIsUpToDate) {
  treadmark::testing::expect_in_document("contact-input.md", contact_digit_table());
}

}  // namespace
}  // namespace treadmark::io
