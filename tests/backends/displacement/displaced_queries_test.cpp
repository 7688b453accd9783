// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <random>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/backends/displacement/fields.hpp"

namespace treadmark::testing {
namespace {

using displacement::make_displaced_surface;

constexpr double kQueriesR = 0.46;
constexpr double kCylinder = 0.3;
const Grid2 kQueriesGrid{-0.0197, -0.0193, 0.00093, 0.00101, 43, 39};

std::shared_ptr<const Surface> wheel(bool exact) {
  WheelFlat f;
  f.length = 0.06;
  f.depth = 0.8e-3;
  f.theta_center = 0.01;
  f.y_center = 0.004;
  f.width = 0.05;
  if (exact) return analytic::make_standard_surface({"S1002"}, Body::wheel, kQueriesR, {f});
  return make_displaced_surface(
      analytic::make_standard_surface({"S1002"}, Body::wheel, kQueriesR),
      std::make_shared<BumpField>(-f.depth, f.theta_center, f.y_center, f.length / kQueriesR, f.width, true),
      Body::wheel, "displaced");
}

/// A cylindrical rail with a dent (amount > 0) or a weld bead standing out.
std::shared_ptr<const Surface> rail(double amount) {
  return make_displaced_surface(analytic::make_prismatic_surface(analytic::cylinder_chain(kCylinder, 0.1)),
                                std::make_shared<BumpField>(amount, 0.002, 0.005, 0.02, 0.015, false), Body::rail,
                                "displaced");
}
double rail_z(double amount, double x, double y) {
  return kCylinder - std::sqrt(kCylinder * kCylinder - y * y) +
         BumpField(amount, 0.002, 0.005, 0.02, 0.015, false).jet(x, y).value;
}

/// First crossing of the line with the formula from above, in fine steps.
double brute_force(double amount, const Pose& X, double x, double y) {
  constexpr double kStep = 2e-5, kEnd = kCylinder * 0.0998334166468;
  const auto above = [&](double t) {
    const Vec3 p = X.apply({x, y, t});
    return std::fabs(p.y()) > kEnd ? std::nan("") : rail_z(amount, p.x(), p.y()) - p.z();
  };
  for (double t = -0.02; t < 0.02; t += kStep) {
    if (!(above(t) > 0.0) || !(above(t + kStep) <= 0.0)) continue;
    double a = t, b = t + kStep;
    for (int k = 0; k < 50; ++k) (above(0.5 * (a + b)) > 0.0 ? a : b) = 0.5 * (a + b);
    return 0.5 * (a + b);
  }
  return std::nan("");
}

TEST(DisplacedQueries, DentsAndBeadsOnARailMatchABruteForceSearch) {
  // the last plane looks along the rail, where a bead hides what lies behind it
  const std::vector<Pose> planes{pose({0.0, 0.0, 0.0}, 0.0, 0.0, 0.0), pose({0.0, 0.0, 0.0}, 0.1, 0.3, -0.05),
                                 pose({0.0, 0.0, 0.0}, 0.4, 0.0, 0.3), pose({0.0, 0.003, 0.0}, 0.0, 0.2, 1.35)};
  for (const double amount : {1.5e-3, -1.5e-3}) {
    const auto surface = rail(amount);
    int compared = 0, hidden = 0;
    for (const Pose& X : planes) {
      const Grid2 g{-0.0091, -0.0087, 0.00053, 0.00061, 33, 29};
      const Fields f = evaluate(*surface, X, g);
      for (int iy = 0; iy < g.ny; ++iy)
        for (int ix = 0; ix < g.nx; ++ix) {
          const double z = f.z[g.index(ix, iy)], expected = brute_force(amount, X, g.x(ix), g.y(iy));
          if (std::isnan(expected) || std::fabs(expected) > 0.0199) continue;
          const double steep = 1.0 + std::pow(std::hypot(f.dzdx[g.index(ix, iy)], f.dzdy[g.index(ix, iy)]), 2);
          ++compared;
          // a line that touches a crest within the step of the search is seen by only one of them
          if (z < expected - 1e-9) {
            ++hidden;
            continue;
          }
          EXPECT_NEAR(z, expected, 1e-12 * steep) << g.x(ix) << ' ' << g.y(iy) << " plane " << &X - planes.data();
        }
    }
    EXPECT_GT(compared, 2500);
    EXPECT_LE(hidden, 8);
  }
}

TEST(DisplacedQueries, LocateFindsPositionNormalAndCurvatures) {
  const auto expected = wheel(true), found = wheel(false);
  std::vector<Vec2> points;
  for (int iy = 0; iy < kQueriesGrid.ny; iy += 2)
    for (int ix = 0; ix < kQueriesGrid.nx; ix += 2) points.push_back({kQueriesGrid.x(ix), kQueriesGrid.y(iy)});
  int compared = 0, wrong = 0;
  for (const Pose& X : wheel_planes(kQueriesR)) {
    std::vector<SurfacePoint> a(points.size()), b(points.size());
    expected->locate(X, points, a);
    found->locate(X, points, b);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(a[i].status == LocateStatus::outside, b[i].status == LocateStatus::outside);
      if (a[i].status == LocateStatus::outside) continue;
      const double cosine = std::fabs(a[i].normal_S.dot(X.rotation.col(2)));
      EXPECT_LE((a[i].position_S - b[i].position_S).norm(), 1e-11 / (cosine * cosine));
      EXPECT_LE((a[i].normal_S - b[i].normal_S).norm(), 1e-8);
      EXPECT_NEAR(a[i].u, b[i].u, 1e-10);
      EXPECT_NEAR(b[i].normal_S.norm(), 1.0, 1e-12);
      EXPECT_GE(b[i].curvature_1, b[i].curvature_2);
      // differences over 1e-5 m straddle a few joints of the profile
      const double scale = 1.0 + std::fabs(a[i].curvature_1) + std::fabs(a[i].curvature_2);
      ++compared;
      if (std::fabs(a[i].curvature_1 - b[i].curvature_1) + std::fabs(a[i].curvature_2 - b[i].curvature_2) >
          2e-5 * scale)
        ++wrong;
    }
  }
  EXPECT_GT(compared, 1500);
  EXPECT_LE(wrong, compared / 100);
}

TEST(DisplacedQueries, CurvaturesOnARailMatchTheFormula) {
  const double amount = 0.4e-3;
  const auto surface = rail(amount);
  for (const Vec2& at : {Vec2(0.002, 0.005), Vec2(0.004, 0.003), Vec2(-0.003, 0.008), Vec2(0.02, 0.01)}) {
    const BumpField field(amount, 0.002, 0.005, 0.02, 0.015, false);
    const auto j = field.jet(at.x(), at.y());
    const double root = std::sqrt(kCylinder * kCylinder - at.y() * at.y());
    const double p = j.d_u, q = j.d_y + at.y() / root, r = j.d_uu, s = j.d_uy,
                 t = j.d_yy + kCylinder * kCylinder / (root * root * root), w = 1.0 + p * p + q * q;
    // z down: the body is convex where z bends downwards
    const double mean = 0.5 * ((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / std::pow(w, 1.5),
                 gauss = (r * t - s * s) / (w * w);
    const double spread = std::sqrt(std::max(0.0, mean * mean - gauss));
    for (const Pose& X : {pose({0, 0, 0}, 0.0, 0.0, 0.0)}) {
      SurfacePoint point;
      surface->locate(X, {&at, 1}, {&point, 1});
      EXPECT_NEAR(point.curvature_1, mean + spread, 1e-5 * (1.0 + std::fabs(mean) + spread));
      EXPECT_NEAR(point.curvature_2, mean - spread, 1e-5 * (1.0 + std::fabs(mean) + spread));
      EXPECT_LT(point.normal_S.z(), 0.0);
    }
  }
}

TEST(DisplacedQueries, TilesThreadsAndScatteredPointsGiveTheSame) {
  for (const bool is_wheel : {true, false}) {
    const auto surface = is_wheel ? wheel(false) : rail(-1.5e-3);
    for (const Pose& X : is_wheel ? wheel_planes(kQueriesR) : rail_planes()) {
      Fields one, many;
      {
        const ThreadLimit limit(1);
        one = evaluate(*surface, X, kQueriesGrid);
      }
      {
        const ThreadLimit limit(4);
        many = evaluate(*surface, X, kQueriesGrid);
      }
      std::vector<Vec2> points;
      for (std::size_t i = 0; i < kQueriesGrid.size(); ++i) {
        ASSERT_TRUE(same(one.z[i], many.z[i], 0.0) && same(one.dzdx[i], many.dzdx[i], 0.0) &&
                    same(one.dzdy[i], many.dzdy[i], 0.0));
        points.push_back({kQueriesGrid.x(static_cast<int>(i) % kQueriesGrid.nx),
                          kQueriesGrid.y(static_cast<int>(i) / kQueriesGrid.nx)});
      }
      std::vector<double> z(points.size());
      surface->heights_at(X, points, {z, {}, {}});
      for (std::size_t i = 0; i < kQueriesGrid.size(); ++i) {
        const double steep = 1.0 + std::hypot(one.dzdx[i], one.dzdy[i]);
        ASSERT_TRUE(same(one.z[i], z[i], 1e-12 * steep)) << one.z[i] << ' ' << z[i];
        if (i % 7 == 0) {
          ASSERT_TRUE(same(one.z[i], height_at(*surface, X, points[i]), 1e-12 * steep)) << one.z[i];
        }
      }
    }
  }
}

TEST(DisplacedQueries, HeightBoundsHoldEveryHeight) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int small = 0, loose = 0, hits = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const bool is_wheel = trial % 2 == 0;
    static const auto a = wheel(false), b = rail(-1.5e-3);
    const Surface& surface = is_wheel ? *a : *b;
    const std::vector<Pose> planes = is_wheel ? wheel_planes(kQueriesR) : rail_planes();
    const Pose& X = planes[static_cast<std::size_t>(trial / 2) % planes.size()];
    const double width = std::pow(10.0, -4.0 + 2.5 * unit(random)), height = std::pow(10.0, -4.0 + 2.5 * unit(random));
    const double x = 0.06 * (unit(random) - 0.5), y = 0.06 * (unit(random) - 0.5);
    const HeightBounds bounds = surface.height_bounds(X, {x, x + width, y, y + height});
    const Fields f = evaluate(surface, X, {x, y, width / 7, height / 7, 8, 8});
    double low = 1.0, high = -1.0;
    for (const double z : f.z) {
      if (std::isnan(z)) continue;
      ASSERT_FALSE(bounds.empty) << trial;
      ASSERT_GE(z, bounds.z_min - 1e-10) << trial;
      ASSERT_LE(z, bounds.z_max + 1e-10) << trial;
      low = std::min(low, z), high = std::max(high, z);
      ++hits;
    }
    if (high < low || width + height > 2e-3 || high - low > 2.0 * (width + height)) continue;
    ++small;
    // the bump of the test knows its range only as a whole
    if ((is_wheel ? bounds.z_max - high : low - bounds.z_min) > 3.0 * (width + height) + 1e-4 + 1.5e-3) ++loose;
  }
  EXPECT_GT(hits, 5000);
  EXPECT_GT(small, 20);
  EXPECT_LE(loose, small / 10);
}

TEST(DisplacedQueries, SlopesOfOnePointOnALineThroughTheAxle) {
  // nothing moves sideways there: the height is found at once, and the slopes must still belong to it
  const auto exact = wheel(true), displaced = wheel(false);
  constexpr double kTolerance = 1e-8;  // the analytic wheel's own: it stops within 3e-8 m of the point
  for (const double theta : {-0.03, 0.0, 0.02, 0.05}) {
    Pose X;
    X.rotation.col(0) = Vec3(std::cos(theta), 0.0, -std::sin(theta));
    X.rotation.col(2) = Vec3(std::sin(theta), 0.0, std::cos(theta));
    for (const double y : {-0.012, 0.003, 0.018}) {
      const Vec2 p(0.0, y);
      double a[3], b[3];
      exact->heights_at(X, {&p, 1}, {{&a[0], 1}, {&a[1], 1}, {&a[2], 1}});
      displaced->heights_at(X, {&p, 1}, {{&b[0], 1}, {&b[1], 1}, {&b[2], 1}});
      EXPECT_NEAR(a[0], b[0], 1e-12);
      EXPECT_NEAR(a[1], b[1], kTolerance) << theta << ' ' << y;
      EXPECT_NEAR(a[2], b[2], kTolerance) << theta << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace treadmark::testing
