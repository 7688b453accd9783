// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "standard_pair.hpp"
#include "treadmark/backends/create.hpp"

namespace treadmark::wheelrail {
namespace {

/// A round wheel, or one with a flat that is rolled over by a pitch angle; formulas or splines.
struct Scene {
  const char* name;
  bool flat;
  const char* backend;
  double y, yaw, pitch;
};

std::shared_ptr<const Surface> wheel_of(const Scene& scene) {
  SurfaceSpec spec;
  spec.body = Body::wheel;
  spec.nominal_radius = kStandardRadius;
  spec.shape = StandardProfile{"S1002"};
  if (scene.flat) spec.defects.flats.push_back({.length = 0.06, .depth = 0.9e-3});
  const NaturalSurface natural = create_natural(spec);
  return represent(natural, {scene.backend, 0.0, {}}).surface;
}

class LeastGap : public ::testing::TestWithParam<Scene> {
 protected:
  LeastGap()
      : geometry_{analytic::make_standard_surface({"60E1"}, Body::rail, 0.0), wheel_of(GetParam()), true,
                  !GetParam().flat},
        pair_(geometry_) {
    problem_ = standard_problem();
    problem_.vertical_force.reset();
    problem_.state.position = {.y = GetParam().y, .yaw = GetParam().yaw, .pitch = GetParam().pitch};
  }
  PairSolution at(double z) {
    problem_.state.position.z = z;
    return pair_.solve(problem_);
  }
  /// The height at which the bodies touch, by the gap far above it.
  double touching() {
    constexpr double kAbove = -2e-3;
    return kAbove + at(kAbove).least_gap;
  }

  Geometry geometry_;
  Pair pair_;
  Problem problem_;
};

/// Least of rail height less wheel height over points, seen along z of the track: all over the rail, then ever closer
/// about the best.
double brute_force(const Geometry& geometry, const Placement& placed) {
  Vec2 middle(0.0, placed.X_TR.origin.y());
  double half_x = 0.05, half_y = 0.045, least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 9; ++round) {
    constexpr int kPoints = 161;
    std::vector<Vec2> points;
    for (int i = 0; i < kPoints; ++i)
      for (int j = 0; j < kPoints; ++j)
        points.emplace_back(middle.x() + half_x * (2.0 * i / (kPoints - 1) - 1.0),
                            middle.y() + half_y * (2.0 * j / (kPoints - 1) - 1.0));
    std::vector<double> rail(points.size()), wheel(points.size());
    geometry.rail->heights_at(placed.X_TS.inverse(), points, {rail, {}, {}});
    geometry.wheel->heights_at(placed.X_TA.inverse(), points, {wheel, {}, {}});
    for (std::size_t i = 0; i < points.size(); ++i)
      if (rail[i] - wheel[i] < least) least = rail[i] - wheel[i], middle = points[i];
    half_x /= 8.0, half_y /= 8.0;
  }
  return least;
}

TEST_P(LeastGap, IsThatOfBruteForceAboveTheRailAndInIt) {
  const double z_0 = touching();
  for (const double above : {5e-3, 1e-3, 1e-6, -2e-6, -1e-4}) {
    const PairSolution s = at(z_0 - above);
    // A shallow contact may lie between the element centres.
    if (above > 0.0 || above < -5e-5) {
      EXPECT_EQ(s.status, above > 0.0 ? Status::no_contact : Status::ok) << s.message;
    }
    EXPECT_NEAR(s.least_gap, brute_force(geometry_, s.placement), 3e-9) << above;
  }
}

TEST_P(LeastGap, FallsByWhatTheWheelComesDown) {
  const double z_0 = touching();
  for (double below = -5e-3; below < 1.5e-4; below += below < -1e-4 ? 6.1e-4 : 3.7e-6)
    EXPECT_NEAR(at(z_0 + below).least_gap, -below, 5e-9) << below;
  for (double below = -1e-8; below <= 1e-8; below += 1e-9)
    EXPECT_NEAR(at(z_0 + below).least_gap, -below, 3e-9) << below;
}

TEST_P(LeastGap, VanishesWhereTheContactForceDoes) {
  const double z_0 = touching();
  problem_.discretisation.dx = problem_.discretisation.ds = 5e-6;
  problem_.regime = kalker::Regime::frictionless;
  double free = z_0 - 1e-7, pressed = z_0 + 1e-7;
  ASSERT_EQ(at(free).load.track.force.z(), 0.0);
  ASSERT_GT(at(pressed).load.track.force.z(), 0.0);
  while (pressed - free > 1e-10) {
    const double z = 0.5 * (free + pressed);
    (at(z).load.track.force.z() > 0.0 ? pressed : free) = z;
  }
  EXPECT_NEAR(at(pressed).least_gap, 0.0, 1e-8);
}

TEST_P(LeastGap, ASecantSearchFindsTheLossOfContact) {
  double a = touching() + 1e-4, b = a - 3e-4, gap_a = at(a).least_gap, gap_b = at(b).least_gap;
  for (int i = 0; i < 3 && std::abs(gap_b) > 1e-11; ++i) {
    const double c = b - gap_b * (b - a) / (gap_b - gap_a);
    a = b, gap_a = gap_b, b = c, gap_b = at(b).least_gap;
  }
  EXPECT_LT(std::abs(gap_b), 1e-10);
}

TEST_P(LeastGap, IsThatOfTheMirrorImage) {
  const double z_0 = touching();
  for (const double below : {-1e-3, 1e-4}) {
    const double right = at(z_0 + below).least_gap;
    Problem left = problem_;
    left.side = Side::left;
    left.state.position.y = -left.state.position.y;
    left.state.position.yaw = -left.state.position.yaw;
    EXPECT_EQ(Pair(geometry_).solve(left).least_gap, right);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LeastGap,
                         ::testing::Values(Scene{"tread", false, "analytic", 1.5e-3, 3e-3, 0.0},
                                           Scene{"flange", false, "analytic", 7.5e-3, 0.02, 0.0},
                                           Scene{"spline", false, "spline", -2e-3, 0.0, 0.0},
                                           Scene{"flat", true, "analytic", 0.5e-3, 2e-3, 0.03},
                                           Scene{"flat_spline", true, "spline", 1e-3, 0.0, 0.055}),
                         [](const auto& scene) { return scene.param.name; });

TEST(LeastGapOfAPair, IsNoNumberBesideTheRail) {
  Problem p = standard_problem();
  p.vertical_force.reset();
  p.state.position.y = 0.3;
  const PairSolution s = Pair(standard_geometry()).solve(p);
  EXPECT_EQ(s.status, Status::no_contact);
  EXPECT_TRUE(std::isnan(s.least_gap));
}

TEST(LeastGapOfAPair, BelongsToTheHeightThatBalancesAForce) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  const PairSolution loaded = pair.solve(p);
  p.vertical_force.reset();
  p.state.position.z = loaded.z;
  EXPECT_NEAR(pair.solve(p).least_gap, loaded.least_gap, 1e-10);
  EXPECT_LT(loaded.least_gap, -2e-5);
}

}  // namespace
}  // namespace treadmark::wheelrail
