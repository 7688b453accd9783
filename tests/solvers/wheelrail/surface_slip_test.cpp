// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/surface_slip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/solvers/wheelrail/patch_on_reference.hpp"
#include "treadmark/tests/solvers/wheelrail/round_groove.hpp"

namespace treadmark::wheelrail {
namespace {

using testing::groove_problem;
using testing::place_patch;
using testing::round_groove;

/// What the solver makes of creepages, spin and extra slip at an element.
Vec2 total_slip(const testing::PatchOnReference& patch, int ix, int iy, double offset) {
  const ContactKinematics& k = patch.slip.kinematics;
  const std::size_t i = patch.grid.index(ix, iy);
  return {k.xi - k.phi * patch.grid.y(iy) + patch.slip.extra_x[i],
          k.eta + k.phi * (patch.grid.x(ix) + offset) + patch.slip.extra_y[i]};
}

/// Depth below the contact reference at which the normal of a row cuts the wheel's round tread, sunk by the
/// penetration.
double tread_depth(const detection::ReferenceRow& row, double penetration) {
  const Vec2 centre(0.0, penetration - testing::kTreadRadius), from = Vec2(row.y, row.n) - centre;
  const Vec2 normal(-std::sin(row.angle), std::cos(row.angle));
  const double along = from.dot(normal);
  const double way =
      -along + std::sqrt(along * along - from.squaredNorm() + testing::kTreadRadius * testing::kTreadRadius);
  return row.n + way * normal.y();
}

TEST(SurfaceSlip, OfAGrooveFollowsTheRollingRadiusAndTheInclination) {
  const double penetration = 18e-6;
  const Problem p = groove_problem(penetration);
  const auto patch = place_patch(round_groove(10.2e-3), p);
  const double V = p.state.velocity.x, pitch = p.state.velocity.pitch;
  EXPECT_EQ(patch.slip.kinematics.velocity, V);
  for (int iy = 0; iy < patch.grid.ny; ++iy) {
    const detection::ReferenceRow& row = patch.reference.rows[static_cast<std::size_t>(iy)];
    const double radius = testing::kWheelRadius - penetration + tread_depth(row, penetration);
    for (int ix = 0; ix < patch.grid.nx; ix += 7) {
      const Vec2 slip = total_slip(patch, ix, iy, patch.grid.dx / 6.0);
      EXPECT_NEAR(slip.x(), -(V + pitch * radius) / V, 1e-9);
      EXPECT_NEAR(slip.y(), pitch * patch.grid.x(ix) * std::sin(row.angle) / V, 1e-9);
    }
  }
}

TEST(SurfaceSlip, FitLeavesNothingThatCreepageOrSpinCouldTake) {
  Problem p = groove_problem(18e-6);
  p.state.position.yaw = 0.02;
  p.state.position.y = 0.02e-3;
  p.state.velocity.yaw = 1.0;
  const auto patch = place_patch(round_groove(10.2e-3), p);
  double rest_x = 0.0, rest_y = 0.0, turning = 0.0, size = 0.0, arm = 0.0;
  for (int iy = 0; iy < patch.grid.ny; ++iy)
    for (int ix = 0; ix < patch.grid.nx; ++ix) {
      const std::size_t i = patch.grid.index(ix, iy);
      if (!(patch.surfaces.rail[i] < patch.surfaces.wheel[i])) continue;
      const double x = patch.grid.x(ix) + patch.grid.dx / 6.0, y = patch.grid.y(iy);
      rest_x += patch.slip.extra_x[i];
      rest_y += patch.slip.extra_y[i];
      turning += x * patch.slip.extra_y[i] - y * patch.slip.extra_x[i];
      size += std::hypot(patch.slip.extra_x[i], patch.slip.extra_y[i]);
      arm = std::max(arm, std::hypot(x, y));
    }
  ASSERT_GT(size, 0.1);
  EXPECT_NEAR(rest_x, 0.0, 1e-11 * size);
  EXPECT_NEAR(rest_y, 0.0, 1e-11 * size);
  EXPECT_NEAR(turning, 0.0, 1e-11 * size * arm);
  EXPECT_GT(std::abs(patch.slip.kinematics.phi), 1.0);
}

/// A straight tread on a crowned rail, both rolled: every row rolls on the same radius but for the roll.
struct StraightTread {
  Geometry geometry{analytic::make_prismatic_surface(analytic::cylinder_chain(0.3, 0.2)),
                    analytic::make_revolved_surface(analytic::straight_chain(0.04), testing::kWheelRadius), true, true};
  Problem problem;

  StraightTread() {
    problem.track.gauge_based = false;
    problem.track.roll = problem.state.position.roll = 0.05;
    problem.wheelset = {0.0, 0.0, testing::kWheelRadius, std::nullopt};
    problem.state.position.z = 30e-6;
    problem.state.velocity = {10.0, 0.02, 0.0, 0.0, 1.0, -10.01 / testing::kWheelRadius};
    problem.discretisation.dx = problem.discretisation.ds = 0.3e-3;
    // The axle leans over: its wheel touches aside of it.
    problem.state.position.y = testing::kWheelRadius * std::sin(0.05);
    problem.state.position.z += testing::kWheelRadius * (1.0 - std::cos(0.05));
    problem.reference_surface = ReferenceSurface::plane_surface_slip;
  }
};

TEST(SurfaceSlip, OfAStraightTreadIsCreepageAndSpin) {
  const StraightTread tread;
  const Problem& p = tread.problem;
  const auto patch = place_patch(tread.geometry, p);
  const ContactKinematics at_point =
      contact_kinematics(p, patch.placement, patch.frame.X_TC, patch.undeformed.approach);
  const ContactKinematics& k = patch.slip.kinematics;
  EXPECT_EQ(k.velocity, 10.0);
  const double scale = at_point.velocity / k.velocity, offset = patch.grid.dx / 6.0;
  // The contact angle is a weighted mean over points of a search grid: 1e-6 rad.
  EXPECT_NEAR(k.phi, at_point.phi * scale, 1e-5);
  EXPECT_GT(std::abs(k.phi), 0.05);
  EXPECT_NEAR(k.xi, at_point.xi * scale, 1e-9);
  EXPECT_NEAR(k.eta, at_point.eta * scale - k.phi * offset, 1e-9);
  double rest = 0.0;
  for (const auto* field : {&patch.slip.extra_x, &patch.slip.extra_y})
    for (const double value : *field) rest = std::max(rest, std::abs(value));
  EXPECT_LT(rest, 1e-7);
}

TEST(SurfaceSlip, OfAShiftAreLengths) {
  StraightTread tread;
  tread.problem.regime = kalker::Regime::shift;
  tread.problem.state.velocity = {1e-6, 4e-6, 0.0, 0.0, 0.0, 0.0};
  const auto patch = place_patch(tread.geometry, tread.problem);
  EXPECT_EQ(patch.slip.kinematics.velocity, 1.0);
  EXPECT_NEAR(patch.slip.kinematics.xi, -1e-6, 1e-15);
  EXPECT_NEAR(patch.slip.kinematics.eta, -4e-6 * std::cos(patch.frame.angle), 1e-15);
}

TEST(SurfaceSlip, StandingWheelHasNone) {
  StraightTread tread;
  tread.problem.state.velocity = {};
  const auto patch = place_patch(tread.geometry, tread.problem);
  EXPECT_EQ(patch.slip.kinematics.velocity, 0.0);
  EXPECT_EQ(patch.slip.kinematics.xi, 0.0);
  for (const double rest : patch.slip.extra_y) EXPECT_EQ(rest, 0.0);
}

TEST(SurfaceSlip, SpinningOnTheSpotSlides) {
  StraightTread tread;
  tread.problem.state.velocity = {0.0, 0.0, 0.0, 0.0, 0.0, -2.0};
  const auto patch = place_patch(tread.geometry, tread.problem);
  EXPECT_GT(patch.slip.kinematics.velocity, 0.1);
  EXPECT_NEAR(patch.slip.kinematics.xi, 2.0, 1e-3);
}

TEST(SurfaceSlip, RefusesSurfacesOfAnotherGrid) {
  const StraightTread tread;
  const auto patch = place_patch(tread.geometry, tread.problem);
  Grid2 other = patch.grid;
  ++other.nx;
  EXPECT_THROW(
      surface_slip(tread.problem, patch.placement, patch.frame.X_TC, other, patch.reference, patch.surfaces, {}),
      Error);
}

}  // namespace
}  // namespace treadmark::wheelrail
