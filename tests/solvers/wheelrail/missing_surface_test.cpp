// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/validate_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

namespace treadmark::wheelrail {
namespace {

/// Rows of text: '#' contact, '.' no contact, 'o' no surface.
MissingSurface of(const std::vector<std::string_view>& rows) {
  Grid2 grid;
  grid.nx = static_cast<int>(rows.front().size());
  grid.ny = static_cast<int>(rows.size());
  std::vector<double> distance, pressure;
  for (const auto row : rows)
    for (const char c : row) {
      distance.push_back(c == 'o' ? std::nan("") : 0.0);
      pressure.push_back(c == '#' ? 1e9 : 0.0);
    }
  return missing_beside_contact(grid, distance, pressure);
}

TEST(MissingSurface, HoleInContactCountsWhole) {
  const MissingSurface m = of({"......", ".####.", ".#oo#.", ".#o##.", ".####.", "......"});
  EXPECT_EQ(m.hole, 3);
  EXPECT_EQ(m.edge, 0);
}

TEST(MissingSurface, CornersTouchToo) {
  EXPECT_EQ(of({".....", ".o...", "..#..", "....."}).hole, 1);
  EXPECT_EQ(of({".....", ".o...", "...#.", "....."}).hole, 0);
}

TEST(MissingSurface, BeyondTheEndOfAProfileOnlyTheBorderOfContactCounts) {
  const MissingSurface m = of({"oooooo", "oooooo", ".###..", ".###.."});
  EXPECT_EQ(m.hole, 0);
  EXPECT_EQ(m.edge, 5);
}

TEST(MissingSurface, FarFromContactNothingCounts) {
  const MissingSurface m = of({"oooooo", "......", ".##...", ".##.o.", "......"});
  EXPECT_EQ(m.hole, 0);
  EXPECT_EQ(m.edge, 0);
}

}  // namespace
}  // namespace treadmark::wheelrail
