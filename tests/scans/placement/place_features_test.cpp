// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Placed by what is known without a nominal profile: the scan's own features, and which way is up or forward.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/scans/placement/place.hpp"
#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;
using tests::kPi;

tests::SimpleCloud wheel_cloud(std::uint64_t seed) {
  const auto wheel = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, {}});
  return tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, -69.5e-3, 60e-3, 200, 130, 30e-6, 0.005,
                             tests::some_frame(seed), seed);
}
tests::SimpleCloud rail_cloud(std::uint64_t seed) {
  const auto rail = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  return tests::simple_cloud(*rail, Body::rail, -0.3, 0.3, -35.5e-3, 35.5e-3, 600, 60, 20e-6, 0.005,
                             tests::some_frame(seed), seed);
}
Placement placed(const tests::SimpleCloud& cloud, const PlaceSettings& settings) {
  return place(cloud.points_C, {}, find_roughly(cloud.points_C, {}, settings.body), settings);
}

TEST(PlaceByFeatures, WheelHasItsFlangeAtNegativeY) {
  PlaceSettings settings;
  settings.body = Body::wheel;
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    const auto cloud = wheel_cloud(seed);
    const Placement found = placed(cloud, settings);
    EXPECT_FALSE(found.match);
    EXPECT_GT(found.X_CS.rotation.col(1).dot(cloud.X_CS.rotation.col(1)), 1.0 - 1e-9) << seed;
    EXPECT_NEAR(found.X_CS.rotation.determinant(), 1.0, 1e-9);
    // y = 0 lies 70 mm from where the flange begins, which is within 3 mm of its back: it is too steep there
    EXPECT_NEAR(found.section.y_min(), -70e-3, 1e-3);
    const Vec3 apart = cloud.X_CS.apply_inverse(found.X_CS.origin);
    EXPECT_GT(apart.y(), -0.5e-3);
    EXPECT_LT(apart.y(), 3e-3);
    EXPECT_LT(std::hypot(apart.x(), apart.z()), 6e-6);
    EXPECT_NEAR(found.nominal_radius, found.section.v_at(0.0), 20e-6);
    EXPECT_NEAR(found.nominal_radius, 0.46, 0.3e-3);  // the tread slopes by less than 1:15 there
  }
}

TEST(PlaceByFeatures, WheelTakesTheRadiusAndForwardThatAreGiven) {
  const auto cloud = wheel_cloud(2);
  PlaceSettings settings;
  settings.body = Body::wheel;
  settings.radius = 0.47;
  // 40 degrees off says which way as well
  settings.forward = -(cloud.X_CS.rotation * rotation_x(0.7)).col(1);
  const Placement found = placed(cloud, settings);
  EXPECT_EQ(found.nominal_radius, 0.47);
  EXPECT_LT(found.X_CS.rotation.col(1).dot(cloud.X_CS.rotation.col(1)), -1.0 + 1e-9);
}

TEST(PlaceByFeatures, WheelForwardHoldsAgainstTheNominalProfileToo) {
  const auto cloud = wheel_cloud(3);
  PlaceSettings settings;
  settings.body = Body::wheel;
  settings.nominal = Section(tests::nominal_points("S1002", Body::wheel));
  for (const double way : {1.0, -1.0}) {
    settings.forward = way * cloud.X_CS.rotation.col(1);
    const auto refused = tests::error_of([&] {
      const Placement found = placed(cloud, settings);
      EXPECT_GT(way * found.X_CS.rotation.col(1).dot(cloud.X_CS.rotation.col(1)), 0.99);
      EXPECT_FALSE(found.match->turned);
    });
    EXPECT_TRUE(!refused || way < 0.0);
  }
}

TEST(PlaceByFeatures, RailHasItsOriginOnTopAndInTheMiddle) {
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    const auto cloud = rail_cloud(seed);
    PlaceSettings settings;
    settings.up = -cloud.X_CS.rotation.col(2);
    settings.forward = cloud.X_CS.rotation.col(0);
    const Placement found = placed(cloud, settings);
    EXPECT_FALSE(found.match);
    const Mat3 turn = found.X_CS.rotation.transpose() * cloud.X_CS.rotation;
    EXPECT_LT((turn - Mat3::Identity()).norm(), 1e-4) << seed;
    const Vec3 apart = cloud.X_CS.apply_inverse(found.X_CS.origin);
    EXPECT_NEAR(apart.y(), 0.0, 0.3e-3);  // the head of 60E1 is symmetric
    EXPECT_NEAR(apart.z(), 0.0, 30e-6);
    double top = -1.0;
    for (double s = 0.0; s < found.section.length(); s += 0.5e-3) top = std::max(top, found.section.at(s).position.y());
    EXPECT_NEAR(top, 0.0, 20e-6);
  }
}

TEST(PlaceByFeatures, RailFindsUpByItself) {
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    const auto cloud = rail_cloud(seed);
    const Placement found = placed(cloud, {});
    // by the normals alone, which the outliers and the flanks' unequal number of points turn a little
    EXPECT_GT(found.X_CS.rotation.col(2).dot(cloud.X_CS.rotation.col(2)), std::cos(0.1)) << seed;
    // forward: as the axis of the file that is nearest
    Eigen::Index nearest = 0;
    found.X_CS.rotation.col(0).cwiseAbs().maxCoeff(&nearest);
    EXPECT_GT(found.X_CS.rotation(nearest, 0), 0.0);
    EXPECT_GT(std::fabs(found.X_CS.rotation.col(0).dot(cloud.X_CS.rotation.col(0))), 1.0 - 1e-8);
  }
}

TEST(PlaceByFeatures, RailGoesForwardAsTold) {
  const auto cloud = rail_cloud(2);
  for (const bool nominal : {false, true})
    for (const double way : {1.0, -1.0}) {
      PlaceSettings settings;
      if (nominal) settings.nominal = Section(tests::nominal_points("60E1", Body::rail));
      settings.up = -cloud.X_CS.rotation.col(2) + 0.3 * cloud.X_CS.rotation.col(0);
      settings.forward = way * (cloud.X_CS.rotation.col(0) + 0.5 * cloud.X_CS.rotation.col(1));
      const Placement found = placed(cloud, settings);
      EXPECT_GT(way * found.X_CS.rotation.col(0).dot(cloud.X_CS.rotation.col(0)), 1.0 - 1e-8);
      EXPECT_GT(found.X_CS.rotation.col(2).dot(cloud.X_CS.rotation.col(2)), 1.0 - 1e-5);
    }
}

TEST(PlaceByFeatures, UpAlongTheRailIsRefused) {
  const auto cloud = rail_cloud(1);
  PlaceSettings settings;
  settings.up = cloud.X_CS.rotation.col(0);
  const auto error = tests::error_of([&] { placed(cloud, settings); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind(), ErrorKind::configuration);
  EXPECT_THAT(error->message(), HasSubstr("runs along the rail"));
}

}  // namespace
}  // namespace treadmark::scans
