// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/noise_factors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/tests/scans/cleaning/band_samples.hpp"

namespace treadmark::scans {
namespace {

constexpr double kFactorLength = 0.4, kFactorWidth = 0.064;
constexpr std::size_t kFactorRows = 400, kFactorColumns = 64;
constexpr int kPerCell = 4;

/// Points of two passes in turn, each with its own noise [m]; by `apart` the second half of the band has one alone.
struct TwoPasses {
  Band band = tests::straight_band(kFactorLength, kFactorWidth, false);
  BandPoints points;
  NoiseProperty pass;
  LocalNoise noise;
  NoiseSettings how;

  TwoPasses(double first, double second, bool apart = false) {
    auto samples =
        tests::scattered(band, kFactorRows, kFactorColumns, kPerCell, 1.0, 1, [](double, double) { return 0.0; });
    for (std::size_t i = 0; i < samples.size(); ++i) {
      pass.push_back(apart && samples[i].a > 0.5 * kFactorLength ? 3 : i % 2 == 0 ? 3 : 8);
      samples[i].d *= pass.back() == 3 ? first : second;
    }
    points = tests::sorted(band, kFactorRows, kFactorColumns, samples);
    how.residuals = true;
    noise = find_noise(points, band, how);
  }
  std::vector<NoiseClass> factors() { return find_noise_factors(points, std::vector<NoiseProperty>{pass}, how, noise); }
};

TEST(NoiseFactors, TellPassesApart) {
  for (const bool apart : {false, true}) {
    TwoPasses two(20e-6, 80e-6, apart);
    const std::size_t outliers = two.noise.outliers;
    const std::vector<NoiseClass> found = two.factors();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].number, 3);
    EXPECT_EQ(found[1].number, 8);
    EXPECT_NEAR(found[1].factor / found[0].factor, 4.0, 0.4) << apart;
    // of each point what it was made with, where both are and where one is alone
    for (std::size_t row = 20; row < kFactorRows; row += 36)
      for (std::size_t column = 8; column < kFactorColumns; column += 16)
        for (std::size_t i = two.points.first(row, column); i < two.points.first(row, column) + 2; ++i) {
          const std::uint32_t index = two.points.index[i];
          const double truth = two.pass[index] == 3 ? 20e-6 : 80e-6;
          EXPECT_NEAR(two.noise.at(row, column) * two.noise.factor_of(index), truth, 0.2 * truth)
              << apart << ' ' << row;
        }
    // of normal numbers hardly any are outliers, by the noise of their own
    EXPECT_LT(two.noise.outliers, two.points.size() / 2000);
    EXPECT_GT(outliers, two.noise.outliers);
  }
}

TEST(NoiseFactors, OfTheSameNoiseNothingChanges) {
  TwoPasses two(30e-6, 30e-6);
  const std::vector<float> before = two.noise.sigma;
  EXPECT_TRUE(two.factors().empty());
  EXPECT_TRUE(two.noise.factor.empty());
  EXPECT_EQ(two.noise.sigma, before);
}

TEST(NoiseFactors, OfTwoPropertiesTheOneThatTellsCounts) {
  TwoPasses two(20e-6, 60e-6);
  NoiseProperty other;
  for (std::size_t i = 0; i < two.pass.size(); ++i) other.push_back(static_cast<std::uint16_t>(i / 7 % 3));
  const std::vector<NoiseProperty> both{other, two.pass};
  const std::vector<NoiseClass> found = find_noise_factors(two.points, both, two.how, two.noise);
  ASSERT_EQ(found.size(), 2u);
  for (const NoiseClass& one : found) EXPECT_EQ(one.property, 1u);
  EXPECT_NEAR(found[1].factor / found[0].factor, 3.0, 0.3);
}

}  // namespace
}  // namespace treadmark::scans
