// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/tables/number.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "treadmark/io/files/text.hpp"

namespace treadmark::io {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

TEST(JsonNumber, IsRoundedToItsDigits) {
  EXPECT_EQ(dumped(number(0.1 + 0.2)), "0.3");
  EXPECT_EQ(dumped(number(1e3 * 0.0012345678901239)), "1.23456789012");
  EXPECT_EQ(dumped(number(2.0 / 3.0, Digits::six)), "0.666667");
  EXPECT_EQ(number(0.1 + 0.2, Digits::all).get<double>(), 0.1 + 0.2);
}

TEST(JsonNumber, IsARealWithoutSignOfZero) {
  EXPECT_EQ(dumped(number(3.0)), "3.0");
  EXPECT_EQ(dumped(number(-0.0)), "0.0");
  EXPECT_EQ(dumped(number(-0.0, Digits::all)), "0.0");
}

TEST(JsonNumber, IsNullWhereItIsNotFinite) {
  const double list[] = {1.0, kNotKnown, -kInfinite};
  EXPECT_EQ(dumped(numbers(list), -1), "[1.0,null,null]");
}

TEST(JsonText, KeepsNoBytesThatAreNoCharacters) {
  EXPECT_EQ(dumped(Json("a\xFF")), "\"a\xEF\xBF\xBD\"");
  EXPECT_EQ(dumped(text_or_null("")), "null");
}

TEST(CsvCell, IsEmptyWhereTheNumberIsNotFinite) {
  EXPECT_EQ(csv_cell(kNotKnown), "");
  EXPECT_EQ(csv_cell(kInfinite), "");
  EXPECT_EQ(csv_cell(0.1 + 0.2), "0.3");
  EXPECT_EQ(csv_cell(0.1 + 0.2, Digits::all), "0.30000000000000004");
}

}  // namespace
}  // namespace treadmark::io
