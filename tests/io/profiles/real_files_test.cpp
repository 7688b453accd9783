// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/tests/io/profiles/samples.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::io {
namespace {

using testing::kRound;

constexpr double kDigit = 0.5e-9;  // m: half a unit of the sixth decimal of a mm

ProfileOptions never_mirrored(double scale = 1.0) {
  ProfileOptions options;
  options.mirror_z = -1;
  options.scale = scale;
  return options;
}

void expect_end_points(const Profile& p, double y0, double z0, double y1, double z1) {
  EXPECT_NEAR(p.y.front(), y0, kRound);
  EXPECT_NEAR(p.z.front(), z0, kRound);
  EXPECT_NEAR(p.y.back(), y1, kRound);
  EXPECT_NEAR(p.z.back(), z1, kRound);
}

TEST(RealProfiles, ManchesterRail) {
  TREADMARK_REQUIRE_SHARED();
  const Profile p = read_profile(*shared / "data/contact_examples/MBench_UIC60_v3.prr", Body::rail, {});
  EXPECT_EQ(p.y.size(), 495u);
  EXPECT_LT(p.y.front(), p.y.back());
  EXPECT_NEAR(*std::min_element(p.z.begin(), p.z.end()), 0.0, 1e-6);
  EXPECT_NEAR(p.y.front(), -0.043705, 1e-6);
  EXPECT_NEAR(p.y.back(), 0.030596, 1e-6);
}

TEST(RealProfiles, ManchesterWheelIsMirroredAndInvertedByItsFile) {
  TREADMARK_REQUIRE_SHARED();
  const Profile p = read_profile(*shared / "data/contact_examples/MBench_S1002_v3.prw", Body::wheel, {});
  EXPECT_EQ(p.y.size(), 399u);
  expect_end_points(p, 0.060, -2.6356764e-3, -0.069612628, 0.013485642);
  const auto tip = std::max_element(p.z.begin(), p.z.end()) - p.z.begin();
  EXPECT_NEAR(p.z[static_cast<std::size_t>(tip)], 0.028, 1e-6);  // flange height of S1002
  EXPECT_LT(p.y[static_cast<std::size_t>(tip)], -0.05);
}

TEST(RealProfiles, WideRailOfTheWheelFlatExample) {
  TREADMARK_REQUIRE_SHARED();
  const Profile p = read_profile(*shared / "data/contact_examples/r300_wide.prr", Body::rail, never_mirrored());
  EXPECT_EQ(p.y.size(), 801u);
  expect_end_points(p, -0.040435889, 0.031529605, 0.040435889, 0.031529605);
  // The head is a circle of radius 300 mm for 8 mm on both sides.
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    if (std::abs(p.y[i]) > 7e-3) continue;
    EXPECT_NEAR(p.z[i], 0.3 - std::sqrt(0.09 - p.y[i] * p.y[i]), 2 * kDigit);
  }
}

TEST(RealProfiles, CirclesOfTheTestBank) {
  TREADMARK_REQUIRE_SHARED();
  const auto folder = *shared / "data/contact_testbank/profiles";
  const auto expect_circle = [](const Profile& p, double radius, double sign) {
    for (std::size_t i = 0; i < p.y.size(); ++i)
      EXPECT_NEAR(sign * p.z[i], radius - std::sqrt(radius * radius - p.y[i] * p.y[i]), 2 * kDigit) << i;
  };
  expect_circle(read_profile(folder / "circ_r100.prr", Body::rail, {}), 0.1, 1.0);
  expect_circle(read_profile(folder / "circ_r300.prr", Body::rail, {}), 0.3, 1.0);
  expect_circle(read_profile(folder / "circ_r10.prw", Body::wheel, {}), 0.01, -1.0);
}

TEST(RealProfiles, EveryProfileOfTheTestBankIsAccepted) {
  TREADMARK_REQUIRE_SHARED();
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*shared / "data/contact_testbank/profiles")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".prr" && extension != ".prw") continue;
    const Body body = extension == ".prr" ? Body::rail : Body::wheel;
    const Profile p = read_profile(entry.path(), body, {});
    EXPECT_EQ(p.y.back() > p.y.front(), body == Body::rail) << entry.path();
    EXPECT_GE(p.y.size(), 100u);
    ++count;
  }
  EXPECT_EQ(count, 11);
}

TEST(RealSlices, WheelFlat) {
  TREADMARK_REQUIRE_SHARED();
  const SliceSet set = read_slices(*shared / "data/contact_examples/S1002_flat.slcw", Body::wheel, never_mirrored());
  ASSERT_EQ(set.u.size(), 258u);
  ASSERT_EQ(set.profiles.size(), 258u);
  EXPECT_NEAR(set.u.front(), -3.0995, kRound);
  EXPECT_NEAR(set.u.back(), 3.1224, kRound);
  EXPECT_TRUE(set.approximate_u);
  EXPECT_TRUE(set.features.empty());
  for (std::size_t i = 0; i < set.u.size(); ++i) {
    if (i > 0) {
      EXPECT_GT(set.u[i], set.u[i - 1]);
    }
    EXPECT_EQ(set.profiles[i].y.size(), 150u);
    EXPECT_GT(set.profiles[i].y.front(), 0.059);
    EXPECT_LT(set.profiles[i].y.back(), -0.068);
    const double flange = *std::max_element(set.profiles[i].z.begin(), set.profiles[i].z.end());
    EXPECT_GT(flange, 0.026) << i;
    EXPECT_LT(flange, 0.030) << i;
  }
}

TEST(RealSlices, AutomaticMirroringLeavesTheWheelFlatAlone) {
  TREADMARK_REQUIRE_SHARED();
  const auto file = *shared / "data/contact_examples/S1002_flat.slcw";
  const SliceSet automatic = read_slices(file, Body::wheel, {});
  const SliceSet never = read_slices(file, Body::wheel, never_mirrored());
  for (std::size_t i = 0; i < never.profiles.size(); ++i) EXPECT_EQ(automatic.profiles[i].z, never.profiles[i].z) << i;
}

TEST(RealSlices, CrossingNoseHasFeaturesUpToTheEnd) {
  TREADMARK_REQUIRE_SHARED();
  const SliceSet set =
      read_slices(*shared / "data/contact_testbank/profiles/cross_nose.slcs", Body::rail, never_mirrored());
  ASSERT_EQ(set.u.size(), 21u);
  EXPECT_NEAR(set.u.front(), -0.1, kRound);
  EXPECT_NEAR(set.u.back(), 0.1, kRound);
  EXPECT_FALSE(set.approximate_u);
  ASSERT_EQ(set.features.size(), 21u);
  for (std::size_t i = 0; i < 21; ++i) {
    ASSERT_EQ(set.features[i].size(), 5u);
    EXPECT_EQ(set.features[i][0], 0.0);
    EXPECT_NEAR(set.features[i][1], 33.0541e-3, kRound);
    EXPECT_NEAR(set.features[i][3], 87.0158e-3, kRound);
    const Profile& p = set.profiles[i];
    double length = 0.0;
    for (std::size_t k = 1; k < p.y.size(); ++k) length += std::hypot(p.y[k] - p.y[k - 1], p.z[k] - p.z[k - 1]);
    EXPECT_NEAR(set.features[i][4], length, kRound);
  }
  // The nose rises 1:10 while x advances by 10 mm a slice: its side grows by what the last part gains.
  EXPECT_EQ(set.profiles[0].y.size(), 506u);
}

TEST(RealSlices, WingRail) {
  TREADMARK_REQUIRE_SHARED();
  const SliceSet set =
      read_slices(*shared / "data/contact_testbank/profiles/wing_rail.slcs", Body::rail, never_mirrored());
  ASSERT_EQ(set.features.size(), 21u);
  for (std::size_t i = 0; i < 21; ++i) {
    EXPECT_NEAR(set.u[i], 0.01 * static_cast<double>(i), kRound);
    EXPECT_NEAR(set.features[i][1], 3.9267e-3 + 1e-3 * static_cast<double>(i), kRound);  // shifts sideways 1:10
  }
}

TEST(RealSlices, InterruptedCrossingInMetresHasMissingFeatures) {
  TREADMARK_REQUIRE_SHARED();
  const SliceSet set =
      read_slices(*shared / "data/contact_testbank/profiles/uk_interrupt_v2.slcs", Body::rail, never_mirrored(1000.0));
  ASSERT_EQ(set.u.size(), 20u);
  EXPECT_NEAR(set.u.front(), -0.0852, kRound);
  EXPECT_NEAR(set.u.back(), 0.17881, kRound);
  for (std::size_t i = 0; i < 20; ++i) {
    ASSERT_EQ(set.features[i].size(), 11u);
    for (std::size_t f = 0; f < 11; ++f) EXPECT_EQ(std::isnan(set.features[i][f]), i < 7 && f < 6) << i << ' ' << f;
  }
  EXPECT_NEAR(set.features[0][9], 0.108581, kRound);
  EXPECT_NEAR(set.features[19][10], 0.250729, 1e-6);
  EXPECT_THROW(
      read_slices(*shared / "data/contact_testbank/profiles/uk_interrupt_v2.slcs", Body::rail, never_mirrored()),
      Error);
}

TEST(RealSlices, RoundedFlatIsPutIntoWheelOrder) {
  TREADMARK_REQUIRE_SHARED();
  const SliceSet set =
      read_slices(*shared / "data/contact_testbank/profiles/flat_d09.slcw", Body::wheel, never_mirrored());
  ASSERT_EQ(set.u.size(), 57u);
  for (const Profile& p : set.profiles) {
    EXPECT_EQ(p.y.size(), 131u);
    EXPECT_NEAR(p.y.front(), 0.03020927, kRound);
    EXPECT_NEAR(p.y.back(), -0.03020927, kRound);
  }
}

}  // namespace
}  // namespace treadmark::io
