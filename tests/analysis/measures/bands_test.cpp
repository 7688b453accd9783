// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/bands.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::measures {
namespace {

/// ISO 3095:2013, figure 2: wavelength [m] and limit [dB re 1 um], as read off its listing in EN 15610, annex B.
const std::vector<std::pair<double, double>> kLimits{
    {0.4, 17.1},    {0.315, 15.0}, {0.25, 13.0},   {0.2, 11.0},     {0.16, 9.0},  {0.125, 7.0},
    {0.1, 4.9},     {0.08, 2.9},   {0.063, 0.9},   {0.05, -1.1},    {0.04, -3.2}, {0.0315, -5.0},
    {0.025, -5.6},  {0.02, -6.2},  {0.016, -6.8},  {0.0125, -7.4},  {0.01, -8.0}, {0.008, -8.6},
    {0.0063, -9.2}, {0.005, -9.8}, {0.004, -10.4}, {0.00315, -11.0}};

TEST(Bands, LimitsAreThoseOfTheStandard) {
  std::size_t limited = 0;
  for (const double nominal : third_octaves()) {
    const auto at =
        ranges::find_if(kLimits, [&](const auto& row) { return std::fabs(row.first - nominal) < 1e-3 * nominal; });
    if (at == kLimits.end()) {
      EXPECT_TRUE(std::isnan(iso_3095_limit(nominal))) << nominal;
      continue;
    }
    ++limited;
    EXPECT_DOUBLE_EQ(iso_3095_limit(nominal), at->second) << nominal;
  }
  EXPECT_EQ(limited, kLimits.size());
  EXPECT_TRUE(std::isnan(iso_3095_limit(0.3)));
}

/// IEC 61260: each middle is 10^(1/10) of the next, nominal ones are rounded, bands meet.
TEST(Bands, CoverTheirRangeWithoutGaps) {
  ASSERT_EQ(third_octaves().size(), 29u);
  EXPECT_DOUBLE_EQ(third_octaves().front(), 2.0);
  EXPECT_DOUBLE_EQ(third_octaves().back(), 0.00315);
  for (std::size_t i = 0; i < third_octaves().size(); ++i) {
    const double exact = 2.0 * std::pow(10.0, -0.1 * static_cast<double>(i)) * std::pow(10.0, 0.3) / 2.0;
    EXPECT_NEAR(third_octaves()[i], exact, 0.013 * exact) << i;  // of 0.63 for 0.631 up to 1.25 for 1.259, 0.315
    const BandEnds ends = ends_of(third_octaves()[i]);
    EXPECT_NEAR(std::sqrt(ends.shortest * ends.longest), exact, 1e-12);
    EXPECT_NEAR(ends.longest / ends.shortest, std::pow(10.0, 0.1), 1e-12);
    if (i > 0) {
      EXPECT_NEAR(ends.longest, ends_of(third_octaves()[i - 1]).shortest, 1e-12);
    }
  }
  EXPECT_DOUBLE_EQ(level_of(1e-6), 0.0);
  EXPECT_NEAR(level_of(10e-6), 20.0, 1e-12);
}

}  // namespace
}  // namespace treadmark::measures
