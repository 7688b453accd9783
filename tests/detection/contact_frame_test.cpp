// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/backends/analytic/make.hpp"

namespace treadmark::detection {
namespace {

/// The grid over a rectangle on a level plane, where arc lengths are y.
Grid2 grid_over(const Rectangle& box, double dx, double ds, int most) {
  const auto plane = analytic::make_plane_surface(Facing::up);
  const auto ball = analytic::make_revolved_surface(analytic::barrel_chain(0.4, 1.3), 0.4);
  BodyPair bodies;
  bodies.rail = plane.get();
  bodies.wheel = ball.get();
  ContactPatch patch;
  patch.extent.box = box;
  return potential_contact_grid(bodies, patch, contact_frame(bodies, patch), {dx, ds, most});
}

/// Whole elements that cover a length from the origin's whole multiples, and one more at both ends.
int covering(double low, double high, double step) {
  return static_cast<int>(std::ceil(high / step) + 1.0 - (std::floor(low / step) - 1.0) + 1.0);
}

TEST(PotentialContactGrid, DoublesBothStepsInTurnWhenElementsAreTooMany) {
  const Rectangle box{-5.03e-3, 5.03e-3, -2.03e-3, 2.03e-3};
  constexpr double kStep = 0.2e-3;
  const struct {
    int most;
    double along, across;  // how often the step
  } cases[] = {{20000, 1, 1}, {1400, 1, 1}, {1300, 2, 1}, {700, 2, 2},
               {400, 4, 2},   {300, 4, 2},  {190, 4, 4},  {0, 1, 1}};
  for (const auto& c : cases) {
    const Grid2 grid = grid_over(box, kStep, kStep, c.most);
    EXPECT_DOUBLE_EQ(grid.dx, c.along * kStep) << c.most;
    EXPECT_DOUBLE_EQ(grid.dy, c.across * kStep) << c.most;
    EXPECT_EQ(grid.nx, covering(box.x_min, box.x_max, grid.dx)) << c.most;
    EXPECT_EQ(grid.ny, covering(box.y_min, box.y_max, grid.dy)) << c.most;
    EXPECT_NEAR(std::remainder(grid.x0, grid.dx), 0.0, 1e-15);
    EXPECT_NEAR(std::remainder(grid.y0, grid.dy), 0.0, 1e-15);
    if (c.most > 0) {
      EXPECT_LT(grid.nx * grid.ny, c.most);
    }
  }
}

/// Ten elements are left in each direction: then the other one is doubled alone, and at last neither.
TEST(PotentialContactGrid, LeavesTenElementsInEachDirection) {
  constexpr double kStep = 0.2e-3;
  const Grid2 narrow = grid_over({-5.03e-3, 5.03e-3, -0.5e-3, 0.5e-3}, kStep, kStep, 200);
  EXPECT_DOUBLE_EQ(narrow.dx, 4.0 * kStep);
  EXPECT_DOUBLE_EQ(narrow.dy, kStep);
  const Grid2 thin = grid_over({-0.5e-3, 0.5e-3, -5.03e-3, 5.03e-3}, kStep, kStep, 200);
  EXPECT_DOUBLE_EQ(thin.dx, kStep);
  EXPECT_DOUBLE_EQ(thin.dy, 4.0 * kStep);
  const Grid2 small = grid_over({-0.5e-3, 0.5e-3, -0.5e-3, 0.5e-3}, kStep, kStep, 10);
  EXPECT_DOUBLE_EQ(small.dx, kStep);
  EXPECT_DOUBLE_EQ(small.dy, kStep);
}

}  // namespace
}  // namespace treadmark::detection
