// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/io/simulations/read_irregularities.hpp"
#include "treadmark/tests/support/mutation.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;

const std::string kTable =
    "# made up\n"
    "distance_m,longitudinal_level_mm,cross_level_mm,alignment_mm,gauge_mm\n"
    "0.00, 0.1, -0.2, 0.3, 1.5\n"
    "0.25, 0.2, -0.1, 0.4, 1.4\n"
    "\n"
    "0.75, 0.3,  0.0, 0.5, 1.3\n"
    "1.00, 0.4,  0.1, 0.6, -1.2e0\n";

TEST(IrregularityFile, ColumnsAreReadByName) {
  const IrregularityTable table = parse_irregularity_text(kTable, "t.csv");
  EXPECT_THAT(table.distance, ::testing::ElementsAre(0.0, 0.25, 0.75, 1.0));
  EXPECT_THAT(table.values[0], ::testing::Pointwise(::testing::DoubleEq(), {1e-4, 2e-4, 3e-4, 4e-4}));
  EXPECT_THAT(table.values[1], ::testing::Pointwise(::testing::DoubleEq(), {-2e-4, -1e-4, 0.0, 1e-4}));
  EXPECT_THAT(table.values[2], ::testing::Pointwise(::testing::DoubleEq(), {3e-4, 4e-4, 5e-4, 6e-4}));
  EXPECT_THAT(table.values[3], ::testing::Pointwise(::testing::DoubleEq(), {1.5e-3, 1.4e-3, 1.3e-3, -1.2e-3}));
}

TEST(IrregularityFile, RailsBecomeTheTrack) {
  // Semicolons, decimal commas, kilometres, micrometres, a column that nobody uses, names in quotes and capitals.
  std::vector<std::string> notes;
  const IrregularityTable table = parse_irregularity_text(
      "\"Alignment_left_um\";speed_kmh;alignment_right_um;distance_km\r\n100;80;300;0,001\r\n-50;80;50;0,002\r\n"
      "0;80;0;0,003\r\n1,5;x;2,5;0,004\r\n",
      "t.csv", &notes);
  EXPECT_THAT(table.distance, ::testing::Pointwise(::testing::DoubleEq(), {1.0, 2.0, 3.0, 4.0}));
  EXPECT_THAT(table.values[2], ::testing::Pointwise(::testing::DoubleNear(1e-18), {2e-4, 0.0, 0.0, 2e-6}));
  EXPECT_THAT(table.values[3], ::testing::Pointwise(::testing::DoubleNear(1e-18), {2e-4, 1e-4, 0.0, 1e-6}));
  EXPECT_TRUE(table.values[0].empty());
  EXPECT_THAT(notes, ::testing::ElementsAre(HasSubstr("columns that are not used: 'speed_kmh'")));
}

TEST(IrregularityFile, WhatIsWrittenIsReadAgainToTheBit) {
  IrregularityTable table;
  Random random(11);
  for (int i = 0; i < 500; ++i) {
    table.distance.push_back((table.distance.empty() ? -3.0 : table.distance.back()) + 0.01 + random.uniform());
    for (const std::size_t f : {0u, 2u}) table.values[f].push_back(0.02 * (random.uniform() - 0.5));
    table.values[3].push_back(0.125 * i * kMillimetre);  // numbers that are exact in millimetres
  }
  const treadmark::testing::TemporaryFolder folder;
  const std::string text = irregularity_text(table);
  EXPECT_TRUE(text.starts_with("distance_m,longitudinal_level_m,alignment_m,gauge_mm\n")) << text.substr(0, 100);
  folder.write("t.csv", text);
  const IrregularityTable again = read_irregularity_file(folder.path() / "t.csv");
  EXPECT_EQ(again.distance, table.distance);
  EXPECT_EQ(again.values, table.values);
}

struct WrongTable {
  std::string part, other, expected;
};
class IrregularityFileError : public ::testing::TestWithParam<WrongTable> {};
TEST_P(IrregularityFileError, TellsPlaceAndReason) {
  std::string text = kTable;
  const std::size_t at = text.find(GetParam().part);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, GetParam().part.size(), GetParam().other);
  try {
    parse_irregularity_text(text, "t.csv");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    EXPECT_THAT(error.what(), HasSubstr(GetParam().expected));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, IrregularityFileError,
    ::testing::Values(
        WrongTable{"0.25, 0.2", "0.25, x2", "t.csv:4:7: a number is expected, this is 'x2'"},
        WrongTable{"0.25, 0.2", "0.25, 700",
                   "t.csv:4:7: longitudinal_level = 700 mm is more than 500 mm (look at the unit"},
        WrongTable{"1.3\n", "1435\n", "t.csv:6:23: gauge = 1435 mm is more than 500 mm (the gauge is that beyond"},
        WrongTable{"0.25,", "0.00,", "t.csv:4:1: the distance goes from 0 to 0 m, it must increase"},
        WrongTable{"0.75,", "0.10,", "t.csv:6:1: the distance goes from 0.25 to 0.1 m"},
        WrongTable{" 0.4, 1.4", " 0.4", "t.csv:4:18: the line has 4 fields, 5 columns have names"},
        WrongTable{"1.4\n", "1.4, 7\n", "the line has 6 fields, 5 columns have names"},
        WrongTable{"gauge_mm", "gauge",
                   "t.csv:2:62: the column gauge has no unit (call it gauge_mm, or write the unit"},
        WrongTable{"alignment_mm", "alignement_mm", "unknown column 'alignement_mm' (did you mean alignment_mm?)"},
        WrongTable{"alignment_mm", "alignment_left_mm", "t.csv:2: alignment is given of the left rail only"},
        WrongTable{"alignment_mm", "cross_level_um", "two columns hold the cross_level"},
        WrongTable{"distance_m,", "place,", "t.csv:2: no column holds the distance (call it distance_m)"},
        WrongTable{"longitudinal_level_mm,cross_level_mm,alignment_mm,gauge_mm", "a,b,c,d",
                   "no column holds an irregularity"},
        WrongTable{"distance_m,longitudinal_level_mm,cross_level_mm,alignment_mm,gauge_mm\n", "",
                   "t.csv:2:1: a line with the names of the columns must stand before"},
        WrongTable{"0.75, 0.3,  0.0, 0.5, 1.3\n", "", "t.csv: the file has 3 lines of numbers, at least 4"},
        WrongTable{"0.25", std::string("0.\0", 3), "t.csv"}));

TEST(IrregularityFile, AnyTextIsReadOrRefused) {
  std::mt19937 random(5);
  for (int i = 0; i < treadmark::testing::mutants(3000); ++i) {
    const std::string text = i % 3 == 0   ? treadmark::testing::with_other_numbers(kTable, random)
                             : i % 3 == 1 ? treadmark::testing::with_other_lines(kTable, random)
                                          : treadmark::testing::with_other_bytes(kTable, random);
    try {
      IrregularitySpec spec;
      spec.table = parse_irregularity_text(text, "t.csv");
      check(spec);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_data) << error.what();
    }
  }
}

}  // namespace
}  // namespace treadmark::io
