// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/assembly/limited_surface.hpp"
#include "treadmark/backends/assembly/placed_surface.hpp"
#include "treadmark/backends/assembly/renamed_surface.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::assembly {
namespace {

/// The last parameter, against heights of the surfaces with it changed.
void expect_one_parameter(const Surface& surface, HeightsBy how) {
  constexpr double kAmount = 1e-3, kSame = 1e-9;  // of offsets of a tenth of a millimetre
  const PlaneGrid plane{Pose{}, {-20e-3, -10e-3, 5e-3, 5e-3, 9, 5}};
  const std::vector<ShapeParameter> all = surface.parameters();
  ASSERT_EQ(surface.parameter_count(), all.size());
  const std::size_t last = all.size() - 1;  // behind those of the base
  EXPECT_EQ(all[last].name, "shape_0");
  std::vector<double> by(plane.grid.size()), more(by.size()), less(by.size());
  EXPECT_EQ(surface.heights_by(last, plane, by), how);
  surface.changed(last, kAmount)->heights(plane, {more, {}, {}});
  surface.changed(last, -kAmount)->heights(plane, {less, {}, {}});
  double largest = 0.0;
  for (std::size_t i = 0; i < by.size(); ++i) {
    EXPECT_NEAR(by[i], (more[i] - less[i]) / (2.0 * kAmount), kSame) << i;
    largest = std::max(largest, std::abs(by[i]));
  }
  EXPECT_GT(largest, 5e-5);
  EXPECT_THROW(surface.changed(all.size(), kAmount), Error);
  // backwards: the same of all points together
  std::vector<Vec2> points;
  for (int iy = 0; iy < plane.grid.ny; ++iy)
    for (int ix = 0; ix < plane.grid.nx; ++ix) points.emplace_back(plane.grid.x(ix), plane.grid.y(iy));
  std::vector<double> sums(all.size(), 0.0);
  surface.pull_back(plane.X_SP, points, std::vector<double>(points.size(), 1.0), sums);
  EXPECT_NEAR(sums[last], std::accumulate(by.begin(), by.end(), 0.0), kSame * static_cast<double>(by.size()));
}

TEST(ShapeParameters, StayWhereASurfaceIsNamedAnewCutOrMoved) {
  Defects squat;
  squat.squats = {{.length = 50e-3, .width = 30e-3, .depth = 0.1e-3}};
  const std::shared_ptr<const Surface> rail = analytic::add_defects(
      analytic::make_prismatic_surface(analytic::cylinder_chain(0.04, 0.7)), squat, Body::rail, 0.0);
  expect_one_parameter(*rail, HeightsBy::exact);
  expect_one_parameter(*rename_surface(rail, "other"), HeightsBy::exact);
  expect_one_parameter(*place_surface(rail, {{2e-3, 1e-3, 5e-3}, rotation_z(0.1)}), HeightsBy::exact);
  expect_one_parameter(*limit_along(rail, -1.0, 1.0), HeightsBy::differences);
}

TEST(ShapeParameters, StayOfAWheelThatIsTurnedOver) {
  constexpr double kRadius = 0.46;
  Defects waves;
  waves.polygonizations = {{.harmonics = {{.order = 3, .amplitude = 0.1e-3}}}};
  expect_one_parameter(
      *turn_over(analytic::add_defects(analytic::make_revolved_surface(analytic::straight_chain(0.04), kRadius), waves,
                                       Body::wheel, kRadius),
                 kRadius),
      HeightsBy::differences);
}

/// Two fields over each other name both of theirs.
TEST(ShapeParameters, AreOfDifferentNames) {
  Defects squat;
  squat.squats = {{.length = 50e-3, .width = 30e-3, .depth = 0.1e-3}};
  const auto once = analytic::add_defects(analytic::make_prismatic_surface(analytic::cylinder_chain(0.04, 0.7)), squat,
                                          Body::rail, 0.0);
  const std::vector<ShapeParameter> all = analytic::add_defects(once, squat, Body::rail, 0.0)->parameters();
  ASSERT_EQ(all.size(), 4u) << "curvature and length of the arc before them";
  EXPECT_EQ(all[2].name, "shape_0");
  EXPECT_NE(all[3].name, all[2].name);
}

}  // namespace
}  // namespace treadmark::assembly
