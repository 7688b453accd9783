// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/placement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"

namespace treadmark::wheelrail {
namespace {

TEST(Placement, UncantedRailHasItsTopAtZeroAndItsGaugePointAtHalfGauge) {
  const Geometry g = standard_geometry();
  Problem p;
  p.track.gauge_width = 1.435;
  const Placement placed = place(g, p);
  // 60E1: half head width is 36 mm at 14.3 mm below the top, 35.99 mm in the R13 arc at 14 mm.
  const double half_head = 23.016030e-3 + std::sqrt(13e-3 * 13e-3 - std::pow(14.949147e-3 - 14e-3, 2));
  EXPECT_NEAR(placed.X_TR.origin.y(), 0.7175 + half_head, 2e-7);
  EXPECT_NEAR(placed.X_TR.origin.z(), 0.0, 1e-9);
}

TEST(Placement, CantTurnsTheHeadInwardAndKeepsTheTopAtTheTrackPlane) {
  const Geometry g = standard_geometry();
  Problem p;
  p.track.cant = 1.0 / 40.0;
  const Placement placed = place(g, p);
  EXPECT_NEAR(placed.X_TR.rotation(2, 1), std::sin(-1.0 / 40.0), 1e-15);
  const LateralRange range = visible_range(*g.rail, placed.X_TR.inverse(), 0.0);
  double top = 1.0, gauge_y = 1.0;
  for (double y = range.y_min + 1e-9; y < range.y_max; y += 1e-5) {
    const double z = height_at(*g.rail, placed.X_TR.inverse(), {0.0, y});
    top = std::min(top, z);
    if (z <= 14e-3) gauge_y = std::min(gauge_y, y);
  }
  EXPECT_NEAR(top, 0.0, 1e-9);
  EXPECT_NEAR(gauge_y, 0.7175, 1.1e-5);
}

TEST(Placement, APlaceFarFromTheRailsOriginMakesNoDifference) {
  const Profile near = analytic::sample_profile({"60E1"}, 0.2e-3);
  Problem p;
  p.track.cant = 1.0 / 40.0;
  const GaugePoint there = gauge_point(*standard_geometry().rail, p.track.cant, p.track);
  for (const double y : {-1.5, 0.75}) {
    Profile far = near;
    for (double& v : far.y) v += y;
    const auto rail = spline::make_profile_surface(far, 0.0);
    const GaugePoint here = gauge_point(*rail, p.track.cant, p.track);
    EXPECT_NEAR(here.y - there.y, y * std::cos(p.track.cant), 2e-6);
  }
}

TEST(Placement, AbsolutePlacementAndIrregularity) {
  const Geometry g = standard_geometry();
  Problem p;
  p.track.gauge_based = false;
  p.track.rail_y0 = 0.75;
  p.track.rail_z0 = 0.01;
  p.track.dy = 1e-3;
  p.track.dz = -2e-3;
  p.track.cant = 0.02;
  p.track.roll = 0.005;
  const Placement placed = place(g, p);
  EXPECT_NEAR((placed.X_TR.origin - Vec3(0.0, 0.751, 0.008)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(roll_yaw_pitch(placed.X_TR.rotation).roll, -0.015, 1e-15);
}

TEST(Placement, WheelsetStandsOnTheTrackPlane) {
  const Geometry g = standard_geometry();
  Problem p;
  p.wheelset = {1.360, -0.070, 0.460, std::nullopt};
  p.state.position = {0.0, 2e-3, 1e-3, 0.01, 0.02, 0.3};
  const Placement placed = place(g, p);
  EXPECT_NEAR((placed.X_TWs.origin - Vec3(0.0, 2e-3, 1e-3 - 0.46)).norm(), 0.0, 1e-15);
  const RollYawPitch angles = roll_yaw_pitch(placed.X_TWs.rotation);
  EXPECT_NEAR(angles.roll, 0.01, 1e-15);
  EXPECT_NEAR(angles.yaw, 0.02, 1e-15);
  EXPECT_NEAR(angles.pitch, 0.0, 1e-15) << "the wheelset marker does not pitch";
  EXPECT_NEAR((placed.X_TWs.apply_inverse(placed.X_TW.origin) - Vec3(0.0, 0.750, 0.460)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(roll_yaw_pitch(placed.X_TA.rotation).pitch, 0.3, 1e-12) << "the wheel surface does";
}

TEST(Placement, TapeLineSetsTheRadiusThere) {
  const Geometry g = standard_geometry();
  Problem p;
  p.wheelset.nominal_radius = 0.46;
  p.wheelset.tape_line = 20e-3;
  const Placement placed = place(g, p);
  const double dr = height_at(*g.wheel, Pose{}, {0.0, 20e-3}) - 0.46;
  ASSERT_LT(dr, -1e-4);
  EXPECT_NEAR(placed.X_TW.origin.z(), -dr, 1e-12);
  p.wheelset.tape_line = 0.2;
  EXPECT_THROW(place(g, p), Error);
}

}  // namespace
}  // namespace treadmark::wheelrail
