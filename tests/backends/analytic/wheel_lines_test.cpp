// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Small calls give what one large grid gives; the kernels of different processors agree.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/analytic/wheels/wheel_ray.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {
namespace {

std::vector<WheelFlat> flats() {
  return {{WheelFlat::Shape::rounded, 0.06, 0.8e-3, 0.02, 6e-3, 0.05},
          {WheelFlat::Shape::fresh, 0.05, 0.0, -0.05, 0.0, 0.0}};
}

std::vector<Pose> planes() {
  std::vector<Pose> all;
  for (const RollYawPitch& a :
       {RollYawPitch{0.0, 0.0, 0.0}, {0.05, 0.0, 0.0}, {0.04, 0.03, 0.02}, {-0.6, 0.1, 0.0}, {0.9, 1.2, 0.1}})
    all.push_back({{0.0, a.roll < -0.5 ? -0.03 : 0.0, 0.46}, rotation(a)});
  return all;
}

void expect_same(double found, double expected, double slope) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(found));
    return;
  }
  EXPECT_NEAR(found, expected, 1e-13 * (1.0 + slope * slope));
}

TEST(SmallCalls, GiveTheWholeGrid) {
  const std::shared_ptr<const Surface> surfaces[] = {make_standard_surface({"S1002"}, Body::wheel, 0.46, flats()),
                                                     make_standard_surface({"60E1"}, Body::rail, 0.0)};
  for (const auto& surface : surfaces)
    for (Pose X : planes()) {
      if (surface->facing() == Facing::up) X.origin.z() = 0.0;
      const Grid2 g{-0.0401, -0.0715, 1.1e-3, 1.3e-3, 75, 110};
      std::vector<double> z(g.size()), zx(z), zy(z), one(z.size()), one_x(z), one_y(z);
      surface->heights({X, g}, {z, zx, zy});
      for (const auto& [nx, ny] : {std::pair{8, 8}, {3, 64}, {1, 60}, {60, 1}, {1, 1}, {5, 2}})
        for (int by = 0; by + ny <= g.ny; by += 2 * ny + 3)
          for (int bx = 0; bx + nx <= g.nx; bx += 2 * nx + 5) {
            const Grid2 part{g.x(bx), g.y(by), g.dx, g.dy, nx, ny};
            surface->heights({X, part},
                             {{one.data(), part.size()}, {one_x.data(), part.size()}, {one_y.data(), part.size()}});
            for (int iy = 0; iy < ny; ++iy)
              for (int ix = 0; ix < nx; ++ix) {
                const std::size_t i = g.index(bx + ix, by + iy), k = part.index(ix, iy);
                const double slope = std::hypot(zx[i], zy[i]);
                expect_same(one[k], z[i], slope);
                if (std::isnan(z[i]) || slope > 5.0) continue;
                EXPECT_NEAR(one_x[k], zx[i], 1e-8 * (1.0 + slope * slope));
                EXPECT_NEAR(one_y[k], zy[i], 1e-8 * (1.0 + slope * slope));
              }
          }
    }
}

TEST(SmallCalls, ListsGiveTheGrid) {
  const auto wheel = make_standard_surface({"S1002"}, Body::wheel, 0.46, flats());
  std::mt19937 random(3);
  for (const Pose& X : planes()) {
    const Grid2 g{-0.0401, -0.0715, 1.1e-3, 1.3e-3, 75, 110};
    std::vector<double> z(g.size()), found(g.size());
    wheel->heights({X, g}, {z, {}, {}});
    std::vector<std::size_t> order(g.size());
    std::vector<Vec2> points;
    for (auto& i : order) {
      i = random() % g.size();
      points.push_back({g.x(static_cast<int>(i) % g.nx), g.y(static_cast<int>(i) / g.nx)});
    }
    wheel->heights_at(X, points, {found, {}, {}});
    for (std::size_t k = 0; k < order.size(); ++k) expect_same(found[k], z[order[k]], 3.0);
  }
}

TEST(WheelLanes, KernelsAgreeWithEachOtherAndWithSingleRays) {
  const WheelBody body(s1002_curve(), 0.46, flats());
  ASSERT_TRUE(body.all_narrow);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> either(-1.0, 1.0);
  int compared = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Mat3 turn = rotation({0.3 * either(random), 0.0, 0.3 * either(random)});
    const Vec3 n = turn.col(2), at(0.05 * either(random), 0.04 * either(random), 0.46);
    WheelLanesInput in{};
    in.n_x = n.x(), in.n_y = n.y(), in.n_z = n.z(), in.a = n.x() * n.x() + n.z() * n.z();
    in.radius = 0.46, in.r_max = body.r_max, in.near = WheelRay::kNear, in.exact = true;
    in.flats = body.narrow_flats.data(), in.flat_count = 2;
    const ChordSlopes::Cells cells = body.chords.towards(n.y() > 0.0);
    in.chords = cells.slopes, in.chord_cells = cells.count;
    in.chords_begin = cells.begin, in.chords_per_length = cells.per_length;
    in.max_d_theta = body.flats.max_d_theta(), in.max_d_y = body.flats.max_d_y();
    in.piece = body.pieces[static_cast<std::size_t>(body.curve.find(at.y(), 0))];
    WheelLanesHits first{};
    for (int k = 0; k < kWheelLanes; ++k) {
      const Vec3 o = at + turn.col(0) * (3e-4 * k);
      first.o_x[k] = o.x(), first.o_y[k] = o.y(), first.o_z[k] = o.z();
      first.t[k] = k == 2 ? std::numeric_limits<double>::quiet_NaN() : 1e-3 * either(random);
    }
    WheelLanesHits second = first;
    const unsigned settled = WheelLanesKernel::generic.hits(in, first);
    if (const auto* kernel = avx2_kernel<WheelLanesKernel>(); kernel != nullptr) {
      ASSERT_EQ(kernel->hits(in, second), settled);
    } else {
      second = first;
    }
    WheelRay ray(body, n);
    for (int k = 0; k < kWheelLanes; ++k) {
      WheelHit hit;
      if ((settled >> k & 1u) == 0 || !ray.cast({first.o_x[k], first.o_y[k], first.o_z[k]}, first.t[k], hit)) continue;
      const double steep = 1.0 + hit.f_y * hit.f_y;
      EXPECT_NEAR(first.t[k], second.t[k], 1e-14 * steep);
      EXPECT_NEAR(first.f_y[k], second.f_y[k], 1e-9 * steep);
      EXPECT_NEAR(first.f_theta[k], second.f_theta[k], 1e-10);
      EXPECT_NEAR(first.t[k], hit.t, 1e-14 * steep);
      EXPECT_NEAR(first.f_theta[k], hit.f_theta, 1e-10);
      ++compared;
    }
  }
  EXPECT_GT(compared, 8000);
}

}  // namespace
}  // namespace treadmark::analytic
