// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Tiles hit by kernels: generic and AVX2 against every point asked by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_view.hpp"
#include "treadmark/tests/support/kernels.hpp"

namespace treadmark::spline {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kTileRadius = 0.46;
// Of heights what Newton's last step leaves, which goes with the square of 1e-8 m; slopes, see nurbs_limits.hpp.
constexpr double kHeightRoom = 1e-13, kSlopeRoom = 1e-8;

sampling::PointGrid points_of(Body body) {
  sampling::PointGrid grid;
  grid.body = body;
  for (int i = 0; i < 60; ++i) grid.u.push_back((body == Body::rail ? 1.0 : 2.0) * (-0.03 + 0.001 * i));
  for (int j = 0; j < 70; ++j) grid.y.push_back(-0.035 + 0.001 * j);
  for (const double u : grid.u)
    for (const double y : grid.y) {
      const double wave = 4e-4 * std::sin(300.0 * u) * std::cos(200.0 * y);
      grid.h.push_back(body == Body::rail ? 20.0 * y * y + wave : kTileRadius + 0.1 * y + wave);
    }
  return grid;
}

struct TileFields {
  std::vector<double> z, dzdx, dzdy;
  explicit TileFields(std::size_t n) : z(n, kNone), dzdx(n, kNone), dzdy(n, kNone) {}
};

struct TileCase {
  NurbsNet net;
  Facing facing;
  Pose X;
};

std::vector<TileCase> tile_cases() {
  const Pose tilted{{0.002, -0.001, 0.0}, rotation({0.4, 0.03, 0.1})};
  const Mat3 turn = rotation({0.05, 0.03, 0.02});
  const Pose wheel{Vec3(0.0, 0.0, kTileRadius), turn};
  std::vector<TileCase> cases;
  cases.push_back({fit_point_grid(points_of(Body::rail)), Facing::up, {}});
  cases.push_back({fit_point_grid(points_of(Body::rail)), Facing::up, tilted});
  cases.push_back({fit_point_grid(points_of(Body::wheel)), Facing::down, wheel});
  return cases;
}

TEST(NurbsKernels, AgreeWithSinglePoints) {
  const Grid2 g{-0.021, -0.033, 3.7e-4, 2.9e-4, 101, 229};
  for (const TileCase& c : tile_cases()) {
    const FacingHalf half(c.X, c.facing);
    const ViewArrays view = view_arrays(c.X, half);
    std::vector<PatchCorners> patches;
    for (int iu = 0; iu < c.net.patches_u(); ++iu)
      for (int iv = 0; iv < c.net.patches_v(); ++iv) patches.push_back(c.net.corners(iu, iv));
    NurbsView one(c.net, c.X, {g.x(0), g.x(g.nx - 1), g.y(0), g.y(g.ny - 1)}, c.facing);
    for (const NurbsKernel* kernels : all_kernels<NurbsKernel>())
      for (const bool slopes : {false, true}) {
        TileFields fields(g.size());
        std::vector<char> left(patches.size(), 2);
        kernels->hit_corners(view, patches.data(), static_cast<int>(patches.size()),
                             {g.x0, g.y0, g.dx, g.dy, 0, 0, g.nx, g.ny, g.nx, fields.z.data(),
                              slopes ? fields.dzdx.data() : nullptr, slopes ? fields.dzdy.data() : nullptr},
                             left.data());
        EXPECT_EQ(std::count(left.begin(), left.end(), 2), 0);
        // Steep ones need not be regular.
        const auto settled = static_cast<double>(std::count(left.begin(), left.end(), 0));
        EXPECT_GT(settled, 0.9 * static_cast<double>(patches.size()));
        int hits = 0;
        for (int iy = 0; iy < g.ny; ++iy)
          for (int ix = 0; ix < g.nx; ++ix) {
            NurbsHit hit;
            const std::size_t i = g.index(ix, iy);
            if (!one.hit(g.x(ix), g.y(iy), slopes, false, hit)) {
              EXPECT_TRUE(std::isnan(fields.z[i]));
              continue;
            }
            if (left[static_cast<std::size_t>(hit.iu * c.net.patches_v() + hit.iv)] != 0) continue;
            ++hits;
            ASSERT_NEAR(fields.z[i], hit.z, kHeightRoom) << ix << ' ' << iy;
            if (!slopes) continue;
            ASSERT_NEAR(fields.dzdx[i], hit.dzdx, kSlopeRoom) << ix << ' ' << iy;
            ASSERT_NEAR(fields.dzdy[i], hit.dzdy, kSlopeRoom) << ix << ' ' << iy;
          }
        EXPECT_GT(hits, static_cast<int>(g.size()) / 2);
      }
  }
}

}  // namespace
}  // namespace treadmark::spline
