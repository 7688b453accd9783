// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The contact locus of constant profiles against the grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/search/scenes.hpp"

namespace treadmark::testing {
namespace {

using detection::ContactSearch;
using detection::SearchMethod;
using detection::SearchSettings;

constexpr double kRailRadius = 0.46;

struct Profiles {
  std::shared_ptr<const Surface> rail, wheel;
};

Profiles profiles(std::string_view backend) {
  return {create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}}, backend),
          create_surface({Body::wheel, kRailRadius, StandardProfile{"S1002"}, {}}, backend)};
}

SearchSettings fine_grid() {
  SearchSettings s;
  s.grid_T = {-0.09, -0.036, 0.3e-3, 0.06e-3, 601, 1201};
  s.refined_points = 300;
  s.rules.separation = 2e-3, s.rules.combination = 1e-3;
  return s;
}

detection::BodyPair placed(const Profiles& p, double y, double roll, double yaw, double pitch) {
  detection::BodyPair pair{p.rail.get(), p.wheel.get(), {Vec3::Zero(), rotation_x(-1.0 / 40.0)}, {}};
  pair.X_TW = {{0.0, y, -kRailRadius}, rotation({roll, yaw, pitch})};
  return pair;
}

class Locus : public ::testing::TestWithParam<std::string_view> {};

TEST_P(Locus, EqualsTheGrid) {
  const Profiles p = profiles(GetParam());
  int two_patches = 0;
  std::vector<double> lateral;
  for (double y = -0.012; y < 0.0121; y += 0.75e-3) lateral.push_back(y);
  for (double y = -1.5e-3; y < 0.8e-3; y += 0.05e-3) lateral.push_back(y);  // where the flange takes over
  for (const double y : lateral)
    for (const double yaw : {0.0, 0.004, -0.025})
      for (const double depth : {2e-5, 1.2e-4}) {
        const auto pair = placed(p, y, 0.3 * yaw, yaw, 0.4 * y / 0.012);
        SearchSettings s = fine_grid();
        s.method = SearchMethod::automatic;
        ContactSearch locus(pair, s);
        ASSERT_EQ(locus.method(), SearchMethod::locus);
        s.method = SearchMethod::pruned_grid;
        ContactSearch grid(pair, s);
        const double least = grid.at(grid.least_gap()).least_gap + grid.least_gap();
        const auto a = locus.at(least + depth), b = grid.at(least + depth);
        const std::string where =
            "y = " + std::to_string(y) + ", yaw = " + std::to_string(yaw) + ", depth " + std::to_string(depth);
        ASSERT_EQ(a.patches.size(), b.patches.size()) << where;
        two_patches += a.patches.size() == 2;
        for (std::size_t i = 0; i < a.patches.size(); ++i) {
          const auto &u = a.patches[i], &v = b.patches[i];
          const double position = std::hypot(u.x - v.x, u.y - v.y);
          const auto &e = u.extent.box, &f = v.extent.box;
          const double extent = std::max({std::abs(e.x_min - f.x_min), std::abs(e.x_max - f.x_max),
                                          std::abs(e.y_min - f.y_min), std::abs(e.y_max - f.y_max)});
          // The locus takes the wheel along x as a circle with a cubic part: less exact on a yawed flange at 70
          // degrees.
          const bool steep = std::abs(u.inclination) > 0.9;
          EXPECT_LT(position, steep ? 2e-5 : 1e-5) << where;
          EXPECT_LT(extent, steep ? 3e-4 : 5e-5) << where;
          EXPECT_NEAR(u.inclination, v.inclination, steep ? 5e-4 : 2e-4) << where;
          EXPECT_NEAR(u.least_gap, v.least_gap, 1e-7) << where;
          EXPECT_NEAR(u.weight, v.weight, (steep ? 4e-2 : 5e-3) * v.weight) << where;
        }
      }
  EXPECT_GT(two_patches, 0);
}

INSTANTIATE_TEST_SUITE_P(Backends, Locus, ::testing::Values("analytic", "spline"),
                         [](const auto& backend) { return std::string(backend.param); });

TEST(LocusMethod, IsForConstantProfilesAlongTheTrackOnly) {
  const Profiles p = profiles("analytic");
  auto pair = placed(p, 0.0, 0.0, 0.0, 0.0);
  SearchSettings s = fine_grid();
  EXPECT_EQ(ContactSearch(pair, s).method(), SearchMethod::locus);
  pair.X_TR.rotation = rotation_z(0.01);
  EXPECT_EQ(ContactSearch(pair, s).method(), SearchMethod::pruned_grid);
  s.method = SearchMethod::locus;
  EXPECT_THROW(ContactSearch(pair, s), Error);

  const Bodies damaged = bodies_in("analytic");
  pair.X_TR.rotation = Mat3::Identity();
  pair.wheel = damaged.wheels[0].get();
  EXPECT_THROW(ContactSearch(pair, s), Error);
}

/// A turn of a wheel with two flats of 60 mm, over a rail with a squat: where neither is near, profiles decide, with
/// the patches that the grid finds; where one is, the grid.
TEST(LocusMethod, IsUsedBesideDefects) {
  WheelFlat flat;
  flat.length = 0.06, flat.depth = 1e-3;
  WheelFlat other = flat;
  other.theta_center = 1.0;
  Squat squat;
  squat.x_center = 0.5, squat.length = 0.04, squat.width = 0.03, squat.depth = 2e-4;
  SurfaceSpec rail{Body::rail, 0.0, StandardProfile{"60E1"}, {}},
      wheel{Body::wheel, kRailRadius, StandardProfile{"S1002"}, {}};
  rail.defects.squats = {squat}, wheel.defects.flats = {flat, other};
  const Profiles p{create_surface(rail, "analytic"), create_surface(wheel, "analytic")};
  const auto profile = detection::whole_profile(*p.wheel);
  ASSERT_NE(profile, nullptr);
  EXPECT_NE(profile->angle, 0.0);
  int on_locus = 0, on_grid = 0;
  for (const double from : {0.0, 0.5})
    for (double pitch = -3.1; pitch < 3.1; pitch += 0.1) {
      auto pair = placed(p, 1e-3, 0.001, 0.004, pitch);
      pair.X_TR.origin.x() = -from;
      pair.wheel_profile = profile;
      SearchSettings s = fine_grid();
      ContactSearch found(pair, s);
      const bool locus = found.method() == SearchMethod::locus;
      // The grid reaches 90 mm to both sides of the axle (0.21 rad), a flat 30 mm from its middle (0.07 rad); they are
      // down at the pitches 0 and -1.
      EXPECT_EQ(locus, from == 0.0 && std::min(std::abs(pitch), std::abs(pitch + 1.0)) > 0.29) << pitch;
      (locus ? on_locus : on_grid) += 1;
      if (!locus) continue;
      s.method = SearchMethod::pruned_grid;
      ContactSearch grid(pair, s);
      const double depth = grid.at(grid.least_gap()).least_gap + grid.least_gap() + 1e-4;
      const auto a = found.at(depth), b = grid.at(depth);
      ASSERT_EQ(a.patches.size(), 1U);
      ASSERT_EQ(b.patches.size(), 1U);
      const auto &u = a.patches[0], &v = b.patches[0];
      EXPECT_LT(std::hypot(u.x - v.x, u.y - v.y), 1e-5);
      EXPECT_NEAR(u.inclination, v.inclination, 2e-4);
      EXPECT_NEAR(u.least_gap, v.least_gap, 1e-7);
      EXPECT_NEAR(u.weight, v.weight, 5e-3 * v.weight);
    }
  EXPECT_GT(on_locus, 40);
  EXPECT_GT(on_grid, 60);
}

TEST(LocusMethod, KeepsTheGapWithoutContactAndIsNaNBesideTheRail) {
  const Profiles p = profiles("analytic");
  SearchSettings s = fine_grid();
  ContactSearch apart(placed(p, 0.0, 0.0, 0.0, 0.0), s);
  const double least = apart.least_gap();
  EXPECT_TRUE(apart.at(least - 1e-4).patches.empty());
  EXPECT_NEAR(apart.at(least - 1e-4).least_gap, 1e-4, 1e-9);
  ContactSearch beside(placed(p, 0.5, 0.0, 0.0, 0.0), s);
  EXPECT_TRUE(std::isnan(beside.least_gap()));
  EXPECT_TRUE(beside.at(0.0).patches.empty());
}

}  // namespace
}  // namespace treadmark::testing
