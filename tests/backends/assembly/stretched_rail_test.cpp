// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/assembly/stretched_rail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <vector>

#include "treadmark/backends/assembly/limited_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::assembly {
namespace {

constexpr double kStretch = 0.1, kLength = 1.0;  // [m]

/// A rail with a squat, whole.
std::shared_ptr<const Surface> whole_rail() {
  static const auto rail =
      create_surface({Body::rail,
                      0.0,
                      StandardProfile{"60E1"},
                      {.squats = {{.length = 60e-3, .width = 30e-3, .depth = 1e-3, .x_center = 0.3}}}});
  return limit_along(rail, 0.0, kLength);
}

struct Opened {
  std::mutex mutex;
  std::vector<std::size_t> numbers;
};

RailStretches in_stretches(Opened& opened) {
  RailStretches out;
  out.backend = "analytic";
  for (int k = 0; k <= 10; ++k) out.ends.push_back(kStretch * k);
  out.y_min = -80e-3, out.y_max = 80e-3, out.z_min = -1e-3, out.z_max = 60e-3;
  out.most_open = 3;
  out.open = [&opened](std::size_t number) {
    const std::lock_guard lock(opened.mutex);
    opened.numbers.push_back(number);
    return whole_rail();
  };
  return out;
}

TEST(StretchedRail, IsTheRailThatItsStretchesAre) {
  Opened opened;
  const auto rail = join_stretches(in_stretches(opened)), whole = whole_rail();
  EXPECT_EQ(rail->facing(), Facing::up);
  const std::vector<Pose> planes{
      {}, {{0.35, 0.01, 0.002}, rotation({0.3, 0.05, 0.1})}, {{0.98, 0.0, 0.0}, rotation({0.0, -0.2, 0.0})}};
  const Grid2 grid{-0.055, -0.03, 1.7e-3, 2.1e-3, 80, 30};
  for (const Pose& X : planes) {
    std::vector<double> z(grid.size()), dx(grid.size()), dy(grid.size()), z_whole(grid.size()), dx_whole(grid.size()),
        dy_whole(grid.size());
    rail->heights({X, grid}, {z, dx, dy});
    whole->heights({X, grid}, {z_whole, dx_whole, dy_whole});
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      EXPECT_EQ(std::isnan(z[i]), std::isnan(z_whole[i])) << i;
      if (std::isnan(z[i])) continue;
      EXPECT_EQ(z[i], z_whole[i]);
      EXPECT_EQ(dx[i], dx_whole[i]);
      EXPECT_EQ(dy[i], dy_whole[i]);
      points.emplace_back(grid.x(static_cast<int>(i) % grid.nx), grid.y(static_cast<int>(i) / grid.nx));
    }
    std::vector<SurfacePoint> found(points.size()), expected(points.size());
    rail->locate(X, points, found);
    whole->locate(X, points, expected);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(found[i].status, expected[i].status);
      EXPECT_EQ(found[i].position_S, expected[i].position_S);
      SurfaceJet jet;
      const Vec2 uv(found[i].u, found[i].v);
      treadmark::evaluate(*rail, {&uv, 1}, {&jet, 1});
      EXPECT_LT((jet.p - found[i].position_S).norm(), 1e-9);
    }
    for (const double half : {2e-3, 30e-3, 0.4}) {
      const Rectangle r{-half, half, -10e-3, 10e-3};
      const HeightBounds here = rail->height_bounds(X, r);
      for (std::size_t i = 0; i < grid.size(); ++i) {
        const double x = grid.x(static_cast<int>(i) % grid.nx), y = grid.y(static_cast<int>(i) / grid.nx);
        if (std::isnan(z[i]) || std::fabs(x) > half || std::fabs(y) > 10e-3) continue;
        ASSERT_FALSE(here.empty);
        EXPECT_GE(z[i], here.z_min);
        EXPECT_LE(z[i], here.z_max);
      }
    }
  }
}

TEST(StretchedRail, OpensWhatIsAskedForAndKeepsSome) {
  Opened opened;
  const auto rail = join_stretches(in_stretches(opened));
  EXPECT_TRUE(std::isnan(height_at(*rail, Pose{}, {-0.01, 0.0})));
  EXPECT_TRUE(std::isnan(height_at(*rail, Pose{}, {1.01, 0.0})));
  EXPECT_TRUE(opened.numbers.empty());
  for (const double x : {0.05, 0.15, 0.05, 0.25, 0.05, 0.35, 0.05})
    EXPECT_FALSE(std::isnan(height_at(*rail, Pose{}, {x, 0.0})));
  EXPECT_EQ(opened.numbers, (std::vector<std::size_t>{0, 1, 2, 3}));
  height_at(*rail, Pose{}, {0.15, 0.0});  // went, as not asked for longest
  EXPECT_EQ(opened.numbers.back(), 1u);
  // as often as it likes from many threads, and always the same
  std::vector<double> z(1000);
  parallel_for(z.size(), [&](std::size_t i) {
    z[i] = height_at(*rail, Pose{}, {1e-3 * static_cast<double>(i) + 0.5e-3, 0.0});
  });
  for (std::size_t i = 0; i < z.size(); ++i)
    EXPECT_EQ(z[i], height_at(*whole_rail(), Pose{}, {1e-3 * static_cast<double>(i) + 0.5e-3, 0.0}));
}

TEST(StretchedRail, NeedsEndsThatIncrease) {
  Opened opened;
  RailStretches bad = in_stretches(opened);
  bad.ends[3] = bad.ends[2];
  EXPECT_THROW(join_stretches(bad), Error);
  bad.ends = {0.0};
  EXPECT_THROW(join_stretches(bad), Error);
}

}  // namespace
}  // namespace treadmark::assembly
