// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/section_fit.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;

/// Points of the flanged section with noise along its normals; damaged: part of them up to depth inside the material.
std::vector<Vec2> heap(int count, double noise, double damaged, double depth, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k) {
    const double y = -65e-3 + 125e-3 * random.uniform();
    double off = noise * tests::gaussian(random);
    if (random.uniform() < damaged) off -= depth * random.uniform();
    points.push_back(Vec2(y, tests::flanged(y)) + off * Vec2(-tests::flanged_slope(y), 1.0).normalized());
  }
  return points;
}

struct Apart {
  double rms = 0.0, worst = 0.0;
};
/// How far the section lies off the closed form along its normals, its ends left out.
Apart apart(const Section& section, double margin) {
  Apart out;
  int count = 0;
  for (double y = -65e-3 + margin; y <= 60e-3 - margin; y += 0.5e-3) {
    const double off = (section.v_at(y) - tests::flanged(y)) / std::hypot(1.0, tests::flanged_slope(y));
    out.worst = std::max(out.worst, std::fabs(off));
    out.rms += off * off;
    ++count;
  }
  out.rms = std::sqrt(out.rms / count);
  return out;
}

TEST(Outline, IsTheSectionWithinItsStrips) {
  const auto points = heap(20'000, 30e-6, 0.0, 0.0, 1);
  const Section section = outline(points);
  EXPECT_NEAR(section.y_min(), -65e-3, 1.5e-3);
  EXPECT_NEAR(section.y_max(), 60e-3, 1.5e-3);
  const Apart error = apart(section, 2e-3);
  // medians of strips 1 mm wide
  EXPECT_LT(error.worst, 0.2e-3);
  EXPECT_LT(error.rms, 0.06e-3);
}

TEST(Outline, IsTheOutermostOfSeveralLayersAndLeavesOutFewPointsAboveIt) {
  auto points = heap(20'000, 30e-6, 0.0, 0.0, 2);
  Random random(3);
  // an inner surface, as of the web or the other side of the rim, and a few points in the air
  for (int k = 0; k < 8000; ++k) {
    const double y = -60e-3 + 115e-3 * random.uniform();
    points.emplace_back(y, tests::flanged(y) - 60e-3);
  }
  for (int k = 0; k < 300; ++k) points.emplace_back(-60e-3 + 115e-3 * random.uniform(), 40e-3 + 0.2 * random.uniform());
  const Apart error = apart(outline(points), 2e-3);
  EXPECT_LT(error.worst, 0.4e-3);
}

TEST(Outline, EndsAtStepsAndGaps) {
  std::vector<Vec2> points;
  for (int k = 0; k < 20'000; ++k) {
    const double y = 100e-3 * k / 20'000;
    if (y > 50e-3 && y < 60e-3) continue;                           // a gap of 10 mm
    points.emplace_back(y, y > 30e-3 && y <= 50e-3 ? 12e-3 : 0.0);  // a step up of 12 mm at 30 mm
  }
  const Section section = outline(points);
  EXPECT_NEAR(section.y_min(), 30e-3, 1e-3);
  EXPECT_NEAR(section.y_max(), 50e-3, 1e-3);
  EXPECT_NEAR(section.v_at(40e-3), 12e-3, 1e-9);
}

TEST(Outline, RefusesWhatHasNone) {
  const auto of = [](const std::vector<Vec2>& points) { return tests::error_of([&] { outline(points); }); };
  std::vector<Vec2> wall, narrow, none;
  for (int k = 0; k < 1000; ++k) {
    wall.emplace_back(0.0, 1e-3 * k);
    narrow.emplace_back(8e-3 * k / 1000, 0.0);
  }
  for (const auto& points : {wall, narrow, none}) {
    const auto error = of(points);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->kind(), ErrorKind::input_data);
    EXPECT_THAT(error->message(), HasSubstr("the scan has no usable cross-section"));
  }
}

TEST(SectionFit, FollowsCleanPointsFarBelowTheirNoise) {
  const auto points = heap(40'000, 30e-6, 0.0, 0.0, 4);
  const SectionFit fit = fit_section(outline(points), points, 5e-3, 4e-3);
  const Apart error = apart(fit.section, 3e-3);
  // knots 4 mm apart leave some of what the outline was wrong by on the flank
  EXPECT_LT(error.rms, 8e-6);
  EXPECT_LT(error.worst, 50e-6);
  EXPECT_NEAR(fit.scale, 30e-6, 1.5e-6);
  EXPECT_NEAR(fit.spread, 30e-6, 3e-6);
  EXPECT_GT(fit.used, 39'000u);
}

TEST(SectionFit, IsNotDrawnByAThirdOfDamagedPoints) {
  const auto points = heap(40'000, 30e-6, 0.3, 2e-3, 5);
  const SectionFit fit = fit_section(outline(points), points, 5e-3, 4e-3);
  const Apart error = apart(fit.section, 3e-3);
  EXPECT_LT(error.rms, 12e-6);
  EXPECT_LT(error.worst, 60e-6);
  // the damage is in the spread, rms of 2 mm evenly in 30 % of the points
  EXPECT_NEAR(fit.spread, std::sqrt(0.3 / 3.0) * 2e-3, 0.06e-3);
  EXPECT_LT(fit.scale, 60e-6);
  // plain means of strips would be off by 0.3 mm
}

TEST(SectionFit, CrossesAGapSmoothly) {
  auto points = heap(40'000, 30e-6, 0.0, 0.0, 6);
  std::erase_if(points, [](const Vec2& p) { return p.x() > 20e-3 && p.x() < 25e-3; });
  const SectionFit fit = fit_section(outline(points), points, 5e-3, 4e-3);
  EXPECT_LT(apart(fit.section, 3e-3).worst, 60e-6);
}

TEST(SectionFit, RefusesPointsThatAreElsewhere) {
  auto points = heap(2000, 30e-6, 0.0, 0.0, 7);
  const Section section(tests::flanged_points());
  for (Vec2& p : points) p.y() += 50e-3;
  const auto error = tests::error_of([&] { fit_section(section, points, 5e-3, 4e-3); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind(), ErrorKind::input_data);
  EXPECT_THAT(error->message(), HasSubstr("too few points follow the cross-section"));
}

}  // namespace
}  // namespace treadmark::scans
