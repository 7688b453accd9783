// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/tests/backends/analytic/milled_rails.hpp"

namespace treadmark::testing {
namespace {

class MilledSurface : public ::testing::TestWithParam<bool> {
 protected:
  MilledRail rail_{GetParam()};
  std::shared_ptr<const Surface> base_ = analytic::make_prismatic_surface(MilledRail::rail());
  std::shared_ptr<const Surface> surface_ =
      analytic::add_defects(base_, {.milling_paths = {rail_.path()}}, Body::rail, 0.0);
  Grid2 grid_{-0.0621, -0.0293, 0.00431, 0.00193, 31, 31};

  struct Fields {
    std::vector<double> z, dzdx, dzdy;
  };
  Fields evaluate(const Pose& X, const Grid2& g) const {
    Fields f{std::vector<double>(g.size()), std::vector<double>(g.size()), std::vector<double>(g.size())};
    surface_->heights({X, g}, {f.z, f.dzdx, f.dzdy});
    return f;
  }
};
INSTANTIATE_TEST_SUITE_P(Paths, MilledSurface, ::testing::Values(false, true),
                         [](const auto& which) { return which.param ? "curved" : "straight"; });

TEST_P(MilledSurface, IsTheBaseLessTheSweptCutter) {
  // bisection of the brute force and Newton here are both good to rounding, divided by the slant
  constexpr double kTolerance = 2e-13, kGrazing = 0.1;
  const Outside outside = rail_.outside();
  int compared = 0, milled = 0, slopes_wrong = 0, slivers = 0;
  for (const Pose& X : rail_.planes()) {
    const Fields f = evaluate(X, grid_);
    for (int iy = 0; iy < grid_.ny; ++iy)
      for (int ix = 0; ix < grid_.nx; ++ix) {
        const std::size_t i = grid_.index(ix, iy);
        const Vec2 p(grid_.x(ix), grid_.y(iy));
        const Crossing hit = first_crossing(outside, X, p.x(), p.y(), false, 0.08, 1e-4);
        if (std::isnan(hit.z) || hit.slant < kGrazing) continue;
        const double on_base = height_at(*base_, X, p);
        if (std::isnan(on_base)) continue;
        ++compared;
        if (f.z[i] < hit.z - kTolerance / hit.slant) {
          // slivers next to an edge may be thinner than the steps of the brute force
          constexpr double kThin = 1e-9;
          ASSERT_GT(outside(X.apply({p.x(), p.y(), f.z[i] - kThin})), 0.0) << p.transpose();
          ASSERT_LT(outside(X.apply({p.x(), p.y(), f.z[i] + kThin})), 0.0) << p.transpose();
          ++slivers;
          continue;
        }
        ASSERT_NEAR(f.z[i], hit.z, kTolerance / hit.slant) << p.transpose() << " base " << on_base;
        if (f.z[i] > on_base) ++milled;
        const Vec3 normal = (X.rotation * Vec3(-f.dzdx[i], -f.dzdy[i], 1.0)).normalized();
        if (normal.cross(hit.gradient.normalized()).norm() > 1e-6) ++slopes_wrong;
      }
  }
  EXPECT_GT(compared, 2500);
  EXPECT_GT(milled, 800);
  EXPECT_LE(slivers, compared / 1000);
  EXPECT_LE(slopes_wrong, compared / 200) << "differences of the formula go wrong at edges only";
}

TEST_P(MilledSurface, ScatteredPointsTilesAndThreadsAgree) {
  const Grid2 g{-0.0621, -0.0293, 0.00101, 0.00053, 130, 111};
  for (const Pose& X : rail_.planes()) {
    const Fields whole = evaluate(X, g);
    {
      ThreadLimit limit(1);
      const Fields one = evaluate(X, g);
      for (std::size_t i = 0; i < g.size(); ++i) ASSERT_TRUE(one.z[i] == whole.z[i] || std::isnan(one.z[i]));
    }
    std::vector<Vec2> points;
    for (int iy = 0; iy < g.ny; iy += 7)
      for (int ix = 0; ix < g.nx; ix += 3) points.push_back({g.x(ix), g.y(iy)});
    std::vector<double> z(points.size()), dzdx(points.size());
    surface_->heights_at(X, points, {z, dzdx, {}});
    std::vector<SurfacePoint> located(points.size());
    surface_->locate(X, points, located);
    std::size_t k = 0;
    for (int iy = 0; iy < g.ny; iy += 7)
      for (int ix = 0; ix < g.nx; ix += 3, ++k) {
        const std::size_t i = g.index(ix, iy);
        ASSERT_EQ(std::isnan(z[k]), std::isnan(whole.z[i]));
        ASSERT_EQ(std::isnan(z[k]), located[k].status == LocateStatus::outside);
        if (std::isnan(z[k])) continue;
        const double steep = 1.0 + std::pow(std::hypot(whole.dzdx[i], whole.dzdy[i]), 2);
        ASSERT_NEAR(z[k], whole.z[i], 1e-13 * steep);
        ASSERT_NEAR(dzdx[k], whole.dzdx[i], 1e-9 * steep * steep);
        ASSERT_NEAR((located[k].position_S - X.apply({points[k].x(), points[k].y(), z[k]})).norm(), 0.0, 1e-12 * steep);
        const Vec3 normal = (X.rotation * Vec3(whole.dzdx[i], whole.dzdy[i], -1.0)).normalized();
        ASSERT_LE((located[k].normal_S - normal).norm(), 1e-9 * steep * steep);
      }
  }
}

TEST_P(MilledSurface, CurvaturesMatchSecondDifferences) {
  constexpr double kStep = 5e-5;  // [m] noise of 1e-16 m heights in the second difference: 4e-8/m
  int compared = 0, wrong = 0;
  std::vector<Vec2> points;
  for (double x = -0.045; x < 0.05; x += 0.0071)
    for (double y = -0.03; y < 0.03; y += 0.0023) points.push_back({x, y});
  std::vector<SurfacePoint> located(points.size());
  surface_->locate(Pose{}, points, located);
  for (const SurfacePoint& p : located) {
    Pose T;
    T.origin = p.position_S;
    T.rotation.col(2) = -p.normal_S;
    T.rotation.col(1) = T.rotation.col(2).cross(Vec3::UnitX()).normalized();
    T.rotation.col(0) = T.rotation.col(1).cross(T.rotation.col(2));
    const Fields h = evaluate(T, {-kStep, -kStep, kStep, kStep, 3, 3});
    const double hxx = (h.z[3] - 2 * h.z[4] + h.z[5]) / (kStep * kStep),
                 hyy = (h.z[1] - 2 * h.z[4] + h.z[7]) / (kStep * kStep);
    const double hxy = (h.z[8] - h.z[6] - h.z[2] + h.z[0]) / (4 * kStep * kStep);
    if (std::isnan(hxx + hyy + hxy)) continue;
    ++compared;
    const double mean = 0.5 * (hxx + hyy), spread = std::hypot(0.5 * (hxx - hyy), hxy);
    if (std::fabs(mean + spread - p.curvature_1) > 1e-3 || std::fabs(mean - spread - p.curvature_2) > 1e-3) ++wrong;
  }
  EXPECT_GT(compared, 200);
  EXPECT_LE(wrong, compared / 10) << "differences reach across edges";
}

TEST_P(MilledSurface, BoundsHoldHeightsAndAreOfUse) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int small = 0, loose = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const auto planes = rail_.planes();
    Pose X = planes[static_cast<std::size_t>(trial) % planes.size()];
    X.rotation =
        X.rotation * rotation({0.2 * (unit(random) - 0.5), 0.2 * (unit(random) - 0.5), 0.2 * (unit(random) - 0.5)});
    const double width = std::pow(10.0, -4.0 + 2.5 * unit(random)), height = std::pow(10.0, -4.0 + 2.5 * unit(random));
    const double x = 0.13 * (unit(random) - 0.5), y = 0.07 * (unit(random) - 0.5);
    const HeightBounds bounds = surface_->height_bounds(X, {x, x + width, y, y + height});
    const Fields f = evaluate(X, {x, y, width / 11, height / 11, 12, 12});
    double z_min = 1.0, z_max = -1.0;
    for (double z : f.z) {
      if (std::isnan(z)) continue;
      ASSERT_FALSE(bounds.empty);
      ASSERT_GE(z, bounds.z_min - 1e-11) << "trial " << trial;
      ASSERT_LE(z, bounds.z_max + 1e-11) << "trial " << trial;
      z_min = std::min(z_min, z);
      z_max = std::max(z_max, z);
    }
    if (width + height > 2e-3 || !(z_max - z_min < 2.0 * (width + height)) || z_min > z_max) continue;
    ++small;
    if (z_min - bounds.z_min > 3.0 * (width + height) + 1e-4) ++loose;
  }
  EXPECT_GT(small, 20);
  EXPECT_LE(loose, small / 10);
}

TEST(FlattenedHeads, AreCutAsTheFieldSays) {
  const auto base = analytic::make_standard_surface({"60E1"}, Body::rail, 0.0);
  const Defects defects{.flattened_heads = {{-0.1, 0.2, 0.05, 0.5e-3, 0.015}}};
  const auto surface = analytic::add_defects(base, defects, Body::rail, 0.0);
  const auto field = analytic::make_defect_field(defects, Body::rail, 0.0, base);
  int cut = 0;
  for (double x = -0.12; x < 0.22; x += 0.0037)
    for (double y = -0.03; y < 0.03; y += 0.0019) {
      const double offset = field->jet(x, y).value;
      EXPECT_NEAR(height_at(*surface, Pose{}, {x, y}), height_at(*base, Pose{}, {x, y}) + offset, 1e-15)
          << x << ' ' << y;
      if (offset > 0.0) ++cut;
    }
  EXPECT_GT(cut, 300);
  // in the middle the head is a plane, inclined as asked
  const double z1 = height_at(*surface, Pose{}, {0.05, -0.003}), z2 = height_at(*surface, Pose{}, {0.06, 0.004});
  EXPECT_NEAR(z2 - z1, 0.007 * std::tan(0.015), 1e-15);
}

TEST(FlattenedHeads, WithRoundEdgesAreTheSameInEveryView) {
  const auto base = analytic::make_standard_surface({"60E1"}, Body::rail, 0.0);
  const Defects defects{.flattened_heads = {{-0.1, 0.2, 0.05, 0.3e-3, 0.015, 0.02}, {0.1, 0.3, 0.05, 0.5e-3}}};
  const auto surface = analytic::add_defects(base, defects, Body::rail, 0.0);
  const auto round =
      analytic::make_defect_field({.flattened_heads = {defects.flattened_heads[0]}}, Body::rail, 0.0, base);
  int compared = 0;
  for (const double tilt : {0.0, 0.3, -0.5}) {
    const Pose X{{0.0, 0.0, -0.01}, rotation_x(tilt)};
    for (double x = -0.12; x < 0.09; x += 0.0037)  // beyond the second head begins
      for (double y = -0.03; y < 0.03; y += 0.0019) {
        if (std::isnan(height_at(*base, X, {x, y}))) continue;
        ++compared;
        const Vec3 p = X.apply({x, y, height_at(*surface, X, {x, y})});
        const Vec2 foot(p.x(), p.y());
        EXPECT_NEAR(p.z(), height_at(*base, Pose{}, foot) + round->jet(foot.x(), foot.y()).value, 1e-13)
            << x << ' ' << y;
      }
  }
  EXPECT_GT(compared, 3000);
  // Where both are, the deeper one remains.
  const auto deep = analytic::add_defects(base, {.flattened_heads = {defects.flattened_heads[1]}}, Body::rail, 0.0);
  EXPECT_EQ(height_at(*surface, Pose{}, {0.17, 0.0}), height_at(*deep, Pose{}, {0.17, 0.0}));
}

TEST(MilledSurfaces, SeveralCutsRemoveTheirUnion) {
  constexpr double kTolerance = 2e-13, kGrazing = 0.1;
  const MilledRail rail{false}, curved{true};
  const auto base = analytic::make_prismatic_surface(MilledRail::rail());
  const auto surface = analytic::add_defects(base, {.milling_paths = {rail.path(), curved.path()}}, Body::rail, 0.0);
  const auto swapped = analytic::add_defects(base, {.milling_paths = {curved.path(), rail.path()}}, Body::rail, 0.0);
  const Outside outside = [&, one = rail.outside()](const Vec3& p) { return std::max(one(p), curved.removed(p)); };
  int milled = 0;
  for (const Pose& X : rail.planes())
    for (double x = -0.0613; x < 0.06; x += 0.0071)
      for (double y = -0.031; y < 0.03; y += 0.0037) {
        const double z = height_at(*surface, X, {x, y}), on_base = height_at(*base, X, {x, y});
        const Crossing hit = first_crossing(outside, X, x, y, false, 0.08, 1e-4);
        if (std::isnan(on_base) || std::isnan(hit.z) || hit.slant < kGrazing) continue;
        ASSERT_NEAR(z, hit.z, kTolerance / hit.slant) << x << ' ' << y;
        ASSERT_NEAR(z, height_at(*swapped, X, {x, y}), kTolerance / hit.slant);
        if (z > on_base) ++milled;
      }
  EXPECT_GT(milled, 500);
  EXPECT_EQ(analytic::add_defects(base, {}, Body::rail, 0.0), base);
}

}  // namespace
}  // namespace treadmark::testing
