// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/damage.hpp"

#include <gtest/gtest.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/tests/scans/fit/level_samples.hpp"

namespace treadmark::scans {
namespace {

constexpr double kDamagedLength = 2.0, kDamagedWidth = 0.08;
constexpr std::size_t kDamagedAlong = 1000, kDamagedAcross = 40;

/// An elliptic paraboloid: depth (1 - x^2 / l^2 - y^2 / w^2); half of depth times the ellipse's area is missing.
struct Flat {
  double a, s, l, w, depth;

  double at(double x, double y) const { return -depth * std::max(0.0, 1.0 - x * x / (l * l) - y * y / (w * w)); }
  double volume() const { return 0.5 * depth * kPi * l * w; }
};

SplineField field_of(const Band& band, const std::vector<Flat>& flats) {
  SplineField field(kDamagedLength, kDamagedWidth, band.closed);
  SplineLevel level = tests::level_of(kDamagedLength, kDamagedWidth, kDamagedAlong, kDamagedAcross, band.closed);
  tests::sample_into(level, [&](double a, double s) {
    double sum = 0.0;
    for (const Flat& f : flats) {
      const double off = a - f.a;
      sum += f.at(band.closed ? off - kDamagedLength * std::round(off / kDamagedLength) : off, s - f.s);
    }
    return sum;
  });
  field.add(std::move(level));
  return field;
}

void expect_flat(const Band& band, const Damage& found, const Flat& flat, double threshold) {
  const double off = found.a - flat.a;
  EXPECT_NEAR(band.closed ? off - kDamagedLength * std::round(off / kDamagedLength) : off, 0.0, 0.2e-3);
  EXPECT_NEAR(found.s, flat.s, 0.2e-3);
  EXPECT_NEAR(found.depth, flat.depth, 0.015 * std::fabs(flat.depth));
  EXPECT_NEAR(found.volume, flat.volume(), 0.015 * std::fabs(flat.volume()));
  const double part = std::sqrt(1.0 - threshold / std::fabs(flat.depth));
  EXPECT_NEAR(found.length, 2.0 * flat.l * part, 3e-3);
  EXPECT_NEAR(found.width, 2.0 * flat.w * part, 3e-3);
}

TEST(Damage, KnownFlatsAreMeasured) {
  constexpr double kThreshold = 20e-6;
  for (const bool closed : {false, true}) {
    const Band band = tests::straight_band(kDamagedLength, kDamagedWidth, closed);
    // in the order of their volumes; the second is material that stands out, the third lies across a closed band's seam
    const std::vector<Flat> flats{{1.2, 40e-3, 60e-3, 25e-3, 1e-3},
                                  {0.6, 35e-3, 50e-3, 20e-3, -0.8e-3},
                                  {closed ? 4e-3 : 0.2, 45e-3, 40e-3, 20e-3, 0.6e-3}};
    const auto found = find_damage(band, field_of(band, flats), 0.0, kDamagedWidth, kThreshold);
    ASSERT_EQ(found.size(), flats.size());
    for (std::size_t k = 0; k < flats.size(); ++k) {
      SCOPED_TRACE(k);
      expect_flat(band, found[k], flats[k], kThreshold);
    }
    EXPECT_LT(found[1].depth, 0.0);
    EXPECT_LT(found[1].volume, 0.0);
  }
}

TEST(Damage, OnlyTheUsablePartIsLookedAt) {
  const Band band = tests::straight_band(kDamagedLength, kDamagedWidth, false);
  const Flat flat{1.0, 40e-3, 60e-3, 25e-3, 1e-3};
  const auto half = find_damage(band, field_of(band, {flat}), 40e-3, kDamagedWidth, 10e-6);
  ASSERT_EQ(half.size(), 1u);
  EXPECT_NEAR(half[0].volume, 0.5 * flat.volume(), 0.02 * flat.volume());
  EXPECT_NEAR(half[0].width, 25e-3, 2e-3);
  EXPECT_GT(half[0].s, 40e-3);
  EXPECT_TRUE(find_damage(band, field_of(band, {flat}), 70e-3, kDamagedWidth, 10e-6).empty());
}

TEST(Damage, ShallowAndSmallPartsAreLeftOut) {
  const Band band = tests::straight_band(kDamagedLength, kDamagedWidth, true);
  const SplineField field = field_of(band, {{0.5, 40e-3, 60e-3, 25e-3, 50e-6}, {1.5, 40e-3, 2.2e-3, 2.2e-3, 1e-3}});
  EXPECT_TRUE(find_damage(band, field, 0.0, kDamagedWidth, 0.3e-3).empty()) << "a spot of 3 mm";
  const auto found = find_damage(band, field, 0.0, kDamagedWidth, 10e-6);
  ASSERT_GE(found.size(), 1u);
  EXPECT_NEAR(found[0].a, 0.5, 1e-3);
  EXPECT_TRUE(find_damage(band, SplineField(kDamagedLength, kDamagedWidth, true), 0.0, kDamagedWidth, 0.0).empty());
}

}  // namespace
}  // namespace treadmark::scans
