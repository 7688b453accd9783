// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <random>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/displacement/base_heights.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/backends/displacement/natural_point.hpp"
#include "treadmark/backends/displacement/natural_row.hpp"
#include "treadmark/tests/backends/displacement/fields.hpp"

namespace treadmark::testing {
namespace {

using displacement::BaseHeights;
using displacement::make_displaced_surface;

constexpr double kGridR = 0.46;

std::shared_ptr<const Surface> s1002() { return analytic::make_standard_surface({"S1002"}, Body::wheel, kGridR); }
std::shared_ptr<const Surface> rail_60e1() { return analytic::make_standard_surface({"60E1"}, Body::rail, 0.0); }

/// Grids are solved in bands, lists point by point: two ways to the same lines.
void expect_grid_is_list(const Surface& surface, const Pose& X, const Grid2& g, int& hits) {
  const Fields f = evaluate(surface, X, g);
  std::vector<double> alone(g.size()), z(g.size()), zx(g.size()), zy(g.size());
  surface.heights({X, g}, {alone, {}, {}});
  std::vector<Vec2> points;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) points.push_back({g.x(ix), g.y(iy)});
  surface.heights_at(X, points, {z, zx, zy});
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double steep = 1.0 + zx[i] * zx[i] + zy[i] * zy[i];
    ASSERT_TRUE(same(f.z[i], z[i], 1e-12 * steep)) << f.z[i] << " and " << z[i] << " at " << points[i].transpose();
    ASSERT_TRUE(same(alone[i], f.z[i], 1e-13 * steep))
        << alone[i] << " and " << f.z[i] << " at " << points[i].transpose();
    // both ways stop within 2e-10 m of the hit sideways, where damage and profile bend by up to 100/m; seen obliquely,
    // more
    ASSERT_TRUE(same(f.dzdx[i], zx[i], 1e-6 * steep * steep)) << f.dzdx[i] << " and " << zx[i];
    ASSERT_TRUE(same(f.dzdy[i], zy[i], 1e-6 * steep * steep)) << f.dzdy[i] << " and " << zy[i];
    hits += !std::isnan(z[i]);
  }
}

TEST(DisplacedGrid, EqualsListsOfPointsForAllSteps) {
  const auto wheel = make_displaced_surface(
      s1002(), std::make_shared<BumpField>(-0.8e-3, 0.01, 0.004, 0.06 / kGridR, 0.05, true), Body::wheel, "x");
  const auto rail = make_displaced_surface(
      rail_60e1(), std::make_shared<BumpField>(0.7e-3, 0.002, 0.005, 0.05, 0.03, false), Body::rail, "x");
  int hits = 0;
  for (const bool is_wheel : {true, false})
    for (const Pose& X : is_wheel ? wheel_planes(kGridR) : rail_planes())
      for (const double step : {0.11e-3, 0.53e-3, 1.9e-3, 3.1e-3})
        for (const int nx : {1, 19}) {
          const int ny = 23;
          expect_grid_is_list(is_wheel ? *wheel : *rail, X,
                              {-0.5 * step * nx + 1e-4, -0.5 * step * ny, step, 0.9 * step, nx, ny}, hits);
          if (HasFatalFailure())
            FAIL() << "plane from " << X.origin.transpose() << " step " << step << (is_wheel ? " wheel" : " rail");
        }
  EXPECT_GT(hits, 20000);
}

TEST(DisplacedGrid, WidthsAcrossTheRimMatchLists) {
  // the whole profile with both rims and the back of the flange, seen straight and askew
  const auto wheel = make_displaced_surface(s1002(), std::make_shared<ConstantField>(-0.3e-3), Body::wheel, "x");
  int hits = 0;
  for (const auto& [roll, yaw] : {std::pair{0.0, 0.0}, {0.03, 0.0}, {-0.06, 0.01}}) {
    expect_grid_is_list(*wheel, pose({0.0, 0.0, kGridR}, roll, yaw, 0.0), {-0.0101, -0.0751, 0.0013, 0.0011, 17, 133},
                        hits);
    if (HasFatalFailure()) FAIL() << roll;
  }
  EXPECT_GT(hits, 3000);
}

TEST(DisplacedGrid, BaseHeightsKnowJumpsAndMisses) {
  // seen across the flange, the tread hides behind it
  const Pose X = pose({0.0, -0.045, kGridR + 0.02}, 0.9, 0.0, 0.0);
  const Grid2 g{-0.01, -0.04, 0.5e-3, 0.5e-3, 21, 161};
  std::vector<double> z(g.size());
  const BaseHeights base(*s1002(), {X, g}, {z, {}, {}});
  int jumps = 0, smooth = 0;
  for (int iy = 1; iy + 1 < g.ny; ++iy)
    for (int ix = 1; ix + 1 < g.nx; ++ix) {
      const double here = base.row(iy)[ix], next = base.row(iy + 1)[ix];
      const bool jumps_here = std::isnan(here) || std::isnan(next) || std::fabs(next - here) > 3e-3;
      jumps += jumps_here;
      smooth += (base.smooth(ix, iy) & BaseHeights::kAround) != 0;
      if (jumps_here) {
        EXPECT_EQ(base.smooth(ix, iy) & (BaseHeights::kAlongY | BaseHeights::kAround), 0) << ix << ' ' << iy;
      }
    }
  EXPECT_GT(jumps, 10);
  EXPECT_GT(smooth, 500);
}

TEST(DisplacedGrid, RowsOfNaturalCoordinatesEqualSinglePoints) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double width : {0.02, 0.3, 2.0}) {  // up to lines that pass the wheel
    const Pose X = pose({0.1, 0.02, kGridR - 0.05}, 0.2, 0.1, 0.3);
    displacement::NaturalRow row(Body::wheel, X);
    constexpr std::size_t kPoints = 101;
    row.resize(kPoints);
    row.look_near(X.apply({0.0, 0.01, 0.0}));
    std::vector<double> x(kPoints), t(kPoints);
    for (std::size_t i = 0; i < kPoints; ++i) x[i] = width * unit(random), t[i] = 0.1 * unit(random);
    row.find(0.01, x.data(), t.data(), kPoints);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const displacement::NaturalPoint q(Body::wheel, X.apply({x[i], 0.01, t[i]}));
      EXPECT_NEAR(std::remainder(row.u[i] - q.u(), 2.0 * std::numbers::pi), 0.0, 2e-15);
      EXPECT_NEAR(row.y[i], q.y, 1e-15);
      EXPECT_NEAR(row.sin[i], q.e.x(), 1e-15);
      EXPECT_NEAR(row.cos[i], q.e.z(), 1e-15);
      EXPECT_NEAR(row.per_r[i] * q.r, 1.0, 1e-14);
    }
  }
}

}  // namespace
}  // namespace treadmark::testing
