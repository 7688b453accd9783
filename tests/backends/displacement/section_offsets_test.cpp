// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/section_offsets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark::displacement {
namespace {

constexpr double kFirstPlace = -0.01, kPlaceStep = 2e-3;
const std::vector<double> kPlaceValues{1e-5, -2e-5, 0.0, 3e-5, 3e-5, -1e-5, 2e-5};

TEST(SectionOffsets, GoThroughTheirValues) {
  const auto field = section_offsets(kFirstPlace, kPlaceStep, kPlaceValues);
  for (std::size_t k = 0; k < kPlaceValues.size(); ++k)
    EXPECT_NEAR(field->jet(7.0, kFirstPlace + static_cast<double>(k) * kPlaceStep).value, kPlaceValues[k], 1e-18);
  EXPECT_NEAR(field->jet(0.0, -1.0).value, kPlaceValues.front(), 1e-18);
  EXPECT_NEAR(field->jet(0.0, 1.0).value, kPlaceValues.back(), 1e-18);
  EXPECT_EQ(field->jet(0.0, 1.0).d_y, 0.0);
  EXPECT_TRUE(field->constant_along());
  // a natural spline has straight lines
  const auto line = section_offsets(0.0, 1.0, {1.0, 3.0, 5.0, 7.0});
  EXPECT_NEAR(line->jet(0.0, 1.3).value, 3.6, 1e-12);
  EXPECT_NEAR(line->jet(0.0, 2.7).d_y, 2.0, 1e-12);
  EXPECT_NEAR(section_offsets(0.0, 1.0, {1.0, 3.0})->jet(0.0, 0.25).value, 1.5, 1e-12);
}

TEST(SectionOffsets, HaveDerivativesAndBounds) {
  const auto field = section_offsets(kFirstPlace, kPlaceStep, kPlaceValues);
  constexpr double kDifference = 1e-7, kSame = 1e-7, kSameBend = 1e-3;
  for (double y = kFirstPlace + 1e-4; y < 1.9e-3; y += 3.7e-4) {
    const OffsetJet at = field->jet(0.0, y), more = field->jet(0.0, y + kDifference),
                    less = field->jet(0.0, y - kDifference);
    EXPECT_NEAR(at.d_y, (more.value - less.value) / (2.0 * kDifference), kSame);
    EXPECT_NEAR(at.d_yy, (more.d_y - less.d_y) / (2.0 * kDifference), kSameBend * (1.0 + std::abs(at.d_yy)));
    for (const double half : {1e-4, 1e-3, 5e-3}) {
      const OffsetRange range = field->range({0.0, 1.0, y - half, y + half});
      for (double there = y - half; there <= y + half; there += half / 7.0) {
        const OffsetJet jet = field->jet(0.0, there);
        EXPECT_LE(range.low, jet.value + 1e-18);
        EXPECT_GE(range.high, jet.value - 1e-18);
        EXPECT_GE(range.max_d_y, std::abs(jet.d_y) - 1e-12);
      }
    }
  }
  EXPECT_TRUE(section_offsets(0.0, 1.0, {0.0, 0.0, 0.0})->range({-9.0, 9.0, -9.0, 9.0}).zero());
}

TEST(SectionOffsets, RefuseNonsense) {
  EXPECT_THROW(section_offsets(0.0, 1.0, {1.0}), Error);
  EXPECT_THROW(section_offsets(0.0, 0.0, {1.0, 2.0}), Error);
  EXPECT_THROW(section_offsets(std::nan(""), 1.0, {1.0, 2.0}), Error);
}

}  // namespace
}  // namespace treadmark::displacement
