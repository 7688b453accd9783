// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/roots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace treadmark {
namespace {

TEST(Bisect, FindsARootToTheLastDigitFromEitherSide) {
  const auto below = [](double x) { return x * x < 2.0; };
  const Bracketed up = bisect(1.0, 2.0, below), down = bisect(-1.0, -2.0, below);
  EXPECT_LT(up.low * up.low, 2.0);
  EXPECT_GE(up.high * up.high, 2.0);
  EXPECT_EQ(std::nextafter(up.low, 2.0), up.high);
  EXPECT_EQ(down.low, -up.low);
  EXPECT_EQ(down.high, -up.high);
}

TEST(Bisect, EndsAfterSoManyHalvingsAndAtTheWidth) {
  int asked = 0;
  const auto below = [&](double x) { return ++asked, x < 0.3; };
  const Bracketed few = bisect(0.0, 1.0, below, 3);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(few.low, 0.25);
  EXPECT_EQ(few.high, 0.375);
  const Bracketed wide = bisect(0.0, 1.0, below, 100, 0.1);
  EXPECT_EQ(wide.high - wide.low, 0.0625);
  EXPECT_EQ(wide.middle(), 0.28125);
}

TEST(GoldenSection, FindsAValleyAndAsksOncePerStep) {
  int asked = 0;
  const auto cosine = [&](double x) { return ++asked, std::cos(x); };
  const double width = 1e-6;
  const Bracketed found = golden_section(2.0, 4.5, width, cosine);
  EXPECT_LE(found.high - found.low, width);
  EXPECT_NEAR(found.middle(), std::numbers::pi, width);
  const double steps = std::log(2.5 / width) / std::log(std::numbers::phi);
  EXPECT_LE(asked, std::ceil(steps) + 2);
}

}  // namespace
}  // namespace treadmark
