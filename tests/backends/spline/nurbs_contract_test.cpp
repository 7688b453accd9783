// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What every surface promises, for NURBS: tiles, threads, rigid motions, bounds, differences, nothing beside the
// surface.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/backends/spline/test_planes.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using testing::kRadius;
using treadmark::testing::Fields;
using treadmark::testing::heights;
using treadmark::testing::odd_grid;

struct ContractSubject {
  std::string name;
  std::shared_ptr<const Surface> surface;
  std::vector<Pose> planes;
  double y_min, y_max;
};

std::shared_ptr<const Surface> dented_flanged_wheel() {
  sampling::PointGrid grid;
  grid.body = Body::wheel;
  grid.closed = true;
  for (int i = 0; i < 360; ++i) grid.u.push_back(-std::numbers::pi + i * std::numbers::pi / 180.0);
  for (int j = 0; j <= 130; ++j) grid.y.push_back(-0.07 + 1e-3 * j);
  for (const double theta : grid.u)
    for (const double y : grid.y) {
      const double a = (theta - 0.02) / 0.12, b = (y - 5e-3) / 25e-3;
      grid.h.push_back(kRadius + testing::flanged_wheel_z(y) - 1e-3 * std::exp(-a * a - b * b));
    }
  return make_nurbs_surface(grid);
}

const std::vector<ContractSubject>& contract_subjects() {
  static const std::vector<ContractSubject> all = [] {
    const ArcChain two_arcs{
        -0.06 * std::sin(0.5), 0.06 * (1.0 - std::cos(0.5)), -0.5, {{0.06 * 0.5, 1.0 / 0.06}, {0.3 * 0.1, 1.0 / 0.3}}};
    return std::vector<ContractSubject>{
        {"two_arc_rail", make_nurbs_surface(two_arcs, Body::rail, 0.0), treadmark::testing::rail_planes(),
         two_arcs.start_y, 0.3 * std::sin(0.1)},
        {"barrel_wheel", make_nurbs_surface(analytic::barrel_chain(0.05, 0.8), Body::wheel, 0.3),
         treadmark::testing::wheel_planes(0.3), -0.05 * std::sin(0.8), 0.05 * std::sin(0.8)},
        {"dented_wheel", dented_flanged_wheel(), treadmark::testing::wheel_planes(kRadius), -0.07, 0.06}};
  }();
  return all;
}

bool same(double a, double b, double tolerance) {
  return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= tolerance;
}

TEST(NurbsContract, TilesGiveTheWholeGridForAnyThreads) {
  const Grid2 g{-0.0197, -0.0293, 0.00031, 0.00047, 130, 125};
  for (const ContractSubject& s : contract_subjects())
    for (const Pose& X : s.planes) {
      Fields one(g.size()), many(g.size());
      {
        const ThreadLimit limit(1);
        s.surface->heights({X, g}, one.out());
      }
      const ThreadLimit limit(4);
      s.surface->heights({X, g}, many.out());
      for (std::size_t i = 0; i < g.size(); ++i)
        ASSERT_TRUE(same(one.z[i], many.z[i], 0.0) && same(one.dzdx[i], many.dzdx[i], 0.0) &&
                    same(one.dzdy[i], many.dzdy[i], 0.0))
            << s.name;
      const int half_x = g.nx / 2, half_y = g.ny / 3;
      for (int part = 0; part < 4; ++part) {
        const int bx = part % 2 ? half_x : 0, by = part / 2 ? half_y : 0;
        const Grid2 tile{
            g.x(bx), g.y(by), g.dx, g.dy, part % 2 ? g.nx - half_x : half_x, part / 2 ? g.ny - half_y : half_y};
        const Fields f = heights(*s.surface, X, tile);
        for (int iy = 0; iy < tile.ny; ++iy)
          for (int ix = 0; ix < tile.nx; ++ix) {
            const std::size_t k = tile.index(ix, iy);
            const double steep = 1.0 + std::hypot(f.dzdx[k], f.dzdy[k]);
            ASSERT_TRUE(same(one.z[g.index(bx + ix, by + iy)], f.z[k], 1e-12 * steep)) << s.name;
          }
      }
    }
}

TEST(NurbsContract, MovingEverythingChangesNothing) {
  const Grid2 g = odd_grid();
  const Pose X_WS{{3.1, -0.7, 0.4}, rotation({0.3, -0.8, 1.9})};
  for (const ContractSubject& s : contract_subjects())
    for (const Pose& X_SP : s.planes) {
      const Fields before = heights(*s.surface, X_SP, g);
      const Fields after = heights(*s.surface, X_WS.inverse() * (X_WS * X_SP), g);
      const Pose X_PQ{{0.0, 0.0, 0.0021}, rotation_z(std::acos(-1.0))};
      const Grid2 turned{-g.x(g.nx - 1), -g.y(g.ny - 1), g.dx, g.dy, g.nx, g.ny};
      const Fields other = heights(*s.surface, X_SP * X_PQ, turned);
      for (std::size_t i = 0; i < g.size(); ++i) {
        const double steep = 1.0 + std::pow(std::hypot(before.dzdx[i], before.dzdy[i]), 2);
        ASSERT_TRUE(same(before.z[i], after.z[i], 1e-11 * steep)) << s.name << ' ' << before.z[i] << ' ' << after.z[i];
        ASSERT_TRUE(same(before.z[i], other.z[g.size() - 1 - i] + 0.0021, 1e-11 * steep)) << s.name;
      }
    }
}

TEST(NurbsContract, SlopesMatchDifferencesAndMissesAreNaNThroughout) {
  constexpr double kStep = 1e-6;
  const Grid2 g = odd_grid();
  for (const ContractSubject& s : contract_subjects()) {
    int compared = 0, wrong = 0;
    for (const Pose& X : s.planes) {
      const Fields f = heights(*s.surface, X, g);
      std::vector<Fields> moved;
      for (const auto& [dx, dy] : {std::pair{kStep, 0.0}, {-kStep, 0.0}, {0.0, kStep}, {0.0, -kStep}}) {
        Grid2 h = g;
        h.x0 += dx, h.y0 += dy;
        moved.push_back(heights(*s.surface, X, h));
      }
      for (std::size_t i = 0; i < g.size(); ++i) {
        ASSERT_EQ(std::isnan(f.z[i]), std::isnan(f.dzdx[i]));
        ASSERT_EQ(std::isnan(f.z[i]), std::isnan(f.dzdy[i]));
        const double dzdx = (moved[0].z[i] - moved[1].z[i]) / (2 * kStep),
                     dzdy = (moved[2].z[i] - moved[3].z[i]) / (2 * kStep);
        if (std::isnan(f.z[i]) || std::isnan(dzdx) || std::isnan(dzdy) || std::hypot(f.dzdx[i], f.dzdy[i]) > 3.0)
          continue;
        ++compared;
        wrong += std::abs(dzdx - f.dzdx[i]) > 1e-5 || std::abs(dzdy - f.dzdy[i]) > 1e-5;
      }
    }
    EXPECT_GT(compared, 1000) << s.name;
    EXPECT_LE(wrong, compared / 200) << s.name;  // jumps of curvature between arcs
  }
}

TEST(NurbsContract, BesideTheSurfaceThereIsNothing) {
  for (const ContractSubject& s : contract_subjects())
    for (const double y : {s.y_max + 0.001, s.y_min - 0.006}) {
      Pose X = s.planes.front();
      X.origin.y() = y;
      const Grid2 g{0.0, 0.0, 1e-3, 1e-3, 5, 5};
      const Fields f = heights(*s.surface, X, g);
      for (const double z : f.z) EXPECT_TRUE(std::isnan(z)) << s.name;
      const Vec2 point(0.001, 0.002);
      SurfacePoint located;
      s.surface->locate(X, {&point, 1}, {&located, 1});
      EXPECT_EQ(located.status, LocateStatus::outside);
      EXPECT_TRUE(s.surface->height_bounds(X, {0.0, 0.004, 0.0, 0.004}).empty) << s.name;
    }
}

TEST(NurbsContract, HeightBoundsHoldEveryHeightAndAreTight) {
  constexpr int kPoints = 12;
  for (const ContractSubject& s : contract_subjects()) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const bool wheel = s.surface->facing() == Facing::down;
    int hit = 0, small = 0, loose = 0;
    for (int trial = 0; trial < 400; ++trial) {
      Pose X = s.planes[static_cast<std::size_t>(trial) % s.planes.size()];
      X.rotation =
          X.rotation * rotation({0.2 * (unit(random) - 0.5), 0.2 * (unit(random) - 0.5), 0.2 * (unit(random) - 0.5)});
      const double width = std::pow(10.0, -4.0 + 2.5 * unit(random)),
                   height = std::pow(10.0, -4.0 + 2.5 * unit(random));
      const double x = 0.1 * (unit(random) - 0.5), y = 0.15 * (unit(random) - 0.5);
      const HeightBounds bounds = s.surface->height_bounds(X, {x, x + width, y, y + height});
      const Fields f = heights(*s.surface, X, {x, y, width / (kPoints - 1), height / (kPoints - 1), kPoints, kPoints});
      double z_min = std::numeric_limits<double>::infinity(), z_max = -z_min;
      bool everywhere = true;
      for (const double z : f.z) {
        if (std::isnan(z)) {
          everywhere = false;
          continue;
        }
        ASSERT_FALSE(bounds.empty) << s.name << " trial " << trial;
        ASSERT_GE(z, bounds.z_min) << s.name << " trial " << trial;
        ASSERT_LE(z, bounds.z_max) << s.name << " trial " << trial;
        z_min = std::min(z_min, z);
        z_max = std::max(z_max, z);
      }
      if (!everywhere) continue;
      ++hit;
      if (width + height < 2e-3 && z_max - z_min < 2.0 * (width + height)) {
        ++small;
        loose += (wheel ? bounds.z_max - z_max : z_min - bounds.z_min) > 3.0 * (width + height) + 1e-4;
      }
    }
    EXPECT_GT(hit, 50) << s.name;
    EXPECT_GT(small, 20) << s.name;
    EXPECT_EQ(loose, 0) << s.name << " of " << small;
    const Box3 box = s.surface->bounds();
    EXPECT_LE(box.min.y(), s.y_min + 1e-12);
    EXPECT_GE(box.max.y(), s.y_max - 1e-12);
    EXPECT_GT(s.surface->memory_bytes(), sizeof(Surface));
  }
}

TEST(NurbsContract, LocatedPointsHaveHeightsNormalsAndCurvatures) {
  constexpr double kStep = 5e-5;  // [m] the noise of 1e-16 m heights in the second difference is 4e-8 1/m
  const Grid2 g = odd_grid();
  std::vector<Vec2> points;
  for (int iy = 0; iy < g.ny; iy += 2)
    for (int ix = 0; ix < g.nx; ix += 2) points.push_back({g.x(ix), g.y(iy)});
  for (const ContractSubject& s : contract_subjects()) {
    const double side = s.surface->facing() == Facing::down ? 1.0 : -1.0;
    int compared = 0, wrong = 0;
    for (const Pose& X : s.planes) {
      Fields f(points.size());
      s.surface->heights_at(X, points, f.out());
      std::vector<SurfacePoint> located(points.size());
      s.surface->locate(X, points, located);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const SurfacePoint& p = located[i];
        ASSERT_EQ(p.status == LocateStatus::outside, std::isnan(f.z[i]));
        if (std::isnan(f.z[i])) continue;
        const double steep = 1.0 + std::pow(std::hypot(f.dzdx[i], f.dzdy[i]), 2);
        ASSERT_LE((p.position_S - X.apply({points[i].x(), points[i].y(), f.z[i]})).norm(), 1e-12 * steep) << s.name;
        ASSERT_NEAR(p.normal_S.norm(), 1.0, 1e-12);
        ASSERT_LE(std::abs(p.normal_S.dot(X.rotation * Vec3(1.0, 0.0, f.dzdx[i]).normalized())), 1e-9) << s.name;
        ASSERT_LE(std::abs(p.normal_S.dot(X.rotation * Vec3(0.0, 1.0, f.dzdy[i]).normalized())), 1e-9) << s.name;
        const Vec3 outwards = side > 0.0 ? Vec3(p.position_S.x(), 0.0, p.position_S.z()) : Vec3(0.0, 0.0, -1.0);
        ASSERT_GT(p.normal_S.dot(outwards), 0.0) << s.name << " not out of the material";
        ASSERT_GE(p.curvature_1, p.curvature_2);
        if (i % 7) continue;
        Pose T;
        T.origin = p.position_S;
        const Vec3 n = side * p.normal_S, e = Vec3::UnitX().cross(n).norm() > 0.1 ? Vec3::UnitX() : Vec3::UnitY();
        T.rotation.col(2) = n;
        T.rotation.col(1) = n.cross(e).normalized();
        T.rotation.col(0) = T.rotation.col(1).cross(n);
        const Fields h = heights(*s.surface, T, {-kStep, -kStep, kStep, kStep, 3, 3});
        const double hxx = (h.z[3] - 2 * h.z[4] + h.z[5]) / (kStep * kStep),
                     hyy = (h.z[1] - 2 * h.z[4] + h.z[7]) / (kStep * kStep);
        const double hxy = (h.z[8] - h.z[6] - h.z[2] + h.z[0]) / (4 * kStep * kStep);
        if (std::isnan(hxx + hyy + hxy)) continue;
        const double mean = -side * 0.5 * (hxx + hyy), spread = std::hypot(0.5 * (hxx - hyy), hxy);
        const double tolerance = 1e-3 * (1.0 + std::abs(p.curvature_1) + std::abs(p.curvature_2));
        ++compared;
        wrong +=
            std::abs(mean + spread - p.curvature_1) > tolerance || std::abs(mean - spread - p.curvature_2) > tolerance;
      }
    }
    EXPECT_GT(compared, 50) << s.name;
    EXPECT_LE(wrong, compared / 20) << s.name << " of " << compared;  // differences reach across jumps of curvature
  }
}

}  // namespace
}  // namespace treadmark::spline
