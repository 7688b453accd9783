// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/curved_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/detection/contact_program/wheel_mesh.hpp"

namespace treadmark::detection {
namespace {

constexpr double kGroove = 10.4e-3, kMeridian = 10e-3, kWheelRadius = 0.42;

/// Chain of a circle whose lowest point is the origin: a groove, or a wheel's tread that fits into it.
ArcChain round_chain(double radius, double half_angle) {
  return {-radius * std::sin(half_angle),
          -radius * (1.0 - std::cos(half_angle)),
          half_angle,
          {{2.0 * radius * half_angle, -1.0 / radius}}};
}

/// A wheel in a groove with the same centre of meridian and groove, all of it moved.
struct ConcentricGroove {
  std::shared_ptr<const Surface> groove = analytic::make_prismatic_surface(round_chain(kGroove, 1.35));
  std::shared_ptr<const Surface> wheel = analytic::make_revolved_surface(round_chain(kMeridian, 1.35), kWheelRadius);
  BodyPair bodies;

  explicit ConcentricGroove(const Pose& X_TG = {}) {
    bodies = {groove.get(), wheel.get(), X_TG,
              X_TG * Pose{{0.0, 0.0, kMeridian - kGroove - kWheelRadius}, Mat3::Identity()}};
  }
};

ContactFrame frame_at_bottom(double angle, const Pose& X_TG = {}) { return {{X_TG.origin, rotation_x(angle)}, angle}; }

constexpr double kMean = 0.5 * (kGroove + kMeridian);
/// Directions are averaged a step ahead of where they are used: of second order in the gap over the radius, which is
/// wide here.
constexpr double kAngle = 2e-5;

TEST(CurvedReference, LiesHalfWayBetweenConcentricCircles) {
  const ConcentricGroove pair;
  const Grid2 grid{-1e-3, -10e-3, 0.5e-3, 0.25e-3, 5, 81};
  const ReferenceRows curve = curved_reference(pair.bodies, frame_at_bottom(0.0), grid);
  ASSERT_EQ(curve.rows.size(), 81u);
  for (int iy = 0; iy < grid.ny; ++iy) {
    const ReferenceRow& row = curve.rows[static_cast<std::size_t>(iy)];
    const double angle = grid.y(iy) / kMean;  // up to 56 degrees
    EXPECT_NEAR(row.y, kMean * std::sin(angle), 2e-9);
    EXPECT_NEAR(row.n, kMean * std::cos(angle) - kGroove, 2e-9);
    EXPECT_NEAR(row.angle, -angle, kAngle);
  }
}

TEST(CurvedReference, IsTheSameCurveSeenFromATurnedContactPlane) {
  // The contact reference lies on the groove; the plane is turned by 20 degrees about the point of the curve beside it.
  const double turn = 0.35, place = turn * kMean;
  const ConcentricGroove pair;
  const Grid2 grid{0.0, -6e-3, 1e-3, 0.25e-3, 1, 49};
  const ContactFrame turned{{{0.0, kGroove * std::sin(turn), kGroove * (std::cos(turn) - 1.0)}, rotation_x(-turn)},
                            -turn};
  const ContactFrame straight = frame_at_bottom(0.0);
  const ReferenceRows a = curved_reference(pair.bodies, straight, grid, {0.0, -place});
  const ReferenceRows b = curved_reference(pair.bodies, turned, grid);
  for (int iy = 0; iy < grid.ny; ++iy) {
    const Pose seen_a = straight.X_TC * a.X_CL(iy), seen_b = turned.X_TC * b.X_CL(iy);
    EXPECT_LT((seen_a.origin - seen_b.origin).norm(), 3e-9);
    EXPECT_LT((seen_a.rotation - seen_b.rotation).norm(), 2.0 * kAngle);
  }
}

TEST(CurvedReference, ArcLengthsStartAtTheReferenceOfAGridThatLiesElsewhere) {
  const ConcentricGroove pair;
  const ContactFrame frame = frame_at_bottom(0.0);
  const Vec2 reference(31.7e-3, -7.31e-3);
  const Grid2 grid{30e-3, -9e-3, 0.25e-3, 0.3e-3, 12, 14};
  const ReferenceRows curve = curved_reference(pair.bodies, frame, grid, reference);
  for (int iy = 0; iy < grid.ny; ++iy)
    EXPECT_NEAR(curve.rows[static_cast<std::size_t>(iy)].angle, -(grid.y(iy) - reference.y()) / kMean, kAngle);
  EXPECT_NEAR(curve.X_CL(0).apply({reference.x(), 0.0, 0.0}).x(), 0.0, 1e-15);
}

TEST(CurvedReference, DistanceBetweenConcentricCirclesIsTheSameInEveryRow) {
  const ConcentricGroove pair;
  const Grid2 grid{-2e-3, -10e-3, 0.5e-3, 0.25e-3, 9, 81};
  const ContactFrame frame = frame_at_bottom(0.0);
  const ReferenceRows curve = curved_reference(pair.bodies, frame, grid);
  const FacingSurfaces surfaces = facing_surfaces(pair.bodies, frame.X_TC, grid, curve);
  const UndeformedDistance undeformed = undeformed_distance(surfaces);
  EXPECT_NEAR(undeformed.approach, -(kGroove - kMeridian), 1e-9);
  for (int iy = 0; iy < grid.ny; ++iy) {
    const std::size_t middle = grid.index(4, iy);
    EXPECT_NEAR(surfaces.rail[middle], 0.5 * (kGroove - kMeridian), 1e-8);
    EXPECT_NEAR(surfaces.wheel[middle], -0.5 * (kGroove - kMeridian), 1e-8);
    EXPECT_NEAR(undeformed.distance[middle], 0.0, 1e-9);
  }
}

TEST(CurvedReference, GoesStraightOnBeyondTheSurfaces) {
  const ConcentricGroove pair;
  const Grid2 grid{0.0, -20e-3, 1e-3, 0.5e-3, 1, 81};
  const ReferenceRows curve = curved_reference(pair.bodies, frame_at_bottom(0.0), grid);
  const ReferenceRow &last = curve.rows[80], &before = curve.rows[79];
  EXPECT_GT(std::abs(last.angle), 1.2);
  EXPECT_EQ(last.angle, before.angle);
  EXPECT_NEAR(std::hypot(last.y - before.y, last.n - before.n), grid.dy, 1e-12);
  // however far: in steps of a quarter of a millimetre it would not end
  const Grid2 wide{0.0, -1e5, 1e-3, 1e5, 1, 3};
  const ReferenceRows far = curved_reference(pair.bodies, frame_at_bottom(0.0), wide);
  EXPECT_NEAR(far.rows[2].angle, last.angle, 1e-9);
  EXPECT_NEAR(std::hypot(far.rows[2].y, far.rows[2].n), wide.dy, 1.0);
}

TEST(CurvedReference, IsThePlaneBetweenFlatSurfaces) {
  const auto up = analytic::make_plane_surface(Facing::up);
  const auto wheel = analytic::make_revolved_surface(analytic::straight_chain(0.05), kWheelRadius);
  const double roll = 0.3, penetration = 20e-6;
  const Mat3 R = rotation_x(roll);
  const BodyPair bodies{up.get(), wheel.get(), {Vec3::Zero(), R}, {R * Vec3(0.0, 0.0, penetration - kWheelRadius), R}};
  const ContactFrame frame = {{Vec3::Zero(), R}, roll};
  const Grid2 grid{-3e-3, -4e-3, 0.5e-3, 0.5e-3, 13, 17};
  const ReferenceRows curve = curved_reference(bodies, frame, grid), plane = plane_reference(grid);
  for (int iy = 0; iy < grid.ny; ++iy) {
    const auto i = static_cast<std::size_t>(iy);
    EXPECT_NEAR(curve.rows[i].y, plane.rows[i].y, 1e-15);
    EXPECT_NEAR(curve.rows[i].n, 0.5 * penetration, 1e-14);
    EXPECT_NEAR(curve.rows[i].angle, 0.0, 1e-13);
  }
  const auto whole = undeformed_distance(bodies, frame.X_TC, grid);
  for (const ReferenceRows& rows : {curve, plane}) {
    const auto by_rows = undeformed_distance(facing_surfaces(bodies, frame.X_TC, grid, rows));
    EXPECT_NEAR(by_rows.approach, whole.approach, 1e-14);
    for (std::size_t i = 0; i < grid.size(); ++i) EXPECT_NEAR(by_rows.distance[i], whole.distance[i], 1e-14);
  }
}

TEST(CurvedReference, NeedsAsManyRowsAsTheGrid) {
  const ConcentricGroove pair;
  const Grid2 grid{0.0, 0.0, 1e-3, 1e-3, 2, 3};
  EXPECT_THROW(facing_surfaces(pair.bodies, {}, grid, plane_reference({0.0, 0.0, 1e-3, 1e-3, 2, 2})), Error);
}

TEST(ProjectedDistance, OnAPlaneIsTheDistanceInThatPlane) {
  const ConcentricGroove pair;
  const Grid2 grid{-1e-3, -3e-3, 0.5e-3, 0.25e-3, 5, 25};
  const Pose X_TC = frame_at_bottom(0.0).X_TC;
  const UndeformedDistance projected = projected_distance(pair.bodies, X_TC, grid, plane_reference(grid));
  const UndeformedDistance plain = undeformed_distance(pair.bodies, X_TC, grid);
  EXPECT_NEAR(projected.approach, plain.approach, 1e-15);
  for (std::size_t i = 0; i < grid.size(); ++i) EXPECT_NEAR(projected.distance[i], plain.distance[i], 1e-15);
}

// A gap measured along the contact plane's normal, times the cosine of the surface's inclination, is the gap along the
// surface's own normal up to the second order in the gap over the radius.
TEST(ProjectedDistance, OfNearSurfacesIsTheDistanceAlongTheirNormal) {
  const ConcentricGroove pair;
  const Grid2 grid{0.0, -6e-3, 0.5e-3, 0.25e-3, 1, 49};
  const ContactFrame frame = frame_at_bottom(0.0);
  const ReferenceRows curve = curved_reference(pair.bodies, frame, grid);
  const UndeformedDistance projected = projected_distance(pair.bodies, frame.X_TC, grid, curve);
  constexpr double kGap = kGroove - kMeridian;
  for (int iy = 0; iy < grid.ny; ++iy) {
    const double gap = projected.distance[grid.index(0, iy)] - projected.approach,
                 tangent = std::tan(curve.rows[static_cast<std::size_t>(iy)].angle);
    EXPECT_NEAR(gap, kGap, kGap * kGap / kMean * (0.05 + tangent * tangent)) << grid.y(iy);
  }
}

}  // namespace
}  // namespace treadmark::detection
