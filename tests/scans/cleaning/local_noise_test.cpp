// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/local_noise.hpp"

#include <gtest/gtest.h>

#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/scans/cleaning/band_samples.hpp"

namespace treadmark::scans {
namespace {

using tests::Sample;
constexpr double kTrueNoise = 30e-6, kLength = 0.4, kWidth = 0.064;
constexpr std::size_t kRows = 400, kColumns = 64;

double flat(double, double) { return 0.0; }

std::size_t flagged(const BandPoints& points) {
  return static_cast<std::size_t>(std::count(points.state.begin(), points.state.end(), PointState::outlier));
}

TEST(LocalNoise, LevelOfKnownNoise) {
  for (const bool closed : {false, true}) {
    const Band band = tests::straight_band(kLength, kWidth, closed);
    // a surface that bends: one period in the band, 1 mm
    const auto wave = [](double a, double s) {
      return 1e-3 * std::sin(2.0 * std::numbers::pi * a / kLength) + 0.2 * s * s;
    };
    BandPoints points =
        tests::sorted(band, kRows, kColumns, tests::scattered(band, kRows, kColumns, 3, kTrueNoise, 1, wave));
    const LocalNoise noise = find_noise(points, band, {});
    EXPECT_NEAR(noise.typical, kTrueNoise, 0.03 * kTrueNoise);
    ASSERT_EQ(noise.sigma.size(), noise.tile_rows * noise.tile_columns);
    for (const float sigma : noise.sigma) EXPECT_NEAR(sigma, kTrueNoise, 0.15 * kTrueNoise);
    // normal numbers are beyond 4.5 in 7 of a million cases; the scatter of a few points is less sure than that
    EXPECT_LT(noise.outliers, points.size() / 2000);
    EXPECT_EQ(flagged(points), noise.outliers + noise.isolated);
    EXPECT_EQ(noise.isolated, 0u);
  }
}

TEST(LocalNoise, TilesFollowNoiseThatChanges) {
  const Band band = tests::straight_band(kLength, kWidth, false);
  auto samples = tests::scattered(band, kRows, kColumns, 3, 1.0, 2, flat);
  const auto level = [](double a) { return a < 0.5 * kLength ? 10e-6 : 60e-6; };
  for (Sample& p : samples) p.d *= level(p.a);
  BandPoints points = tests::sorted(band, kRows, kColumns, samples);
  const LocalNoise noise = find_noise(points, band, {});
  for (std::size_t row = 0; row < kRows; row += 16) {
    const double a = points.cell_a * (static_cast<double>(row) + 8.0), here = level(a);
    if (std::fabs(a - 0.5 * kLength) < 20e-3) continue;
    for (std::size_t column = 0; column < kColumns; column += 16)
      EXPECT_NEAR(noise.at(row, column), here, 0.2 * here) << a;
  }
}

TEST(LocalNoise, PlantedOutliersAreFound) {
  const Band band = tests::straight_band(kLength, kWidth, true);
  auto samples = tests::scattered(band, kRows, kColumns, 3, kTrueNoise, 3, flat);
  Random random(9);
  std::vector<std::uint8_t> planted(samples.size(), 0);
  for (std::size_t i = 50; i < samples.size(); i += 250) {
    samples[i].d += (random.uniform() < 0.5 ? -1.0 : 1.0) * kTrueNoise * (10.0 + 30.0 * random.uniform());
    planted[i] = 1;
  }
  BandPoints points = tests::sorted(band, kRows, kColumns, samples);
  const LocalNoise noise = find_noise(points, band, {});
  std::size_t missed = 0, wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool found = points.state[i] == PointState::outlier;
    missed += planted[points.index[i]] != 0 && !found ? 1 : 0;
    wrong += planted[points.index[i]] == 0 && found ? 1 : 0;
  }
  EXPECT_EQ(missed, 0u);
  EXPECT_LT(wrong, points.size() / 1000);
  EXPECT_NEAR(noise.typical, kTrueNoise, 0.03 * kTrueNoise);
  // none are wanted
  BandPoints kept = tests::sorted(band, kRows, kColumns, samples);
  find_noise(kept, band, {.outlier_factor = 0.0});
  EXPECT_EQ(flagged(kept), 0u);
}

TEST(LocalNoise, AKinkAndAStepKeepTheirPoints) {
  const Band band = tests::straight_band(kLength, kWidth, false);
  const auto kink = [](double, double s) { return 0.044 * std::max(0.0, s - 0.5 * kWidth); };
  const auto step = [](double a, double) { return a > 0.5 * kLength ? 0.5e-3 : 0.0; };
  for (const double noise : {0.0, 3e-6}) {
    BandPoints kinked =
        tests::sorted(band, kRows, kColumns, tests::scattered(band, kRows, kColumns, 4, noise, 4, kink));
    find_noise(kinked, band, {});
    std::size_t near = 0, lost = 0;
    for (std::size_t i = 0; i < kinked.size(); ++i)
      if (std::fabs(kinked.s[i] - 0.5 * kWidth) < 3e-3) {
        ++near;
        lost += kinked.state[i] == PointState::outlier ? 1 : 0;
      }
    EXPECT_LT(static_cast<double>(lost), 0.002 * static_cast<double>(near)) << noise;
    BandPoints stepped =
        tests::sorted(band, kRows, kColumns, tests::scattered(band, kRows, kColumns, 4, noise, 5, step));
    find_noise(stepped, band, {});
    near = lost = 0;
    for (std::size_t i = 0; i < stepped.size(); ++i)
      if (std::fabs(stepped.a[i] - 0.5 * kLength) < 3e-3) {
        ++near;
        lost += stepped.state[i] == PointState::outlier ? 1 : 0;
      }
    EXPECT_LT(static_cast<double>(lost), 0.002 * static_cast<double>(near)) << noise;
  }
}

TEST(LocalNoise, LonePointsInGapsAreIsolated) {
  const Band band = tests::straight_band(kLength, kWidth, false);
  auto samples = tests::scattered(band, kRows, kColumns, 3, kTrueNoise, 6, flat);
  const double round_a = 0.1, wide_a = 0.3, middle = 0.5 * kWidth;
  // a round gap of 20 mm and one of 130 mm all across
  std::erase_if(samples, [&](const Sample& p) {
    return std::hypot(p.a - round_a, p.s - middle) < 10e-3 || std::fabs(p.a - wide_a) < 65e-3;
  });
  const std::size_t before = samples.size();
  samples.push_back({round_a, middle, 3e-3});
  samples.push_back({wide_a, middle, 0.0});
  samples.push_back({wide_a, middle + 5e-3, 2e-3});
  BandPoints points = tests::sorted(band, kRows, kColumns, samples);
  const LocalNoise noise = find_noise(points, band, {});
  std::size_t rest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool out = points.state[i] == PointState::outlier;
    if (points.index[i] >= before) {
      EXPECT_TRUE(out) << points.index[i] - before;
    } else {
      rest += out ? 1 : 0;
    }
  }
  EXPECT_LT(rest, points.size() / 1000);
  EXPECT_GE(noise.isolated, 3u);
  EXPECT_EQ(flagged(points), noise.outliers + noise.isolated);
}

TEST(LocalNoise, TheSameForAnyNumberOfThreads) {
  const Band band = tests::straight_band(kLength, kWidth, true);
  auto samples = tests::scattered(band, kRows, kColumns, 3, kTrueNoise, 7, flat);
  for (std::size_t i = 0; i < samples.size(); i += 100) samples[i].d += 0.4e-3;
  std::vector<BandPoints> points(2, tests::sorted(band, kRows, kColumns, samples));
  std::vector<LocalNoise> noise;
  for (int threads = 1; threads <= 2; ++threads) {
    const ThreadLimit limit(threads);
    noise.push_back(find_noise(points[static_cast<std::size_t>(threads - 1)], band, {}));
  }
  EXPECT_EQ(points[0].state, points[1].state);
  EXPECT_EQ(noise[0].sigma, noise[1].sigma);
  EXPECT_EQ(noise[0].typical, noise[1].typical);
}

}  // namespace
}  // namespace treadmark::scans
