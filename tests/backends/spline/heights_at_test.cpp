// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/backends/spline/test_planes.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using testing::kRadius;
using treadmark::testing::expect_heights_at_gives_heights;
using treadmark::testing::Fields;

TEST(HeightsAt, ProfilesGiveTheHeightsOfGrids) {
  EXPECT_GT(expect_heights_at_gives_heights(*make_profile_surface(testing::rail_head(), 0.0),
                                            treadmark::testing::rail_planes()),
            3000);
  EXPECT_GT(expect_heights_at_gives_heights(*make_profile_surface(testing::flanged_wheel(), kRadius),
                                            treadmark::testing::wheel_planes(kRadius)),
            3000);
}

TEST(HeightsAt, SlicesGiveTheHeightsOfGrids) {
  EXPECT_GT(expect_heights_at_gives_heights(*make_slice_surface(testing::bending_rail(), 0.0),
                                            treadmark::testing::rail_planes()),
            3000);
  EXPECT_GT(expect_heights_at_gives_heights(*make_slice_surface(testing::dented_wheel(1e-3, 0.02), kRadius),
                                            treadmark::testing::wheel_planes(kRadius)),
            3000);
}

TEST(HeightsAt, PointsFarApartDoNotDisturbEachOther) {
  // every height of one list must be that of the point alone, however far its neighbours are
  constexpr double kRounding = 1e-12;
  const Pose X{{0.0, 0.0, 0.0}, rotation({0.03, 0.02, 0.5})};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(-0.44, 0.44), y(-0.06, 0.05);
  std::vector<Vec2> points;
  for (int i = 0; i < 300; ++i) points.push_back({x(random), y(random)});
  for (const auto& wheel : {make_profile_surface(testing::flanged_wheel(), kRadius),
                            make_slice_surface(testing::dented_wheel(), kRadius)}) {
    Fields all(points.size());
    wheel->heights_at(X, points, all.out());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double alone = height_at(*wheel, X, points[i]);
      ASSERT_EQ(std::isnan(alone), std::isnan(all.z[i])) << points[i].transpose();
      if (!std::isnan(alone)) {
        ASSERT_NEAR(all.z[i], alone, kRounding * (1.0 + std::hypot(all.dzdx[i], all.dzdy[i]))) << points[i].transpose();
      }
    }
  }
}

TEST(HeightsAt, ThreadsChangeNothing) {
  std::vector<Vec2> points;
  for (int i = 0; i < 5000; ++i) points.push_back({0.02 * std::sin(0.01 * i), 0.03 * std::cos(0.0037 * i)});
  const Pose X{{0.0, 0.0, kRadius}, rotation({0.1, 0.2, 0.0})};
  for (const auto& wheel : {make_profile_surface(testing::flanged_wheel(), kRadius),
                            make_slice_surface(testing::dented_wheel(), kRadius)}) {
    Fields one(points.size()), many(points.size());
    {
      const ThreadLimit limit(1);
      wheel->heights_at(X, points, one.out());
    }
    const ThreadLimit limit(4);
    wheel->heights_at(X, points, many.out());
    EXPECT_EQ(one.z, many.z);
    EXPECT_EQ(one.dzdx, many.dzdx);
    EXPECT_EQ(one.dzdy, many.dzdy);
  }
}

}  // namespace
}  // namespace treadmark::spline
