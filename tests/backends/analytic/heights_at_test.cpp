// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/tests/backends/spline/test_planes.hpp"

namespace treadmark::analytic {
namespace {

using treadmark::testing::expect_heights_at_gives_heights;

TEST(HeightsAt, RailsGiveTheHeightsOfGrids) {
  EXPECT_GT(expect_heights_at_gives_heights(*make_prismatic_surface(cylinder_chain(0.3, 1.2)),
                                            treadmark::testing::rail_planes()),
            3000);
  EXPECT_GT(expect_heights_at_gives_heights(*make_standard_surface({"60E1"}, Body::rail, 0.0),
                                            treadmark::testing::rail_planes()),
            3000);
}

TEST(HeightsAt, WheelsGiveTheHeightsOfGrids) {
  WheelFlat flat;
  flat.length = 0.06;
  flat.depth = 0.8e-3;
  const auto planes = treadmark::testing::wheel_planes(0.46);
  EXPECT_GT(expect_heights_at_gives_heights(*make_standard_surface({"S1002"}, Body::wheel, 0.46), planes), 3000);
  EXPECT_GT(expect_heights_at_gives_heights(*make_standard_surface({"S1002"}, Body::wheel, 0.46, {flat}), planes),
            3000);
  EXPECT_GT(expect_heights_at_gives_heights(*make_revolved_surface(barrel_chain(0.05, 0.8), 0.46), planes), 3000);
}

TEST(HeightsAt, PlanesGiveTheHeightsOfGrids) {
  EXPECT_GT(expect_heights_at_gives_heights(*make_plane_surface(Facing::up), treadmark::testing::rail_planes()), 3000);
}

TEST(HeightsAt, APlaneThatLooksAlongTheRailSeesNothing) {
  const Pose along{{0.0, 0.0, 0.0}, rotation_y(std::acos(-1.0) / 2)};
  const std::vector<Vec2> points{{0.0, 0.0}, {0.01, 0.02}};
  treadmark::testing::Fields f(points.size());
  make_prismatic_surface(cylinder_chain(0.3, 1.2))->heights_at(along, points, f.out());
  for (const auto* values : {&f.z, &f.dzdx, &f.dzdy})
    for (const double value : *values) EXPECT_TRUE(std::isnan(value));
}

}  // namespace
}  // namespace treadmark::analytic
