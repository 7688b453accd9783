// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace treadmark::detection {
namespace {

ContactPatch patch(double y_min, double y_max, double angle, double weight, double z = 0.0) {
  ContactPatch p;
  p.extent.box = {-5e-3, 5e-3, y_min, y_max};
  p.extent.z_at_y_min = p.extent.z_at_y_max = z;
  p.y = 0.5 * (y_min + y_max);
  p.inclination = angle;
  p.weight = weight;
  p.least_gap = -1e-5 * weight;
  p.parts = {p.extent};
  return p;
}

PatchRules rules() {
  PatchRules r;
  r.angle_separation = 0.5;
  r.separation = 8e-3;
  r.combination = 4e-3;
  r.turning = 12e-3;
  return r;
}

TEST(ContactPatch, DistanceCountsHeightOnlyAcross) {
  EXPECT_NEAR(patch_distance(patch(0.0, 1e-3, 0, 1, 0.0).extent, patch(4e-3, 5e-3, 0, 1, 4e-3).extent), 5e-3, 1e-15);
  EXPECT_EQ(patch_distance(patch(0.0, 3e-3, 0, 1, 0.0).extent, patch(2e-3, 5e-3, 0, 1, 4e-3).extent), 0.0);
}

TEST(ContactPatch, SortsFieldSideFirst) {
  const auto result = combine_patches({patch(0.0, 1e-3, 0.0, 1.0), patch(40e-3, 41e-3, 0.0, 1.0)}, {}, rules());
  ASSERT_EQ(result.size(), 2u);
  EXPECT_GT(result[0].y, result[1].y);
}

TEST(ContactPatch, MergesNearOnesWithWeightedReference) {
  const auto result = combine_patches({patch(0.0, 1e-3, 0.1, 1.0), patch(3e-3, 5e-3, 0.3, 3.0)}, {}, rules());
  ASSERT_EQ(result.size(), 1u);
  EXPECT_NEAR(result[0].inclination, 0.25, 1e-15);
  EXPECT_NEAR(result[0].y, 0.25 * 0.5e-3 + 0.75 * 4e-3, 1e-15);
  EXPECT_EQ(result[0].extent.box.y_min, 0.0);
  EXPECT_EQ(result[0].extent.box.y_max, 5e-3);
  EXPECT_EQ(result[0].parts.size(), 1u);
}

TEST(ContactPatch, SubPatchesFurtherApartKeepTheirExtents) {
  const auto result = combine_patches({patch(0.0, 1e-3, 0.1, 1.0), patch(7e-3, 8e-3, 0.3, 3.0)}, {}, rules());
  ASSERT_EQ(result.size(), 1u);
  ASSERT_EQ(result[0].parts.size(), 2u);
  EXPECT_EQ(result[0].parts[0].box.y_min, 7e-3);
  EXPECT_NEAR(sub_patch_coupling(patch_distance(result[0].parts[0], result[0].parts[1]), rules()), std::pow(0.5, 0.8),
              1e-12);
  EXPECT_EQ(sub_patch_coupling(3e-3, rules()), 1.0);
  EXPECT_EQ(sub_patch_coupling(9e-3, rules()), 0.0);
}

TEST(ContactPatch, KeepsDifferentAnglesApart) {
  EXPECT_EQ(combine_patches({patch(0.0, 1e-3, -0.6, 1.0), patch(2e-3, 3e-3, 0.0, 1.0)}, {}, rules()).size(), 2u);
}

TEST(ContactPatch, AnglesTurnContinuouslyTowardsTheMerge) {
  const auto at = [](double distance) {
    return combine_patches({patch(0.0, 1e-3, 0.1, 1.0), patch(1e-3 + distance, 2e-3 + distance, 0.3, 1.0)}, {},
                           rules());
  };
  const auto far = at(13e-3), at_turning = at(12e-3), half = at(10e-3), nearly = at(8.001e-3), merged = at(7.999e-3);
  EXPECT_NEAR(far[0].inclination, 0.3, 1e-12);
  EXPECT_NEAR(at_turning[0].inclination, 0.3, 1e-9);
  EXPECT_NEAR(half[0].inclination, 0.25, 1e-9);
  EXPECT_NEAR(half[1].inclination, 0.15, 1e-9);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_NEAR(nearly[0].inclination, merged[0].inclination, 1e-4);
  EXPECT_NEAR(nearly[1].inclination, merged[0].inclination, 1e-4);
}

TEST(ContactPatch, NearMissExtendsThePatchInProportion) {
  PatchRules r = rules();
  r.near_miss = 1e-4;
  ContactPatch miss = patch(3e-3, 3e-3, 0.0, 0.0);
  miss.least_gap = 0.25e-4;
  const auto result = combine_patches({patch(0.0, 1e-3, 0.0, 1.0)}, {miss}, r);
  ASSERT_EQ(result.size(), 1u);
  EXPECT_NEAR(result[0].extent.box.y_max, 0.25 * 1e-3 + 0.75 * 3e-3, 1e-12);
}

}  // namespace
}  // namespace treadmark::detection
