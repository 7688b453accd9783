// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/read_influence.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

constexpr int kMx = 3, kMy = 2;
constexpr double kDx = 0.4, kDy = 0.5;

/// Coefficients with the parity of a half-space in x, without any symmetry in y [mm].
std::array<double, 9> coefficients(int ix, int iy) {
  const double x = kDx * ix, y = kDy * iy + 0.1, r = std::sqrt(1.0 + x * x + y * y);
  return {1.0 / r, 0.1 * x / r, 0.2 * y, 0.3 * x / r, 2.0 / r, x * y, 0.5 * y, 0.7 * x * y, 3.0 / r};
}

std::string influence_file(const std::string& first = "1 1",
                           const std::string& header = " header of a row\n % another one\n") {
  std::string text = "% numerical influence coefficients\n" + first +
                     "   NMATRIX, IACONVX\n 0 312 LQUASID, XYZORDR\n\n 1 0\n" +
                     fmt::format(" {} {} {} {}\n", kMx, kMy, kDx, kDy);
  for (int iy = -kMy + 1; iy < kMy; ++iy) {
    text += header;
    for (int ix = 0; ix < kMx; ++ix) {
      text += fmt::format(" {} {}", ix, ix * kDx);
      for (const double c : coefficients(ix, iy)) text += fmt::format(" {:.17g}", c);
      text += "\n";
    }
  }
  return text;
}

std::string influence_refusal(const std::string& text) {
  return treadmark::testing::refusal_of([&] { parse_influence(text, "a.cff"); });
}

TEST(InfluenceFile, FillsAllOffsetsInMetres) {
  for (const std::string header : {" header\n % comment\n", " -1  -0.5\n\n", ""}) {
    const NumericalInfluence table = parse_influence(influence_file("1 1", header), "a.cff");
    ASSERT_EQ(table.nx, 2 * kMx - 1);
    ASSERT_EQ(table.ny, 2 * kMy - 1);
    EXPECT_DOUBLE_EQ(table.dx, 0.4e-3);
    EXPECT_DOUBLE_EQ(table.dy, 0.5e-3);
    ASSERT_EQ(table.values.size(), static_cast<std::size_t>(table.nx * table.ny));
    for (int iy = 0; iy < table.ny; ++iy)
      for (int ix = 0; ix < table.nx; ++ix) {
        const auto expected = coefficients(ix - (table.nx - 1) / 2, iy - (table.ny - 1) / 2);
        for (std::size_t k = 0; k < 9; ++k)
          EXPECT_DOUBLE_EQ(table.values[static_cast<std::size_t>(iy * table.nx + ix)][k], expected[k] * 1e-3)
              << ix << ' ' << iy << ' ' << k;
      }
  }
}

TEST(InfluenceFile, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(influence_refusal(influence_file("2 1")),
              ::testing::StartsWith("a.cff:2:1: NMATRIX = 2 of a file of influence coefficients is not supported"));
  EXPECT_THAT(influence_refusal(influence_file("1 2")), ::testing::StartsWith("a.cff:2:3: IACONVX = 2"));
  EXPECT_THAT(influence_refusal("1 1\n 1 312\n"), ::testing::HasSubstr("LQUASID = 1"));
  EXPECT_THAT(influence_refusal("1 1\n 0 123\n"), ::testing::HasSubstr("XYZORDR = 123"));
  EXPECT_THAT(influence_refusal("1 1\n 0 312\n 0 0\n"), ::testing::HasSubstr("ISYMMX = 0"));
  EXPECT_THAT(influence_refusal("1 1\n 0 312\n 1 1\n"), ::testing::HasSubstr("ISYMMY = 1"));
}

TEST(InfluenceFile, TellsWhereItIsBroken) {
  const std::string head = "1 1\n0 312\n1 0\n", row = " 0 1 2 3 4 5 6 7 8 9\n";
  EXPECT_THAT(influence_refusal(""), ::testing::HasSubstr("the file ends where the line NMATRIX IACONVX is expected"));
  EXPECT_THAT(influence_refusal("1\n"), ::testing::HasSubstr("IACONVX is missing"));
  EXPECT_THAT(influence_refusal(head + "0 1 1 1\n"), ::testing::HasSubstr("a.cff:4:1: MX = 0 lies outside"));
  EXPECT_THAT(influence_refusal(head + "1 1 0 1\n"), ::testing::HasSubstr("a.cff:4:5: DX must be positive"));
  EXPECT_THAT(influence_refusal(head + "1 1 nan 1\n"), ::testing::HasSubstr("not finite"));
  EXPECT_THAT(influence_refusal(head + "900000 900000 1 1\n"), ::testing::HasSubstr("do not fit into a file of"));
  EXPECT_THAT(influence_refusal(head + "1 1 1 1\n h\n h\n 0" + row), ::testing::StrEq("no error"));
  EXPECT_THAT(influence_refusal(head + "1 1 1 1\n h\n h\n 1" + row),
              ::testing::HasSubstr("the file ends where row ix = 0 of iy = 0"));
  EXPECT_THAT(influence_refusal(head + "1 1 1 1\n" + std::string(9, '\n') + " 0" + row),
              ::testing::HasSubstr("row ix = 0 of iy = 0 is expected here"));
  EXPECT_THAT(influence_refusal(head + "2 1 1 1\n h\n h\n 0" + row + " 2" + row),
              ::testing::HasSubstr("a.cff:8:2: ix = 2 stands where row ix = 1 of iy = 0 is expected"));
  EXPECT_THAT(influence_refusal(head + "2 1 1 1\n h\n h\n 0" + row + " 1 0 1 2 3 4 5 6 7 8 x\n"),
              ::testing::HasSubstr("a number is expected, this is 'x'"));
  EXPECT_THAT(influence_refusal(head + "2 1 1 1\n h\n h\n 0" + row + " 1 0 1 2 3 4 5 6 7 8\n"),
              ::testing::HasSubstr("a coefficient is missing"));
  const std::string text = influence_file();
  for (std::size_t end = text.find('\n'); end < text.rfind('\n', text.size() - 2); end = text.find('\n', end + 1))
    EXPECT_NE(influence_refusal(text.substr(0, end)), "no error") << end;
}

TEST(InfluenceFile, MutantsOnlyThrowError) {
  const std::string original = influence_file(), characters = "0123456789.-+eE %\n\tx\xff";
  std::mt19937 random(5);
  int good = 0;
  constexpr int kMutants = 2000;
  for (int i = 0; i < kMutants; ++i) {
    std::string text = original;
    for (int k = 0; k < 3; ++k) text[random() % text.size()] = characters[random() % characters.size()];
    if (random() % 4 == 0) text.resize(random() % text.size());
    try {
      parse_influence(text, "m.cff");
      ++good;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(good, 0);
  EXPECT_LT(good, kMutants);
}

TEST(InfluenceFile, IsReadFromDisk) {
  const treadmark::testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.cff";
  std::ofstream(file) << influence_file();
  EXPECT_EQ(read_influence(file).nx, 2 * kMx - 1);
  std::filesystem::remove(file);
  try {
    read_influence(file);
    FAIL() << "was read";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::input_data);
  }
}

}  // namespace
}  // namespace treadmark::io
