// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/curved_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr double kArcRadius = 12e-3, kArcHalfAngle = 0.7;

/// Rows on a circular arc below its centre, its lowest point beside the contact reference.
struct Arc {
  Grid2 grid;
  detection::ReferenceRows rows;

  Arc() {
    constexpr int kRows = 400, kColumns = 10;
    const double ds = 2.0 * kArcRadius * kArcHalfAngle / kRows, dx = 0.5e-3;
    grid = {-0.5 * dx * (kColumns - 1), -kArcRadius * kArcHalfAngle + 0.5 * ds, dx, ds, kColumns, kRows};
    for (int iy = 0; iy < kRows; ++iy) {
      const double angle = grid.y(iy) / kArcRadius;
      rows.rows.push_back({kArcRadius * std::sin(angle), kArcRadius * (std::cos(angle) - 1.0), -angle});
    }
  }
  double length_x() const { return grid.nx * grid.dx; }
};

TEST(CurvedLoads, PressureOnAnArcCarriesItsChord) {
  const Arc arc;
  kalker::ContactSolution contact;
  const double pressure = 3e8;
  contact.pressure.assign(arc.grid.size(), pressure);
  const Wrench w = resultant_on(arc.rows, arc.grid, contact);
  const double force = pressure * arc.length_x() * 2.0 * kArcRadius * std::sin(kArcHalfAngle);
  EXPECT_NEAR(w.force.z(), force, 1e-6 * force);
  EXPECT_NEAR(w.force.y(), 0.0, 1e-9 * force);
  EXPECT_NEAR(w.moment.norm(), 0.0, 1e-9 * force);
}

// All pressures point to the centre: a piece beside the lowest point makes no moment about the centre.
TEST(CurvedLoads, PressureOnOneSideTurnsAboutTheCentreNotAtAll) {
  const Arc arc;
  kalker::ContactSolution contact;
  contact.pressure.assign(arc.grid.size(), 0.0);
  for (int iy = 300; iy < 330; ++iy)
    for (int ix = 0; ix < arc.grid.nx; ++ix) contact.pressure[arc.grid.index(ix, iy)] = 2e8;
  const Wrench w = resultant_on(arc.rows, arc.grid, contact);
  const Vec3 centre(0.0, 0.0, -kArcRadius);
  EXPECT_NEAR((w.moment - centre.cross(w.force)).norm(), 0.0, 1e-12 * w.force.norm());
  EXPECT_GT(w.force.y(), 0.1 * w.force.z());
}

TEST(CurvedLoads, TractionsKeepTheirLocalDirections) {
  const Arc arc;
  kalker::ContactSolution contact;
  contact.pressure.assign(arc.grid.size(), 1.0);  // in contact, but next to nothing
  const double px = 5e7, py = 2e7;
  contact.traction_x.assign(arc.grid.size(), px);
  contact.traction_y.assign(arc.grid.size(), py);
  const Wrench w = resultant_on(arc.rows, arc.grid, contact);
  const double length = 2.0 * kArcRadius * kArcHalfAngle, chord = 2.0 * kArcRadius * std::sin(kArcHalfAngle);
  const double depth = kArcRadius * (chord - length);  // integral of n along the arc
  EXPECT_NEAR(w.force.x(), px * arc.length_x() * length, 1e-6 * w.force.x());
  EXPECT_NEAR(w.force.y(), py * arc.length_x() * chord, 1e-5 * w.force.y());
  EXPECT_NEAR(w.moment.y(), px * arc.length_x() * depth, 1e-5 * std::abs(w.moment.y()));
  // Friction along the arc turns about the centre with the whole radius.
  const Vec3 about_centre = w.moment - Vec3(0.0, 0.0, -kArcRadius).cross(w.force);
  EXPECT_NEAR(about_centre.x(), -py * arc.length_x() * length * kArcRadius, 1e-5 * std::abs(about_centre.x()));
}

TEST(CurvedLoads, PlaneGivesTheSumsOfTheContactProblem) {
  kalker::ContactProblem problem;
  problem.grid = {-1e-3, 2e-3, 0.5e-3, 0.4e-3, 5, 4};
  problem.regime = kalker::Regime::steady;
  kalker::ContactSolution contact;
  for (std::size_t i = 0; i < problem.grid.size(); ++i) {
    const double t = static_cast<double>(i);
    contact.pressure.push_back(1e8 * (1.0 + 0.1 * t));
    contact.traction_x.push_back(1e7 * std::cos(t));
    contact.traction_y.push_back(2e7 * std::sin(2.0 * t));
    contact.state.push_back(kalker::ElementState::slip);
  }
  kalker::accumulate_totals(problem, contact);
  const Wrench w = resultant_on(detection::plane_reference(problem.grid), problem.grid, contact);
  const Vec3 force(contact.force_x, contact.force_y, contact.force_n),
      moment(contact.moment_x, contact.moment_y, contact.moment_n);
  EXPECT_NEAR((w.force - force).norm(), 0.0, 1e-13 * force.norm());
  EXPECT_NEAR((w.moment - moment).norm(), 0.0, 1e-13 * moment.norm());
  // About a reference that lies elsewhere in the grid: Steiner.
  const Vec2 reference(7e-3, -3e-3);
  const Wrench moved = resultant_on(detection::plane_reference(problem.grid, reference), problem.grid, contact);
  const Vec3 expected = moment - Vec3(reference.x(), reference.y(), 0.0).cross(force);
  EXPECT_NEAR((moved.moment - expected).norm(), 0.0, 1e-12 * expected.norm());
}

TEST(CurvedLoads, FrictionFollowsTheInclinationOfTheRow) {
  const Arc arc;
  Problem p;
  p.friction.kinetic = 0.5;
  EXPECT_TRUE(friction_on(arc.rows, -0.2, p).empty());
  FrictionLaw low, high;
  low.kinetic = 0.2;
  high.kinetic = 0.3;
  p.friction_inclination = {-0.4, -0.2};
  p.friction_laws = {low, high};
  const auto laws = friction_on(arc.rows, -0.2, p);
  ASSERT_EQ(laws.size(), arc.rows.rows.size());
  for (std::size_t iy = 0; iy < laws.size(); ++iy) {
    const double inclination = -0.2 + arc.rows.rows[iy].angle;
    const double expected = inclination < -0.4 ? 0.2 : inclination > -0.2 ? 0.3 : 0.2 + 0.5 * (inclination + 0.4);
    EXPECT_NEAR(laws[iy].kinetic, expected, 1e-12);
  }
}

TEST(CurvedLoads, AngleCorrectedCoefficientsGetTheCurve) {
  const Arc arc;
  kalker::InfluenceSettings given;
  EXPECT_TRUE(influence_on(arc.rows, arc.grid, given).inclination.empty());
  given.kind = kalker::InfluenceSettings::Kind::angle_corrected;
  given.variant = 3;
  const auto settings = influence_on(arc.rows, arc.grid, given);
  EXPECT_EQ(settings.variant, 3);
  ASSERT_EQ(settings.position.size(), 400u);
  EXPECT_EQ(settings.position[7], arc.grid.y(7));
  EXPECT_EQ(settings.inclination[7], arc.rows.rows[7].angle);
}

TEST(CurvedLoads, RefuseRowsOfAnotherGrid) {
  Arc arc;
  kalker::ContactSolution contact;
  arc.rows.rows.pop_back();
  EXPECT_THROW(resultant_on(arc.rows, arc.grid, contact), Error);
}

}  // namespace
}  // namespace treadmark::wheelrail
