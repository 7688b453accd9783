// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/pair.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "standard_pair.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {
namespace {

Geometry ball_on_plane() {
  // The plane is given a finite crown so that a lateral range exists; 20 m is flat at this scale.
  return {analytic::make_prismatic_surface(analytic::cylinder_chain(20.0, 2.5e-3)),
          analytic::make_revolved_surface(analytic::barrel_chain(kStandardRadius, 0.08), kStandardRadius), true, true};
}

Problem ball_problem() {
  Problem p;
  p.track.gauge_based = false;
  p.track.rail_y0 = 0.75;
  p.wheelset = {1.360, -0.070, kStandardRadius, std::nullopt};
  p.state.velocity = {10.0, 0.0, 0.0, 0.0, 0.0, -10.0 / kStandardRadius};
  p.discretisation.dx = p.discretisation.ds = 0.25e-3;
  p.regime = kalker::Regime::frictionless;
  return p;
}

TEST(Pair, VerticalForceOnABallAgreesWithHertz) {
  Pair pair(ball_on_plane());
  Problem p = ball_problem();
  const double force = 5e4;
  p.vertical_force = force;
  const PairSolution s = pair.solve(p);
  ASSERT_EQ(s.status, Status::ok) << s.message;
  ASSERT_EQ(s.patches.size(), 1u);
  EXPECT_NEAR(s.load.track.force.z(), force, 1e-4 * force);
  // Hertz (Johnson 1985, ch. 4): sphere of radius 0.46 m on a cylinder of 20 m; curvatures differ by 2.3 %: mean
  // radius.
  const double e_star = p.material.shear_modulus_1 / (1.0 - p.material.poisson_1);
  const double mean_radius = 1.0 / std::sqrt((1.0 / kStandardRadius) * (1.0 / kStandardRadius + 1.0 / 20.0));
  const double a = std::cbrt(3.0 * force * mean_radius / (4.0 * e_star));
  EXPECT_NEAR(s.patches[0].contact.max_pressure, 1.5 * force / (M_PI * a * a),
              5e-3 * s.patches[0].contact.max_pressure);
  EXPECT_NEAR(s.patches[0].approach, a * a / mean_radius, 5e-3 * s.patches[0].approach);
  EXPECT_NEAR(s.z, s.patches[0].approach, 1e-7);
  EXPECT_NEAR(s.patches[0].reference_rail.y(), 0.0, 1e-6);
}

TEST(Pair, PrescribedPositionGivesTheForceOfThePrescribedForce) {
  Pair pair(ball_on_plane());
  Problem p = ball_problem();
  p.vertical_force = 3e4;
  const PairSolution sought = pair.solve(p);
  p.vertical_force.reset();
  p.state.position.z = sought.z;
  const PairSolution given = pair.solve(p);
  EXPECT_NEAR(given.load.track.force.z(), sought.load.track.force.z(),
              p.solver.eps * 3e4);  // one starts cold, the other warm
}

TEST(Pair, NoContactIsAStatus) {
  Pair pair(ball_on_plane());
  Problem p = ball_problem();
  p.state.position.z = -1e-3;
  EXPECT_EQ(pair.solve(p).status, Status::no_contact);
  p.vertical_force = 1e4;
  p.state.position.y = 0.5;
  const PairSolution off = pair.solve(p);
  EXPECT_EQ(off.status, Status::no_contact);
  EXPECT_FALSE(off.message.empty());
}

TEST(Pair, LeftIsTheMirrorImageOfRight) {
  Pair pair(standard_geometry());
  Problem right = standard_problem();
  right.track.dy = 4e-4;
  right.track.roll = 1e-3;
  right.track.curvature = 1e-3;
  Problem left = right;
  left.side = Side::left;
  for (SixMotion* m : {&left.state.position, &left.state.velocity}) m->y = -m->y, m->roll = -m->roll, m->yaw = -m->yaw;
  left.track.dy = -left.track.dy;
  left.track.roll = -left.track.roll;
  left.track.curvature = -left.track.curvature;
  const PairSolution r = pair.solve(right), l = pair.solve(left);
  ASSERT_EQ(r.status, Status::ok) << r.message;
  ASSERT_EQ(l.patches.size(), r.patches.size());
  EXPECT_EQ(l.z, r.z);
  EXPECT_EQ(l.load.track.force.x(), r.load.track.force.x());
  EXPECT_EQ(l.load.track.force.y(), -r.load.track.force.y());
  EXPECT_EQ(l.load.track.force.z(), r.load.track.force.z());
  EXPECT_EQ(l.load.track.moment.y(), r.load.track.moment.y());
  EXPECT_EQ(l.load.track.moment.x(), -r.load.track.moment.x());
  EXPECT_EQ(l.patches[0].frame.X_TC.origin.y(), -r.patches[0].frame.X_TC.origin.y());
  EXPECT_EQ(l.patches[0].frame.angle, -r.patches[0].frame.angle);
  EXPECT_EQ(l.patches[0].kinematics.eta, -r.patches[0].kinematics.eta);
  const Grid2 g = r.patches[0].grid;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix)
      ASSERT_EQ(l.patches[0].contact.pressure[g.index(ix, iy)],
                r.patches[0].contact.pressure[g.index(ix, g.ny - 1 - iy)]);
}

TEST(Pair, MovingTrackAndWheelsetSidewaysChangesNothing) {
  Pair pair(standard_geometry());
  Problem here = standard_problem();
  here.track.gauge_based = false;
  here.track.rail_y0 = 0.7535;
  here.track.rail_z0 = 2e-4;
  Problem there = here;
  there.track.rail_y0 += 0.5;
  there.state.position.y += 0.5;
  const PairSolution a = pair.solve(here), b = pair.solve(there);
  ASSERT_EQ(a.status, Status::ok) << a.message;
  constexpr double kRounding = 1e-6;  // the force iteration stops within its tolerance
  // Curved or yawing track aside, creepages depend on where the wheelset centre is: it moved along.
  EXPECT_NEAR(b.load.track.force.x(), a.load.track.force.x(), 2e-4 * std::abs(a.load.track.force.z()));
  EXPECT_NEAR(b.z, a.z, kRounding * 1e-3);
  EXPECT_NEAR(b.patches[0].frame.X_TC.origin.y() - a.patches[0].frame.X_TC.origin.y(), 0.5, 1e-8);
  EXPECT_NEAR(b.patches[0].contact.max_pressure, a.patches[0].contact.max_pressure,
              1e-4 * a.patches[0].contact.max_pressure);
}

TEST(Pair, SolvingInAnyOrderGivesTheSameBits) {
  Problem a = standard_problem(), b = standard_problem();
  b.state.position.y = -2e-3;
  Pair first(standard_geometry()), second(standard_geometry());
  const PairSolution a1 = first.solve(a);
  second.solve(b);
  const PairSolution a2 = second.solve(a);
  EXPECT_EQ(a1.z, a2.z);
  EXPECT_EQ(a1.patches.at(0).contact.pressure, a2.patches.at(0).contact.pressure);
  EXPECT_EQ(a1.patches.at(0).contact.traction_x, a2.patches.at(0).contact.traction_x);
}

// Power balance of a steadily rolling wheel: what forces and spin moment do on the creepages is dissipated by friction.
// The rolling step convects tractions by one element, which costs energy in proportion to the element size.
TEST(Pair, FrictionDissipatesTheWorkOfTheCreepForces) {
  Pair pair(standard_geometry());
  const auto imbalance = [&](double element) {
    Problem problem = standard_problem();
    problem.discretisation.dx = problem.discretisation.ds = element;
    const PairSolution s = pair.solve(problem);
    EXPECT_EQ(s.status, Status::ok) << s.message;
    double work = 0.0, dissipated = 0.0;
    for (const PatchSolution& p : s.patches) {
      work += p.kinematics.velocity * (p.contact.force_x * p.kinematics.xi + p.contact.force_y * p.kinematics.eta +
                                       p.contact.moment_n * p.kinematics.phi);
      dissipated += p.contact.frictional_power;
    }
    EXPECT_LT(dissipated, 0.0);
    return std::abs(work / dissipated - 1.0);
  };
  const double coarse = imbalance(0.4e-3), fine = imbalance(0.2e-3);
  EXPECT_LT(fine, 0.65 * coarse) << "first order";
  EXPECT_LT(fine, 0.1);
}

TEST(Pair, RefusesWrongInput) {
  EXPECT_THROW(Pair({nullptr, standard_geometry().wheel, true, true}), Error);
  EXPECT_THROW(Pair({standard_geometry().wheel, standard_geometry().rail, true, true}), Error);
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  p.vertical_force = -5.0;
  EXPECT_THROW(pair.solve(p), Error);
  p = standard_problem();
  p.discretisation.dx = 0.0;
  EXPECT_THROW(pair.solve(p), Error);
  p = standard_problem();
  p.track.gauge_height = -1.0;
  EXPECT_THROW(pair.solve(p), Error);
}

}  // namespace
}  // namespace treadmark::wheelrail
