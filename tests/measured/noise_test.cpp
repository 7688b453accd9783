// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/measured/noise.hpp"

#include <gtest/gtest.h>

#include <random>

namespace treadmark::measured {
namespace {

TEST(Noise, IsFoundWhateverTheSpacing) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, 20e-6);
  for (const double step : {0.1e-3, 0.5e-3}) {
    std::uniform_real_distribution<double> shift(-0.3 * step, 0.3 * step);
    Profile clean, noisy;
    for (double y = -36e-3; y <= 36e-3; y += step) {
      const double at = y + shift(random);
      for (Profile* p : {&clean, &noisy}) p->y.push_back(at), p->z.push_back(at * at / 0.6);
      noisy.z.back() += normal(random);
    }
    EXPECT_LT(profile_noise(clean), 0.1e-6);
    EXPECT_NEAR(profile_noise(noisy), 20e-6, 7e-6) << step;
  }
}

}  // namespace
}  // namespace treadmark::measured
