// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/interpenetration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace treadmark::detection {
namespace {

GapField field_of(const Grid2& grid, const std::function<double(double, double)>& gap) {
  GapField f(grid);
  GapField::Tile& all = f.add_tile(0, 0);
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      all.gap[i] = gap(grid.x(ix), grid.y(iy));
      all.rail_z[i] = 0.1 * grid.y(iy);
      all.rail_slope[i] = 0.1;
    }
  all.close();
  return f;
}

const Grid2 kGrid{-0.01, -0.01, 2e-4, 2.5e-4, 101, 81};

TEST(Interpenetration, OneParaboloidGivesItsCentreAndBox) {
  const double x0 = 1.3e-3, y0 = -2.1e-3, depth = 1e-4, a = 4.0, b = 9.0;
  const auto regions = find_regions(
      field_of(kGrid, [&](double x, double y) { return a * (x - x0) * (x - x0) + b * (y - y0) * (y - y0) - depth; }),
      0.0, PenetrationWeight::squared, 0.0);
  ASSERT_EQ(regions.size(), 1u);
  const Region& r = regions.front();
  // The weight vanishes with its slope at the rim, so that the sums converge fast.
  EXPECT_NEAR(r.x, x0, 2e-6);
  EXPECT_NEAR(r.y, y0, 2e-6);
  EXPECT_NEAR(r.z, 0.1 * y0, 1e-6);
  EXPECT_NEAR(r.inclination, std::atan(0.1), 1e-12);
  // Integral of (depth - a x^2 - b y^2)^2 over the ellipse is pi depth^3 / (3 sqrt(a b)).
  EXPECT_NEAR(r.weight, M_PI * std::pow(depth, 3) / (3.0 * std::sqrt(a * b)), 1e-3 * r.weight);
  EXPECT_NEAR(kGrid.x(r.ix_max), x0 + std::sqrt(depth / a), 2.0 * kGrid.dx);
  EXPECT_NEAR(kGrid.y(r.iy_min), y0 - std::sqrt(depth / b), 2.0 * kGrid.dy);
}

TEST(Interpenetration, LinearWeightHasItsOwnIntegral) {
  const double depth = 1e-4, a = 4.0, b = 9.0;
  const auto regions = find_regions(field_of(kGrid, [&](double x, double y) { return a * x * x + b * y * y - depth; }),
                                    0.0, PenetrationWeight::linear, 0.0);
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_NEAR(regions[0].weight, M_PI * depth * depth / (2.0 * std::sqrt(a * b)), 3e-3 * regions[0].weight);
}

TEST(Interpenetration, SeparateRegionsAreFoundDeepestFirstAndNearMissesLast) {
  const auto bump = [](double x, double y, double x0, double y0, double depth) {
    return 5.0 * ((x - x0) * (x - x0) + (y - y0) * (y - y0)) - depth;
  };
  const auto regions =
      find_regions(field_of(kGrid,
                            [&](double x, double y) {
                              return std::min({bump(x, y, -5e-3, -4e-3, 2e-5), bump(x, y, 4e-3, 5e-3, 6e-5),
                                               bump(x, y, 5e-3, -6e-3, -1e-5)});
                            }),
                   0.0, PenetrationWeight::squared, 2e-5);
  ASSERT_EQ(regions.size(), 3u);
  EXPECT_NEAR(regions[0].x, 4e-3, 1e-5);
  EXPECT_NEAR(regions[1].x, -5e-3, 1e-5);
  EXPECT_TRUE(regions[2].near_miss());
  EXPECT_NEAR(regions[2].x, 5e-3, 1e-4);
}

TEST(Interpenetration, NothingTouchesWithoutPenetrationOrOverMissingSurface) {
  EXPECT_TRUE(
      find_regions(field_of(kGrid, [](double x, double) { return 1e-6 + x * x; }), 0.0, PenetrationWeight::squared, 0.0)
          .empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(find_regions(field_of(kGrid, [nan](double, double) { return nan; }), 0.0, PenetrationWeight::squared, 0.0)
                  .empty());
}

TEST(Interpenetration, PlateauGivesOneRegion) {
  const auto regions =
      find_regions(field_of(kGrid, [](double x, double y) { return std::max(-1e-5, std::hypot(x, y) * 0.02 - 4e-5); }),
                   0.0, PenetrationWeight::squared, 0.0);
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_NEAR(regions[0].x, 0.0, 1e-5);
}

// Oracle: every negative point must lie in exactly the boxes that flood filling with diagonals would give or in larger
// ones, and none may be lost.
TEST(Interpenetration, RandomFieldsLoseNoPenetratingPoint) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Grid2 grid{0.0, 0.0, 1.0, 1.0, 40, 30};
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> cx, cy, depth;
    for (int k = 0; k < 5; ++k) {
      cx.push_back(20.0 + 10.0 * normal(random));
      cy.push_back(15.0 + 8.0 * normal(random));
      depth.push_back(2.0 + normal(random));
    }
    const GapField f = field_of(grid, [&](double x, double y) {
      double gap = 1e9;
      for (std::size_t k = 0; k < cx.size(); ++k)
        gap = std::min(gap, 0.3 * std::hypot(x - cx[k], 1.4 * (y - cy[k])) - depth[k]);
      return gap;
    });
    const auto regions = find_regions(f, 0.0, PenetrationWeight::squared, 0.0);
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix) {
        if (!(f.gap(ix, iy) < 0.0)) continue;
        bool covered = false;
        for (const Region& r : regions)
          covered = covered || (ix >= r.ix_min && ix <= r.ix_max && iy >= r.iy_min && iy <= r.iy_max);
        ASSERT_TRUE(covered) << "trial " << trial << " at " << ix << ", " << iy;
      }
  }
}

}  // namespace
}  // namespace treadmark::detection
