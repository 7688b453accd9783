// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/significance.hpp"

#include <set>

#include <gtest/gtest.h>

#include "treadmark/tests/scans/fit/level_samples.hpp"

namespace treadmark::scans {
namespace {

constexpr double kLength = 0.512, kWidth = 0.064, kNoise = 20e-6;
constexpr std::size_t kAlong = 128, kAcross = 16;

/// Sums of a level as if every function stood alone: z standard deviations each.
FunctionSums sums_of(const std::vector<double>& z) {
  FunctionSums out;
  for (const double value : z) {
    constexpr double kWbb = 4e9;
    out.wbb.push_back(kWbb);
    out.wbr.push_back(value * std::sqrt(kWbb));
    out.points.push_back(16.0);
  }
  return out;
}

TEST(Significance, NoiseIsSeldomPicked) {
  constexpr int kSeeds = 60;
  int picked = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const bool closed = seed % 2 == 0;
    const Band band = tests::straight_band(kLength, kWidth, closed);
    const BandPoints points =
        tests::sorted(band, kAlong, kAcross,
                      tests::scattered(band, kAlong, kAcross, 4, kNoise, static_cast<std::uint64_t>(seed),
                                       [](double, double) { return 0.0; }));
    SplineLevel level = tests::level_of(kLength, kWidth, kAlong, kAcross, closed);
    const std::vector<float> weight(points.size(), static_cast<float>(1.0 / (kNoise * kNoise)));
    std::vector<float> ridge;
    picked += choose_functions(sum_functions(points, points.d, weight, level), 1.0, level, ridge) > 0 ? 1 : 0;
  }
  RecordProperty("seeds_with_a_pick", picked);
  // about one level of exp(3)
  EXPECT_LE(picked, kSeeds / 10);
}

TEST(Significance, ABumpIsPickedAtItsPlace) {
  for (const bool closed : {false, true}) {
    const Band band = tests::straight_band(kLength, kWidth, closed);
    const double a0 = closed ? 1e-3 : 0.2, s0 = 40e-3;
    const auto off = [&](double a) { return closed ? a - a0 - kLength * std::round((a - a0) / kLength) : a - a0; };
    const auto bump = [&](double a, double s) {
      return 80e-6 * std::exp(-(off(a) * off(a) + (s - s0) * (s - s0)) / (2.0 * 16e-6));
    };
    const BandPoints points =
        tests::sorted(band, kAlong, kAcross, tests::scattered(band, kAlong, kAcross, 4, kNoise, 3, bump));
    SplineLevel level = tests::level_of(kLength, kWidth, kAlong, kAcross, closed);
    const std::vector<float> weight(points.size(), static_cast<float>(1.0 / (kNoise * kNoise)));
    std::vector<float> ridge;
    const std::size_t number = choose_functions(sum_functions(points, points.d, weight, level), 1.0, level, ridge);
    EXPECT_EQ(number, static_cast<std::size_t>(std::count(level.active.begin(), level.active.end(), 1)));
    ASSERT_EQ(ridge.size(), level.size());
    EXPECT_GE(number, 9u);
    EXPECT_LT(number, 200u);
    double nearest = 1.0;
    for (std::size_t f = 0; f < level.size(); ++f) {
      // the middle of a function lies one knot before its number
      const double a = off(level.knot_a * (static_cast<double>(f / level.functions_s()) - 1.0)),
                   s = level.knot_s * (static_cast<double>(f % level.functions_s()) - 1.0) - s0;
      if (level.active[f] == 0) continue;
      EXPECT_LT(std::hypot(a, s), 56e-3);  // a window and a neighbour reach 8 functions both ways
      nearest = std::min(nearest, std::hypot(a, s));
    }
    EXPECT_LT(nearest, 4e-3);
    // coefficients around the bump may be large, elsewhere they are held back
    const auto at = [&](double a, double s) {
      return static_cast<std::size_t>(std::lround(a / level.knot_a) + 1) * level.functions_s() +
             static_cast<std::size_t>(std::lround(s / level.knot_s) + 1);
    };
    EXPECT_LT(10.0 * ridge[at(a0, s0)], ridge[at(0.4, 20e-3)]);
  }
}

TEST(Significance, AWeakRidgeIsPickedTogether) {
  for (const bool closed : {false, true})
    for (const bool along : {true, false}) {
      SplineLevel level = tests::level_of(kLength, kWidth, kAlong, kAcross, closed);
      const std::size_t columns = level.functions_s();
      const double z = 3.7;  // one alone would need more than 5
      std::vector<double> values(level.size(), 0.0);
      std::set<std::size_t> ridge_line;
      for (std::size_t k = 0; k < 15; ++k) {
        // across the seam of the closed band
        const std::size_t r = along ? (level.functions_a() + (closed ? k - 7 : 40 + k)) % level.functions_a() : 50,
                          c = along ? 9 : 2 + k;
        ridge_line.insert(r * columns + c);
      }
      for (const std::size_t f : ridge_line) values[f] = z;
      std::vector<float> ridge;
      EXPECT_GT(choose_functions(sums_of(values), 1.0, level, ridge), 0u) << closed << along;
      std::size_t met = 0;
      for (const std::size_t f : ridge_line) met += level.active[f];
      EXPECT_GE(met, 1u);
      for (std::size_t f = 0; f < level.size(); ++f) {
        if (level.active[f] == 0) continue;
        const bool beside = std::any_of(ridge_line.begin(), ridge_line.end(), [&](std::size_t g) {
          const auto apart = [](std::size_t x, std::size_t y) { return x > y ? x - y : y - x; };
          const std::size_t rows = apart(f / columns, g / columns);
          return std::min(rows, closed ? level.functions_a() - rows : rows) <= 1 &&
                 apart(f % columns, g % columns) <= 1;
        });
        EXPECT_TRUE(beside);
      }
      // as many of the same size here and there are noise
      std::vector<double> spread(level.size(), 0.0);
      for (std::size_t k = 0; k < 15; ++k) spread[(8 * k + 3) * columns + (5 * k) % columns] = z;
      EXPECT_EQ(choose_functions(sums_of(spread), 1.0, level, ridge), 0u);
    }
}

TEST(Significance, OneThatStandsOutBringsItsNeighbours) {
  SplineLevel level = tests::level_of(kLength, kWidth, kAlong, kAcross, false);
  const std::size_t columns = level.functions_s(), f = 30 * columns + 8;
  std::vector<double> values(level.size(), 0.0);
  std::vector<float> ridge;
  values[f] = 12.0;
  EXPECT_EQ(choose_functions(sums_of(values), 1.0, level, ridge), 9u);
  for (std::size_t r = 29; r <= 31; ++r)
    for (std::size_t c = 7; c <= 9; ++c) EXPECT_EQ(level.active[r * columns + c], 1);
  // thresholds scale
  EXPECT_EQ(choose_functions(sums_of(values), 4.0, level, ridge), 0u);
  values[f] = 3.0;
  EXPECT_EQ(choose_functions(sums_of(values), 1.0, level, ridge), 0u);
  EXPECT_EQ(choose_functions(sums_of(values), 0.25, level, ridge), 9u);
  // too few points to hold it
  values[f] = 12.0;
  FunctionSums sums = sums_of(values);
  sums.points[f] = 1.0;
  EXPECT_EQ(choose_functions(sums, 1.0, level, ridge), 0u);
}

}  // namespace
}  // namespace treadmark::scans
