// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "treadmark/tests/solvers/wheelrail/patch_on_reference.hpp"
#include "treadmark/tests/solvers/wheelrail/round_groove.hpp"

namespace treadmark::wheelrail {
namespace {

using testing::groove_problem;
using testing::place_patch;
using testing::round_groove;
using testing::solve_patch;

// Rail and wheel of the same convex profile: the surface between them is the plane.
TEST(Conformal, FlatCurveGivesTheResultsOfThePlane) {
  const double radius = 0.3;
  const Geometry geometry{analytic::make_prismatic_surface(analytic::cylinder_chain(radius, 0.2)),
                          analytic::make_revolved_surface(analytic::barrel_chain(radius, 0.2), testing::kWheelRadius),
                          true, true};
  Problem p = groove_problem(40e-6);
  p.discretisation.ds = 0.15e-3;
  p.state.velocity.y = 4e-4;
  p.state.velocity.yaw = 0.02;
  p.reference_surface = ReferenceSurface::plane_surface_slip;
  const auto plane = solve_patch(geometry, p);
  p.reference_surface = ReferenceSurface::curved;
  const auto curve = solve_patch(geometry, p);
  ASSERT_EQ(plane.contact.status, Status::ok);
  EXPECT_NEAR(curve.undeformed.approach, plane.undeformed.approach, 1e-9 * plane.undeformed.approach);
  EXPECT_EQ(curve.contact.elements_contact, plane.contact.elements_contact);
  EXPECT_EQ(curve.contact.elements_adhesion, plane.contact.elements_adhesion);
  EXPECT_NEAR(curve.slip.kinematics.xi, plane.slip.kinematics.xi, 1e-9);
  EXPECT_NEAR(curve.slip.kinematics.eta, plane.slip.kinematics.eta, 1e-9);
  const Vec3 force = plane.load_C.force;
  EXPECT_GT(force.head<2>().norm(), 0.05 * force.z());
  EXPECT_LT((curve.load_C.force - force).norm(), 1e-5 * force.norm());
  // The surface lies half the approach deeper than the contact reference: forces along it have that lever.
  const Vec3 lever = Vec3(0.0, 0.0, 0.5 * plane.undeformed.approach).cross(force);
  EXPECT_LT((curve.load_C.moment - plane.load_C.moment - lever).norm(), 1e-5 * 1e-3 * force.norm());
}

// A body does not know from which plane it is looked at.
TEST(Conformal, ForceIsTheSameSeenFromATurnedPlane) {
  const Geometry geometry = round_groove(10.1e-3);
  const Problem p = groove_problem(20e-6);
  const double turn = 20.0 * M_PI / 180.0;
  const auto straight = solve_patch(geometry, p), turned = solve_patch(geometry, p, turn);
  ASSERT_EQ(straight.contact.status, Status::ok);
  ASSERT_EQ(turned.contact.status, Status::ok);
  EXPECT_NEAR(turned.undeformed.approach, straight.undeformed.approach, 1e-4 * straight.undeformed.approach);
  EXPECT_NEAR(turned.contact.max_pressure, straight.contact.max_pressure, 1e-3 * straight.contact.max_pressure);
  EXPECT_NEAR(turned.contact.elastic_energy, straight.contact.elastic_energy, 1e-3 * straight.contact.elastic_energy);
  EXPECT_NEAR(turned.contact.frictional_power, straight.contact.frictional_power,
              2e-3 * std::abs(straight.contact.frictional_power));
  EXPECT_LT((turned.force_T - straight.force_T).norm(), 1e-3 * straight.force_T.norm());
  // The plane does know.
  Problem plane = p;
  plane.reference_surface = ReferenceSurface::plane_surface_slip;
  EXPECT_GT((solve_patch(geometry, plane, turn).force_T - solve_patch(geometry, plane).force_T).norm(),
            0.02 * straight.force_T.norm());
}

// Pressures of a nearly conforming contact point in many directions: their plain sum exceeds what they carry.
TEST(Conformal, LocalSumExceedsTheResultantOfTheSamePressures) {
  const Geometry geometry = round_groove(10.03e-3);
  Problem p = groove_problem(17e-6);
  p.regime = kalker::Regime::frictionless;
  const auto patch = solve_patch(geometry, p);
  EXPECT_GT(patch.contact.force_n, 1.02 * patch.load_C.force.z());
  double widest = 0.0;
  for (int iy = 0; iy < patch.grid.ny; ++iy)
    for (int ix = 0; ix < patch.grid.nx; ++ix)
      if (patch.contact.pressure[patch.grid.index(ix, iy)] > 0.0)
        widest = std::max(widest, std::abs(patch.reference.rows[static_cast<std::size_t>(iy)].angle));
  // Undeformed, the circles touch up to where the clearance equals the penetration along the normal.
  const double clearance = 10.03e-3 - testing::kTreadRadius;
  EXPECT_LT(widest, std::acos(clearance / (clearance + 17e-6)));
  EXPECT_GT(widest, 0.5);
}

}  // namespace
}  // namespace treadmark::wheelrail
