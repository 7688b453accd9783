// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/line_scanner.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace treadmark::io::profiles {
namespace {

double number(std::string_view text) {
  LineScanner scanner(text, "sample");
  scanner.next_line();
  return to_number(scanner, *scanner.next_word());
}

TEST(LineScanner, AcceptsEveryUsualSpellingOfNumbers) {
  EXPECT_EQ(number("1"), 1.0);
  EXPECT_EQ(number("+1.5"), 1.5);
  EXPECT_EQ(number("-.5"), -0.5);
  EXPECT_EQ(number("1000."), 1000.0);
  EXPECT_EQ(number("1e-5"), 1e-5);
  EXPECT_EQ(number("1E+5"), 1e5);
  EXPECT_EQ(number("1d-5"), 1e-5);
  EXPECT_EQ(number("-2.5D+03"), -2500.0);
  EXPECT_EQ(number("+1.000000000000000e+03"), 1000.0);
}

TEST(LineScanner, RefusesWhatIsNoNumber) {
  for (const char* word :
       {"abc", "1.2.3", "1e", "1d", "1dx", "--1", "+-1", "+", "-", ".", "0x10", "1,5", "1e5e", "\x80\xff"})
    TREADMARK_EXPECT_ERROR(number(word), "a number is expected", 1, 1);
  TREADMARK_EXPECT_ERROR(number("1,5"), "write decimal points", 1, 1);
}

TEST(LineScanner, RefusesNumbersThatAreNotFinite) {
  for (const char* word : {"nan", "NaN", "inf", "-inf", "+Infinity"})
    TREADMARK_EXPECT_ERROR(number(word), "is not finite", 1, 1);
  for (const char* word : {"1e999", "-1d999"}) TREADMARK_EXPECT_ERROR(number(word), "out of range", 1, 1);
}

TEST(LineScanner, RefusesWhatIsNoWholeNumber) {
  for (const char* word : {"1.5", "x", "99999999999", "-2000000000", ""}) {
    LineScanner scanner("0", "sample");
    scanner.next_line();
    TREADMARK_EXPECT_ERROR(to_integer(scanner, Word{word, 3}), "a whole number is expected", 1, 3);
  }
}

TEST(LineScanner, CountsLinesWithEveryKindOfLineEnd) {
  LineScanner scanner(
      "\xEF\xBB\xBF"
      "a\nb\r\nc\rd",
      "sample");
  std::string words;
  while (scanner.next_line()) words += std::string(scanner.next_word()->text) + std::to_string(scanner.number());
  EXPECT_EQ(words, "a1b2c3d4");
}

TEST(LineScanner, TellsTheColumnOfAWord) {
  LineScanner scanner("  one\ttwo ", "sample");
  scanner.next_line();
  EXPECT_EQ(scanner.next_word()->column, 3);
  EXPECT_EQ(scanner.next_word()->column, 7);
  EXPECT_FALSE(scanner.next_word().has_value());
}

TEST(LineScanner, RefusesNulBytes) {
  TREADMARK_EXPECT_ERROR(LineScanner(std::string("ab\ncd\0e", 7), "sample"), "NUL byte", 2, 3);
}

TEST(LineScanner, ShowsStrangeCharactersHarmlessly) {
  EXPECT_EQ(printable("a\x1b[31m\x80"), "'a?[31m?'");
  EXPECT_EQ(printable(std::string(1000, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(LineScanner, RefusesTooManyLines) {
  const std::string text(kMaxLines + 1, '\n');
  LineScanner scanner(text, "sample");
  TREADMARK_EXPECT_ERROR(
      [&] {
        while (scanner.next_line()) {
        }
      }(),
      "more than 10 million lines", kMaxLines, 0);
}

}  // namespace
}  // namespace treadmark::io::profiles
