// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "treadmark/backends/levelset/make.hpp"
#include "treadmark/tests/backends/levelset/shapes.hpp"
#include "treadmark/tests/support/refusal.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using Use = Solid::Use;

constexpr double kVoxel = 0.5e-3, kNearEdge = 3.0 * kVoxel;

std::shared_ptr<const Surface> rail_of(std::vector<Solid> solids, double voxel = kVoxel) {
  return levelset::make_level_set_surface(SolidShape{"", voxel, std::move(solids)}, Body::rail, 0.0, "level-set");
}

TriangleMesh block() { return box_mesh({-0.02, -0.015, 0.0}, {0.02, 0.015, 0.02}); }

/// A cutter of 25 mm whose lowest point lies 3 mm below the top of a block.
TEST(Solids, ACutterTakesAwayWhatItReaches) {
  constexpr double kRadius = 0.025, kDepth = 0.003;
  const auto rail =
      rail_of({{Use::join, block(), Vec3::Zero()},
               {Use::cut, cylinder_mesh(0.0, 0.0, kRadius, -0.02, 0.02, 720), Vec3(0.001, 0.0, kDepth - kRadius)}});
  const double half = std::sqrt(kRadius * kRadius - (kRadius - kDepth) * (kRadius - kDepth));
  int cut = 0;
  for (double x = -0.017; x < 0.017; x += 0.00023) {
    const double off = x - 0.001;
    if (std::fabs(std::fabs(off) - half) < kNearEdge) continue;
    const double expected = std::fabs(off) < half ? kDepth - kRadius + std::sqrt(kRadius * kRadius - off * off) : 0.0;
    EXPECT_NEAR(height_at(*rail, {}, {x, 0.0021}), expected, kTenthOfVoxel * kVoxel) << x;
    cut += expected > 0.0;
  }
  EXPECT_GT(cut, 60);
  // edges are rounded, by less than a voxel
  EXPECT_NEAR(height_at(*rail, {}, {0.001 + half, 0.0}), 0.0, kVoxel);
}

/// A groove with a keeper: two blocks with a gap, and what lies below it.
TEST(Solids, AJoinedBodyHidesOnlyWhatItCovers) {
  const auto rail = rail_of({{Use::join, block(), Vec3::Zero()},
                             {Use::join, box_mesh({-0.02, 0.0, 0.0}, {0.02, 0.01, 0.03}), Vec3(0.0, 0.022, -0.002)}});
  EXPECT_NEAR(height_at(*rail, {}, {0.0, 0.01}), 0.0, 1e-8);
  EXPECT_NEAR(height_at(*rail, {}, {0.0, 0.027}), -0.002, 1e-8);
  EXPECT_TRUE(std::isnan(height_at(*rail, {}, {0.0, 0.0185})));
  // overlapping: no seam inside
  const auto one = rail_of({{Use::join, block(), Vec3::Zero()}, {Use::join, block(), Vec3(0.0, 0.008, 0.0)}});
  for (double y = -0.013; y < 0.021; y += 0.0007) EXPECT_NEAR(height_at(*one, {}, {0.001, y}), 0.0, 1e-7) << y;
}

/// A ball buried in a block and cut out of it is a hole that nobody sees; what both have in common is the ball.
TEST(Solids, WhatLiesWithinAnotherBody) {
  const Distance ball = [](const Vec3& p) { return (p - Vec3(0.0, 0.0, 0.01)).norm() - 0.005; };
  const DistanceGrid given = sampled(ball, Vec3::Constant(-0.01), {0.01, 0.01, 0.02}, kVoxel);
  const auto hollow = rail_of({{Use::join, block(), Vec3::Zero()}, {Use::cut, given, Vec3::Zero()}});
  EXPECT_NEAR(height_at(*hollow, {}, {0.0, 0.0}), 0.0, 1e-7);
  SurfacePoint p;
  const Vec2 at(0.0, 0.0);
  hollow->locate({}, {&at, 1}, {&p, 1});
  EXPECT_EQ(p.status, LocateStatus::ambiguous);
  const auto common = rail_of({{Use::join, block(), Vec3::Zero()}, {Use::common, given, Vec3::Zero()}});
  EXPECT_NEAR(height_at(*common, {}, {0.0, 0.0}), 0.005, kTenthOfVoxel * kVoxel);
  EXPECT_TRUE(std::isnan(height_at(*common, {}, {0.0, 0.008})));
}

/// A level set that lies turned and moved, with voxels of its own.
TEST(Solids, LevelSetsAreTakenOverToAnotherLattice) {
  const Distance ball = [](const Vec3& p) { return p.norm() - 0.008; };
  DistanceGrid given = sampled(ball, Vec3::Constant(-0.012), Vec3::Constant(0.012), 0.6e-3);
  given.place = {Vec3(0.002, 0.001, -0.003), rotation({0.3, -0.4, 0.2})};
  const auto rail = rail_of({{Use::join, block(), Vec3::Zero()}, {Use::join, given, Vec3(0.0, 0.001, 0.0)}});
  EXPECT_NEAR(height_at(*rail, {}, {0.002, 0.002}), -0.011, kTenthOfVoxel * kVoxel);
  EXPECT_NEAR(height_at(*rail, {}, {-0.012, 0.002}), 0.0, 1e-7);
  // alone it keeps its lattice
  const auto alone = rail_of({{Use::join, given, Vec3::Zero()}}, 0.0);
  EXPECT_NEAR(height_at(*alone, {}, {0.002, 0.001}), -0.011, kTenthOfVoxel * 0.6e-3);
}

TEST(Solids, WhatMakesNoBodyIsRefused) {
  const auto refusal = [](std::vector<Solid> solids, double voxel = kVoxel) {
    return refusal_of([&] { rail_of(std::move(solids), voxel); });
  };
  TriangleMesh open = block();
  open.triangles.pop_back();
  EXPECT_THAT(refusal({}), HasSubstr("at least one"));
  EXPECT_THAT(refusal({{Use::cut, block(), Vec3::Zero()}}), HasSubstr("must be joined"));
  EXPECT_THAT(refusal({{Use::join, block(), Vec3::Zero()}, {Use::cut, open, Vec3::Zero()}}), HasSubstr("are open"));
  EXPECT_THAT(refusal({{Use::join, block(), Vec3::Zero()},
                       {Use::cut, box_mesh(Vec3::Constant(-0.1), Vec3::Constant(0.1)), Vec3::Zero()}}),
              HasSubstr("nothing is left"));
  EXPECT_THAT(refusal({{Use::join, block(), Vec3::Zero()}}, -1.0), HasSubstr("must be positive"));
  const DistanceGrid ball =
      sampled([](const Vec3& p) { return p.norm() - 0.005; }, Vec3::Constant(-0.01), Vec3::Constant(0.01), kVoxel);
  EXPECT_THAT(refusal({{Use::join, block(), Vec3::Zero()}, {Use::cut, ball, Vec3::Zero()}}, 2.0 * kVoxel),
              HasSubstr("too narrow"));
  EXPECT_THAT(refusal({{Use::join, box_mesh(Vec3::Zero(), Vec3::Constant(3.0)), Vec3::Zero()}}, 0.02),
              HasSubstr("which no rail is"));
}

}  // namespace
}  // namespace treadmark::testing
