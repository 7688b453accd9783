// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/imports/import_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/report/pictures/imports/import_section.hpp"

namespace treadmark {
namespace {

constexpr float kFloatNan = std::numeric_limits<float>::quiet_NaN();
constexpr auto kClear = static_cast<std::uint8_t>(pictures::kImageSteps);

TEST(ImportMap, RunsToTheRightAndUp) {
  const io::BandMap map{3, 2, 0.0, 0.3, 0.0, 0.1, {0.0f, 1.0f, 2.0f, 3.0f, 4.0f, kFloatNan}};
  pictures::ColourScale colours;
  colours.high = 4.0;
  const pictures::PaletteImage image =
      pictures::map_image(pictures::raster_of(map), colours, pictures::PixelRule::any, 100, 100);
  ASSERT_EQ(image.width, 3u);
  ASSERT_EQ(image.height, 2u);
  const std::vector<std::uint8_t> wanted{16, 48, kClear, 0, 32, 63};  // 64 steps from 0 to 4
  EXPECT_EQ(image.index, wanted);
  EXPECT_EQ(image.palette[kClear][3], 0);
  EXPECT_EQ(image.palette[0][3], 255);
}

TEST(ImportMap, FineMapsAreAveraged) {
  io::BandMap map{7, 5, 0.0, 0.7, 0.0, 0.5, {}};
  for (int i = 0; i < 35; ++i) map.value.push_back(i % 4 == 1 ? kFloatNan : static_cast<float>(i % 11));
  pictures::ColourScale colours;
  colours.high = 11.0;
  const pictures::PaletteImage image =
      pictures::map_image(pictures::raster_of(map), colours, pictures::PixelRule::any, 3, 2);
  ASSERT_EQ(image.index.size(), 6u);
  const std::size_t rows[4] = {0, 2, 4, 7}, columns[3] = {0, 2, 5};
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t i = 0; i < 3; ++i) {
      double sum = 0.0;
      int count = 0;
      for (std::size_t r = rows[i]; r < rows[i + 1]; ++r)
        for (std::size_t c = columns[j]; c < columns[j + 1]; ++c)
          if (const float v = map.value[r * 5 + c]; !std::isnan(v)) sum += v, ++count;
      EXPECT_EQ(image.index[(1 - j) * 3 + i], static_cast<int>(sum / count / 11.0 * 64.0)) << i << " " << j;
    }
}

TEST(ImportMap, APixelOfTheSurfaceNeedsHalfOfItsCells) {
  const io::BandMap map{4, 1, 0.0, 0.4, 0.0, 0.1, {1.0f, kFloatNan, kFloatNan, kFloatNan}};
  pictures::ColourScale colours;
  const pictures::PaletteImage two =
      pictures::map_image(pictures::raster_of(map), colours, pictures::PixelRule::half, 2, 1);
  EXPECT_EQ(two.index, (std::vector<std::uint8_t>{63, kClear}));
  EXPECT_EQ(pictures::map_image(pictures::raster_of(map), colours, pictures::PixelRule::half, 1, 1).index[0], kClear);
  EXPECT_EQ(pictures::map_image(pictures::raster_of(map), colours, pictures::PixelRule::any, 1, 1).index[0], 63);
}

TEST(ImportMap, ColoursSayWhatLiesBeyondThem) {
  io::BandMap map{100, 50, 0.0, 1.0, 0.0, 0.1, {}};
  for (int i = 0; i < 5000; ++i) map.value.push_back(static_cast<float>(1e-4 * std::sin(i)));
  pictures::ColourScale colours = pictures::diverging_colours(map);
  EXPECT_EQ(colours.unit, "\u00b5m");
  EXPECT_NEAR(colours.high, 100.0, 1e-9);
  EXPECT_EQ(colours.low, -colours.high);
  EXPECT_FALSE(colours.below || colours.above);
  map.value[7] = -1.0f;  // one spike does not pale all others
  colours = pictures::diverging_colours(map);
  EXPECT_NEAR(colours.high, 100.0, 1e-9);
  EXPECT_TRUE(colours.below);
  EXPECT_FALSE(colours.above);
}

TEST(ImportMap, DivergingColoursDarkenEvenlyToBothSides) {
  const auto light = [](double part) {  // relative luminance without gamma
    const auto c = pictures::map_colour(part, pictures::Palette::diverging);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  };
  for (int i = 0; i < 32; ++i) {
    EXPECT_LT(light(i / 64.0), light((i + 1) / 64.0));
    EXPECT_LT(light(1.0 - i / 64.0), light(1.0 - (i + 1) / 64.0));
  }
  EXPECT_EQ(pictures::map_colour(0.5, pictures::Palette::diverging),
            pictures::map_colour(0.0, pictures::Palette::from_white));
  EXPECT_EQ(pictures::map_colour(std::nan(""), pictures::Palette::diverging),
            pictures::map_colour(0.5, pictures::Palette::diverging));
}

TEST(ImportMap, LimitsAreRound) {
  EXPECT_NEAR(pictures::round_limit(0.85), 1.0, 1e-12);
  EXPECT_NEAR(pictures::round_limit(1.0), 1.0, 1e-12);
  EXPECT_NEAR(pictures::round_limit(111.0), 120.0, 1e-9);
  EXPECT_NEAR(pictures::round_limit(0.0021), 0.0025, 1e-12);
  EXPECT_EQ(pictures::round_limit(0.0), 1.0);
  EXPECT_EQ(pictures::round_limit(std::nan("")), 1.0);
}

TEST(ImportSection, DeviationIsPositiveOutOfTheMaterial) {
  // A straight line and one that lies 0.1 mm beside it: z down, so a rail with more material has less z.
  io::SectionPoints rail, high;
  for (int i = 0; i <= 20; ++i) {
    rail.push_back({0.001 * i, 0.0005 * i});
    high.push_back({0.001 * i, 0.0005 * i - 1e-4});
  }
  const double normal = 1e-4 / std::sqrt(1.25);  // vertical distance times the cosine of the slope
  for (const bool turned : {false, true}) {
    io::SectionPoints nominal = rail;
    if (turned) std::reverse(nominal.begin(), nominal.end());
    const std::vector<Vec2> found = pictures::deviation_from_nominal(high, nominal, Body::rail);
    ASSERT_GE(found.size(), 19u);
    for (const Vec2& p : found) EXPECT_NEAR(p.y(), normal, 1e-12);
    for (const Vec2& p : pictures::deviation_from_nominal(high, nominal, Body::wheel))
      EXPECT_NEAR(p.y(), -normal, 1e-12);
  }
  EXPECT_TRUE(pictures::deviation_from_nominal(high, {}, Body::rail).empty());
}

TEST(ImportSection, PlacesAlongTheSectionFollowItsArc) {
  const io::SectionPoints bend{{0.06, 0.0}, {0.02, 0.0}, {0.0, 0.02}};  // runs with decreasing y
  const double bevel = std::sqrt(8.0) * 0.01;
  EXPECT_NEAR(pictures::s_of_y(bend, 0.0, 0.04 + bevel, 0.03), 0.03, 1e-15);
  EXPECT_NEAR(pictures::s_of_y(bend, 1.0, 1.04 + bevel, 0.01), 1.04 + 0.5 * bevel, 1e-12);
  EXPECT_TRUE(std::isnan(pictures::s_of_y(bend, 0.0, 1.0, 0.1)));
  EXPECT_TRUE(std::isnan(pictures::s_of_y({}, 0.0, 1.0, 0.0)));
}

}  // namespace
}  // namespace treadmark
