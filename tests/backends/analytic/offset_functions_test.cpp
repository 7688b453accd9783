// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defects/offset_functions.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace treadmark::testing {
namespace {

using namespace analytic;

TEST(OffsetFunctions, FastSineAndCosineAreExactToRounding) {
  std::mt19937 random(3);
  for (const double range : {0.8, 7.0, 500.0, kFastTrigRange}) {
    std::uniform_real_distribution<double> angle(-range, range);
    for (int i = 0; i < 20000; ++i) {
      const double x = angle(random);
      double s, c;
      fast_sin_cos(x, s, c);
      ASSERT_NEAR(s, std::sin(x), 3e-16) << x;
      ASSERT_NEAR(c, std::cos(x), 3e-16) << x;
    }
  }
  double s, c;
  fast_sin_cos(std::numeric_limits<double>::quiet_NaN(), s, c);
  EXPECT_TRUE(std::isnan(s) && std::isnan(c));
}

TEST(OffsetFunctions, AnglesBeyondTheFastRangeAreTakenToo) {
  const double angles[3] = {0.3, 3e7, -1e12};
  double s[3], c[3];
  sin_cos_many(angles, 3, s, c);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(s[i] == std::sin(angles[i]) && c[i] == std::cos(angles[i]));
}

template <class Function>
void expect_many_is_jet(const Function& f, double from, double to) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(from, to);
  double x[kMany];
  for (double& one : x) one = place(random);
  Many h, dh;
  f.many(x, kMany, h, dh);
  for (std::size_t i = 0; i < kMany; ++i) {
    const Jet j = f.jet(x[i]);
    // phases of a few hundred radians are known to 1e-13
    EXPECT_NEAR(h[i], j.h, 1e-13) << x[i];
    EXPECT_NEAR(dh[i], j.dh, 1e-11) << x[i];
    if (j.h == 0.0 && j.dh == 0.0) {
      EXPECT_TRUE(h[i] == 0.0 && dh[i] == 0.0) << x[i];
    }
  }
}

TEST(OffsetFunctions, ManyAtATimeAreTheSameAsOne) {
  const CosineBump bump{0.01, 0.04};
  const CosineStep up{-0.02, 0.05}, down{0.03, -0.04};
  const CosineWindow window{-0.1, 0.2, 0.07};
  const WaveSum waves{-0.1, {{125.0, 30e-6, 0.2}, {251.0, 6e-6, -1.0}}};
  expect_many_is_jet(bump, -0.08, 0.09);
  expect_many_is_jet(CosineBump{0.0, 0.0}, -1.0, 1.0);
  expect_many_is_jet(up, -0.06, 0.09);
  expect_many_is_jet(down, -0.06, 0.09);
  expect_many_is_jet(window, -0.2, 0.3);
  expect_many_is_jet(waves, -1.0, 1.0);
  expect_many_is_jet(FunctionProduct<WaveSum, CosineWindow>{waves, window}, -0.2, 0.3);
}

}  // namespace
}  // namespace treadmark::testing
