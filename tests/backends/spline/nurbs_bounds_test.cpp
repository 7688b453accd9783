// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Height bounds and small tiles of NURBS surfaces, against heights of one large grid or of many small ones.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using testing::kRadius;

struct BoundsSubject {
  const char* name;
  std::shared_ptr<const Surface> surface;
  double radius, loose;  ///< loose: part of the rectangles whose bounds may be wide
  friend std::ostream& operator<<(std::ostream& out, const BoundsSubject& s) { return out << s.name; }
};

std::shared_ptr<const Surface> from_grid(Body body, double step) {
  sampling::PointGrid grid;
  grid.body = body;
  grid.closed = false;
  const bool wheel = body == Body::wheel;
  const double along = wheel ? step / kRadius : step;
  for (int i = -static_cast<int>(0.16 / step); i <= static_cast<int>(0.16 / step); ++i) grid.u.push_back(along * i);
  for (int j = 0; j <= static_cast<int>(0.13 / step); ++j) grid.y.push_back((wheel ? -0.07 : -0.065) + step * j);
  for (const double u : grid.u)
    for (const double y : grid.y) {
      const double a = u / (wheel ? 0.12 : 0.05), b = (y - 5e-3) / 25e-3, dent = 1e-3 * std::exp(-a * a - b * b);
      grid.h.push_back(wheel ? kRadius + testing::flanged_wheel_z(y) - dent
                             : 3.0 * y * y + 400.0 * y * y * y * y + dent);
    }
  return make_nurbs_surface(grid);
}

std::vector<BoundsSubject> bounds_subjects() {
  const ArcChain two_arcs{
      -0.06 * std::sin(0.5), 0.06 * (1.0 - std::cos(0.5)), -0.5, {{0.06 * 0.5, 1.0 / 0.06}, {0.3 * 0.1, 1.0 / 0.3}}};
  return {{"two_arc_rail", make_nurbs_surface(two_arcs, Body::rail, 0.0), 0.0, 0.02},
          {"barrel_wheel", make_nurbs_surface(analytic::barrel_chain(0.1, 0.5), Body::wheel, kRadius), kRadius, 0.02},
          {"dented_rail", from_grid(Body::rail, 1e-3), 0.0, 0.02},
          {"dented_wheel", from_grid(Body::wheel, 1e-3), kRadius, 0.02},
          {"fine_wheel", from_grid(Body::wheel, 0.5e-3), kRadius, 0.02}};
}

class NurbsBounds : public ::testing::TestWithParam<BoundsSubject> {};

TEST_P(NurbsBounds, HoldAllHeightsOfRandomRectangles) {
  const BoundsSubject& s = GetParam();
  const bool wheel = s.radius > 0.0;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> either(-1.0, 1.0);
  constexpr int kPoints = 7;
  std::vector<double> z(kPoints * kPoints);
  int hits = 0, excess = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double theta = wheel ? 0.1 * either(random) : 0.0, tilt = trial % 2 == 0 ? 0.1 : 0.9;
    const Vec3 origin(s.radius * std::sin(theta), 0.02 * either(random),
                      s.radius * std::cos(theta) + 0.01 * either(random));
    const Pose X{origin,
                 rotation({tilt * either(random), 0.3 * tilt * either(random), theta + 0.3 * tilt * either(random)})};
    const double width = std::pow(10.0, -4.5 + 3.0 * std::fabs(either(random))),
                 height = std::pow(10.0, -4.5 + 3.0 * std::fabs(either(random)));
    const double x = 0.1 * either(random), y = 0.06 * either(random);
    const HeightBounds bounds = s.surface->height_bounds(X, {x, x + width, y, y + height});
    s.surface->heights({X, {x, y, width / (kPoints - 1), height / (kPoints - 1), kPoints, kPoints}}, {z, {}, {}});
    double low = std::numeric_limits<double>::infinity(), high = -low;
    bool all = true;
    for (const double one : z) {
      if (std::isnan(one)) {
        all = false;
        continue;
      }
      ASSERT_FALSE(bounds.empty) << "trial " << trial;
      ASSERT_GE(one, bounds.z_min - 1e-12) << "trial " << trial;
      ASSERT_LE(one, bounds.z_max + 1e-12) << "trial " << trial;
      low = std::min(low, one);
      high = std::max(high, one);
    }
    if (!all || high - low > 4.0 * (width + height)) continue;
    ++hits;
    const double more = wheel ? bounds.z_max - high : low - bounds.z_min;
    if (more > 0.2 * (high - low) + 0.5 * (width + height) + 1e-4) ++excess;
  }
  EXPECT_GT(hits, 300);
  EXPECT_LE(excess, s.loose * hits);
}

TEST_P(NurbsBounds, SmallTilesGiveTheWholeGrid) {
  const BoundsSubject& s = GetParam();
  for (const double roll : {0.0, 0.06, -0.3}) {
    const Pose X{{0.01, 0.0, s.radius}, rotation({roll, 0.02, 0.01})};
    const Grid2 g{-0.0203, -0.0311, 0.7e-3, 0.9e-3, 60, 70};
    std::vector<double> whole(g.size()), part(g.size());
    s.surface->heights({X, g}, {whole, {}, {}});
    for (const auto& [nx, ny] : {std::pair{8, 8}, {1, 60}, {60, 1}, {1, 1}, {33, 5}})
      for (int by = 0; by + ny <= g.ny; by += 2 * ny + 3)
        for (int bx = 0; bx + nx <= g.nx; bx += 2 * nx + 5) {
          const Grid2 tile{g.x(bx), g.y(by), g.dx, g.dy, nx, ny};
          s.surface->heights({X, tile}, {{part.data(), tile.size()}, {}, {}});
          for (int iy = 0; iy < ny; ++iy)
            for (int ix = 0; ix < nx; ++ix) {
              const double expected = whole[g.index(bx + ix, by + iy)], found = part[tile.index(ix, iy)];
              ASSERT_EQ(std::isnan(found), std::isnan(expected));
              if (!std::isnan(found)) {
                ASSERT_NEAR(found, expected, 1e-12);
              }
            }
        }
  }
}

INSTANTIATE_TEST_SUITE_P(Nurbs, NurbsBounds, ::testing::ValuesIn(bounds_subjects()),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace treadmark::spline
