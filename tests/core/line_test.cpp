// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/line.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace treadmark {
namespace {

// |x| + 1 from -2 to 1, with a jump from 2 to 5 at 1, and level from there to 3.
constexpr std::array kX{-2.0, 0.0, 1.0, 1.0, 3.0}, kY{3.0, 1.0, 2.0, 5.0, 5.0};
const BrokenLine kLine(kX, kY);

TEST(BrokenLine, PiecesBeginAtTheirPlaces) {
  constexpr std::pair<double, std::size_t> kPieces[] = {{-9.0, 0}, {-2.0, 0}, {-0.1, 0}, {0.0, 1},
                                                        {0.9, 1},  {1.0, 3},  {9.0, 3}};
  for (const auto& [x, piece] : kPieces) EXPECT_EQ(kLine.piece(x), piece) << x;
  EXPECT_EQ(piece_at(std::array{1.0, 2.0}, 5.0), 0u);
}

TEST(BrokenLine, IsStraightBetweenItsPoints) {
  for (const double x : {-2.0, -1.75, -0.5, 0.0, 0.25, 0.875}) EXPECT_EQ(kLine.at(x), std::fabs(x) + 1.0) << x;
  for (const double x : {1.0, 1.5, 3.0}) EXPECT_EQ(kLine.at(x), 5.0) << "behind the jump, " << x;
}

TEST(BrokenLine, GoesOnOrIsHeldBeyondItsEnds) {
  EXPECT_EQ(kLine.at(-3.0), 4.0);
  EXPECT_EQ(kLine.held_at(-3.0), 3.0);
  constexpr std::array kRise{0.0, 2.0};
  const BrokenLine rise(kRise, kRise);
  EXPECT_EQ(rise.at(3.0), 3.0);
  EXPECT_EQ(rise.held_at(3.0), 2.0);
  EXPECT_EQ(rise.held_at(1.0), 1.0);
  for (const double x : {-1.0, 0.5, 2.0}) EXPECT_EQ(BrokenLine(std::array{0.5}, std::array{7.0}).held_at(x), 7.0) << x;
}

TEST(BrokenLine, IntegratesItsPieces) {
  EXPECT_EQ(kLine.slope(0), -1.0);
  EXPECT_EQ(kLine.slope(2), 0.0) << "no length";
  EXPECT_EQ(kLine.integral(0, 0.0), 4.0) << "a trapezium 3 and 1 high";
  EXPECT_EQ(kLine.integral(1, 0.5), 0.625);
  EXPECT_EQ(kLine.integral(2, 1.0), 0.0);
}

}  // namespace
}  // namespace treadmark
