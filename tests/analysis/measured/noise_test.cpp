// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "noisy_head.hpp"

namespace treadmark::measured {
namespace {

using testing::head;
using testing::rounded;
using testing::with_noise;

TEST(Noise, IsFoundWhateverTheSpacing) {
  for (const double step : {0.05e-3, 0.2e-3, 0.5e-3, 1e-3})
    for (const double noise : {3e-6, 30e-6}) {
      const PointNoise found = profile_noise(with_noise(head(step), noise, 7));
      EXPECT_NEAR(found.across, noise, 0.35 * noise) << step;
      EXPECT_NEAR(found.step, step, 0.2 * step);
      EXPECT_EQ(found.rounding_z, 0.0);
    }
}

TEST(Noise, IsNoneInArcsAndTheirJoints) {
  for (const double step : {0.05e-3, 0.2e-3, 0.5e-3, 1e-3, 2e-3}) EXPECT_LT(profile_noise(head(step)).across, 0.02e-6);
}

TEST(Noise, OfRoundedNumbersIsThatOfRounding) {
  for (const double step : {0.05e-3, 0.2e-3, 1e-3})
    for (const double unit : {0.05e-3, 0.01e-3, 1e-6}) {
      const PointNoise found = profile_noise(rounded(head(step), unit));
      EXPECT_NEAR(found.rounding_z, unit, 1e-9 * unit);
      EXPECT_NEAR(found.across, unit / std::sqrt(12.0), 0.5 * unit / std::sqrt(12.0)) << step << ' ' << unit;
    }
}

TEST(Noise, IsNotSeenInEqualStepsNorInExactNumbers) {
  Profile cone;  // 1:20 at whole millimetres
  for (int i = 0; i <= 60; ++i) cone.y.push_back(1e-3 * i), cone.z.push_back(-0.05e-3 * i);
  EXPECT_LT(profile_noise(cone).across, 1e-12);
  EXPECT_EQ(profile_noise(cone).rounding_z, 0.0);
  Profile parabola;  // y^2 / 1000 in steps of 0.001 mm
  for (int i = -30; i <= 30; ++i) parabola.y.push_back(1e-3 * i), parabola.z.push_back(1e-6 * i * i);
  EXPECT_LT(profile_noise(parabola).across, 1e-9);
}

TEST(Noise, OfAFewPointsIsNotKnown) {
  Profile few;
  for (int i = 0; i < 7; ++i) few.y.push_back(1e-3 * i), few.z.push_back(i % 2 * 1e-4);
  EXPECT_EQ(profile_noise(few).across, 0.0);
}

TEST(RoughArcLength, IsNotMadeLongerByNoise) {
  const Profile clean = head(0.05e-3);
  EXPECT_NEAR(rough_arc_length(with_noise(clean, 30e-6, 1)).back(), rough_arc_length(clean).back(), 0.2e-3);
}

}  // namespace
}  // namespace treadmark::measured
