// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/noise_factors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

  TwoPasses(double first, double second, bool apart = false, double outlier_factor = NoiseSettings{}.outlier_factor) {
    auto samples =
        tests::scattered(band, kFactorRows, kFactorColumns, kPerCell, 1.0, 1, [](double, double) { return 0.0; });
    for (std::size_t i = 0; i < samples.size(); ++i) {
      pass.push_back(apart && samples[i].a > 0.5 * kFactorLength ? 3 : i % 2 == 0 ? 3 : 8);
      samples[i].d *= pass.back() == 3 ? first : second;
    }
    points = tests::sorted(band, kFactorRows, kFactorColumns, samples);
    how.residuals = true;
    how.outlier_factor = outlier_factor;
    noise = find_noise(points, band, how);
  }
  std::vector<NoiseClass> factors() { return find_noise_factors(points, std::vector<NoiseProperty>{pass}, how, noise); }
};

/// Surroundings that noisy points are a half of are known less well than the quiet ones alone would know them, from
/// which quiet points lie off by a tenth more: of 4 times 3.6 are left.
constexpr double kRatio = 0.6, kSigma = 0.3;

TEST(NoiseFactors, TellPassesApart) {
  for (const bool apart : {false, true}) {
    TwoPasses two(20e-6, 80e-6, apart);
    const std::size_t outliers = two.noise.outliers;
    const std::vector<NoiseClass> found = two.factors();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].number, 3);
    EXPECT_EQ(found[1].number, 8);
    EXPECT_NEAR(found[1].factor / found[0].factor, 4.0, kRatio) << apart;
    // of each point what it was made with, where both are and where one is alone
    for (std::size_t row = 20; row < kFactorRows; row += 36)
      for (std::size_t column = 8; column < kFactorColumns; column += 16)
        for (std::size_t i = two.points.first(row, column); i < two.points.first(row, column) + 2; ++i) {
          const std::uint32_t index = two.points.index[i];
          const double truth = two.pass[index] == 3 ? 20e-6 : 80e-6;
          EXPECT_NEAR(two.noise.at(row, column) * two.noise.factor_of(index), truth, kSigma * truth)
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

/// Of hundreds of passes of some hundred points each two differ by a third by chance.
TEST(NoiseFactors, FewPointsDifferByChance) {
  TwoPasses two(30e-6, 30e-6);
  constexpr std::size_t kPasses = 250;
  for (std::size_t i = 0; i < two.pass.size(); ++i) two.pass[i] = static_cast<std::uint16_t>(i % kPasses);
  EXPECT_TRUE(two.factors().empty());
}

/// Without a limit for outliers the noise of passes is told all the same.
TEST(NoiseFactors, CountWhereOutliersStay) {
  TwoPasses two(20e-6, 80e-6, false, 0.0);
  EXPECT_EQ(two.noise.outliers + two.noise.isolated, 0u);
  EXPECT_EQ(two.factors().size(), 2u);
  EXPECT_EQ(std::count(two.points.state.begin(), two.points.state.end(), PointState::used),
            static_cast<std::ptrdiff_t>(two.points.size()));
}

TEST(NoiseFactors, OfTwoPropertiesTheOneThatTellsCounts) {
  TwoPasses two(20e-6, 60e-6);
  NoiseProperty other;
  for (std::size_t i = 0; i < two.pass.size(); ++i) other.push_back(static_cast<std::uint16_t>(i / 7 % 3));
  const std::vector<NoiseProperty> both{other, two.pass};
  const std::vector<NoiseClass> found = find_noise_factors(two.points, both, two.how, two.noise);
  ASSERT_EQ(found.size(), 2u);
  for (const NoiseClass& one : found) EXPECT_EQ(one.property, 1u);
  EXPECT_NEAR(found[1].factor / found[0].factor, 3.0, 0.4);
}

}  // namespace
}  // namespace treadmark::scans
