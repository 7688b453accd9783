// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/section_levels.hpp"

#include <gtest/gtest.h>

#include "treadmark/tests/scans/cleaning/band_samples.hpp"

namespace treadmark::scans {
namespace {

constexpr double kSectionNoise = 20e-6, kSectionLength = 1.0, kFinest = 2e-3;
constexpr std::size_t kSectionRows = 1000, kSectionColumns = 72;

Band levelled_rail_band() {
  auto nominal = tests::nominal_points("60E1", Body::rail);
  std::erase_if(nominal, [](const Vec2& p) { return std::fabs(p.x()) > 34e-3; });
  return {Body::rail, 1.0, Section(nominal), 0.0, kSectionLength, false};
}

/// Wear of a crown and a hollow: zero, with all its derivatives nearly, at the ends.
double wear(double s) {
  const auto bell = [](double x) { return std::exp(-0.5 * x * x); };
  return -60e-6 * bell((s - 40e-3) / 7e-3) + 25e-6 * bell((s - 22e-3) / 4e-3);
}

TEST(SectionLevels, DeviationIsRecoveredDespiteNoiseAndDamage) {
  const Band band = levelled_rail_band();
  const BandPoints points =
      tests::sorted(band, kSectionRows, kSectionColumns,
                    tests::scattered(band, kSectionRows, kSectionColumns, 6, kSectionNoise, 1, [](double a, double s) {
                      return wear(s) - (a > 0.3 && a < 0.5 ? 0.8e-3 : 0.0);  // a fifth is damaged
                    }));
  double moved = 0.0;
  const Section section = refine_section(points, band, kFinest, &moved);
  double most = 0.0, sum = 0.0, count = 0.0;
  for (double s = 3e-3; s < band.section.length() - 3e-3; s += 0.3e-3) {
    const Section::Point at = band.section.at(s);
    const auto foot = section.foot(at.position, 1e-3);
    ASSERT_TRUE(foot.has_value());
    const double error = -foot->distance - wear(s);
    most = std::max(most, std::fabs(error));
    sum += error * error;
    count += 1.0;
  }
  RecordProperty("rms_um", std::to_string(1e6 * std::sqrt(sum / count)));
  RecordProperty("most_um", std::to_string(1e6 * most));
  EXPECT_LT(std::sqrt(sum / count), 0.4e-6);
  EXPECT_LT(most, 1e-6);
  EXPECT_NEAR(moved, 60e-6, 2e-6);
}

TEST(SectionLevels, WhatAgreesWithTheNominalSectionStaysExactlySo) {
  const Band band = levelled_rail_band();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const BandPoints points =
        tests::sorted(band, kSectionRows, kSectionColumns,
                      tests::scattered(band, kSectionRows, kSectionColumns, 2, kSectionNoise, seed,
                                       [](double a, double) { return a < 0.2 ? -1e-3 : 0.0; }));
    double moved = 1.0;
    const Section section = refine_section(points, band, kFinest, &moved);
    EXPECT_EQ(moved, 0.0);
    ASSERT_EQ(section.length(), band.section.length());
    for (double s = 0.0; s <= section.length(); s += 0.7e-3) {
      EXPECT_EQ(section.at(s).position, band.section.at(s).position);
      EXPECT_EQ(section.at(s).normal, band.section.at(s).normal);
    }
  }
}

TEST(SectionLevels, WhereNothingDeviatesItStaysNominal) {
  const Band band = levelled_rail_band();
  const auto local = [](double s) { return 40e-6 * std::exp(-0.5 * std::pow((s - 58e-3) / 2e-3, 2)); };
  const BandPoints points = tests::sorted(
      band, kSectionRows, kSectionColumns,
      tests::scattered(band, kSectionRows, kSectionColumns, 4, 5e-6, 2, [&](double, double s) { return local(s); }));
  const Section section = refine_section(points, band, kFinest);
  for (double s = 3e-3; s < band.section.length() - 3e-3; s += 0.5e-3) {
    const auto foot = section.foot(band.section.at(s).position, 1e-3);
    ASSERT_TRUE(foot.has_value());
    EXPECT_NEAR(-foot->distance, local(s), 1e-6) << s;
  }
}

TEST(SectionLevels, DenselyScannedDamageCountsNoMore) {
  const Band band = levelled_rail_band();
  auto samples = tests::scattered(band, kSectionRows, kSectionColumns, 2, kSectionNoise, 5,
                                  [](double, double s) { return wear(s); });
  // three quarters of all points lie on a tenth of the length
  Random random(8);
  const std::size_t most = 3 * samples.size();
  for (std::size_t i = 0; i < most; ++i) {
    const double a = 0.5 + 0.1 * random.uniform(), s = band.section.length() * random.uniform();
    samples.push_back({a, s, wear(s) - 0.5e-3 + kSectionNoise * tests::gaussian(random)});
  }
  const Section section = refine_section(tests::sorted(band, kSectionRows, kSectionColumns, samples), band, kFinest);
  for (double s = 3e-3; s < band.section.length() - 3e-3; s += 0.5e-3) {
    const auto foot = section.foot(band.section.at(s).position, 1e-3);
    ASSERT_TRUE(foot.has_value());
    EXPECT_NEAR(-foot->distance, wear(s), 2e-6) << s;
  }
}

}  // namespace
}  // namespace treadmark::scans
