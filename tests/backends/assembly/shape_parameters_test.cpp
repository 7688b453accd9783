// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/assembly/limited_surface.hpp"
#include "treadmark/backends/assembly/placed_surface.hpp"
#include "treadmark/backends/assembly/renamed_surface.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::assembly {
namespace {

/// The one parameter, against heights of the surfaces with it changed.
void expect_one_parameter(const Surface& surface, HeightsBy how) {
  constexpr double kAmount = 1e-3, kSame = 1e-9;  // of offsets of a tenth of a millimetre
  const PlaneGrid plane{Pose{}, {-20e-3, -10e-3, 5e-3, 5e-3, 9, 5}};
  ASSERT_EQ(surface.parameters().size(), 1u);
  EXPECT_EQ(surface.parameters()[0].name, "shape_0");
  std::vector<double> by(plane.grid.size()), more(by.size()), less(by.size());
  EXPECT_EQ(surface.heights_by(0, plane, by), how);
  surface.changed(0, kAmount)->heights(plane, {more, {}, {}});
  surface.changed(0, -kAmount)->heights(plane, {less, {}, {}});
  double largest = 0.0;
  for (std::size_t i = 0; i < by.size(); ++i) {
    EXPECT_NEAR(by[i], (more[i] - less[i]) / (2.0 * kAmount), kSame) << i;
    largest = std::max(largest, std::abs(by[i]));
  }
  EXPECT_GT(largest, 5e-5);
  EXPECT_THROW(surface.changed(1, kAmount), Error);
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
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "shape_0");
  EXPECT_NE(all[1].name, all[0].name);
}

}  // namespace
}  // namespace treadmark::assembly
