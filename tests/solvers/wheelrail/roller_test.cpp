// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/solvers/wheelrail/contact_program/coarse_search.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

// Wheels on rollers and in rings, from the surfaces to the forces.

namespace treadmark::wheelrail {
namespace {

constexpr double kWheel = 0.46, kRoller = 0.7;

/// A ball on a barrel whose crown is so wide that both principal curvatures are nearly the same, or in a ring.
Geometry ball_on(double radius, const std::string& backend = "analytic") {
  const NaturalSurface roller = create_natural({Body::rail, 0.0, analytic::cylinder_chain(20.0, 1e-3), {}, radius});
  Region region;
  region.u_min = -0.12, region.u_max = 0.12;
  const double resolution = backend == "mesh" ? 1e-3 : 0.0;
  return {represent(roller, {backend, resolution, region}).surface,
          analytic::make_revolved_surface(analytic::barrel_chain(kWheel, 0.08), kWheel), false, true};
}

Problem ball_on_roller(double radius, double speed = 10.0) {
  Problem p;
  p.roller = Roller{radius, speed / radius};
  p.track.gauge_based = false;
  p.track.rail_y0 = 0.75;
  p.wheelset = {1.360, -0.070, kWheel, std::nullopt};
  p.state.velocity.pitch = -speed / kWheel;
  p.vertical_force = 3e4;
  p.discretisation.dx = p.discretisation.ds = 0.3e-3;
  return p;
}

/// Approach and greatest pressure of an elliptic contact after Hertz (Johnson 1985, ch. 4), curvatures a, b of the gap
/// 1/2 (a x^2 + b y^2).
struct Hertz {
  double approach, pressure;
  Hertz(double a, double b, double force, double e_star) {
    // K and E by the arithmetic-geometric mean; the ratio of the semi-axes by bisection
    const auto integrals = [](double ratio, double& K, double& E) {
      double x = 1.0, g = ratio, sum = 0.5 * (1.0 - ratio * ratio), power = 0.5;
      for (int i = 0; i < 40; ++i) {
        const double c = 0.5 * (x - g), mean = 0.5 * (x + g);
        g = std::sqrt(x * g), x = mean, power *= 2.0, sum += power * c * c;
      }
      K = M_PI / (2.0 * x), E = K * (1.0 - sum);
    };
    const double low = std::min(a, b), high = std::max(a, b);
    double K = 0.0, E = 0.0, from = 1e-3, to = 1.0 - 1e-12;
    for (int i = 0; i < 100; ++i) {
      const double k = 0.5 * (from + to);  // b/a of the ellipse, b across the higher curvature
      integrals(k, K, E);
      const double curvature_ratio = (E / (k * k) - K) / (K - E);
      (curvature_ratio > high / low ? from : to) = k;
    }
    const double k = 0.5 * (from + to), e2 = 1.0 - k * k;
    integrals(k, K, E);
    const double long_axis = std::cbrt(3.0 * force * (K - E) / (M_PI * e_star * e2 * low));
    pressure = 1.5 * force / (M_PI * long_axis * long_axis * k);
    approach = pressure * k * long_axis * K / e_star;
  }
};

TEST(RollerContact, IsThatOfHertzWithTheSumOfCurvatures) {
  for (const double radius : {kRoller, -kRoller})
    for (const std::string backend : {"analytic", "spline", "mesh"}) {
      SCOPED_TRACE(backend + " " + std::to_string(radius));
      Problem p = ball_on_roller(radius);
      p.regime = kalker::Regime::frictionless;
      const PairSolution s = Pair(ball_on(radius, backend)).solve(p);
      ASSERT_EQ(s.status, Status::ok) << s.message;
      ASSERT_EQ(s.patches.size(), 1u);
      const double e_star = p.material.shear_modulus_1 / (1.0 - p.material.poisson_1);
      const Hertz exact(1.0 / kWheel + 1.0 / radius, 1.0 / kWheel + 1.0 / 20.0, 3e4, e_star);
      EXPECT_NEAR(s.patches[0].contact.max_pressure / exact.pressure, 1.0, 8e-3);
      EXPECT_NEAR(s.patches[0].approach / exact.approach, 1.0, 5e-3);
      EXPECT_NEAR(s.load.track.force.z(), 3e4, 5.0);
    }
}

TEST(RollerContact, NominalCirclesRollOnEachOther) {
  for (const double radius : {kRoller, -kRoller})
    for (const double speed : {10.0, -10.0}) {
      const Problem p = ball_on_roller(radius, speed);
      const PairSolution s = Pair(ball_on(radius)).solve(p);
      ASSERT_EQ(s.status, Status::ok) << s.message;
      const ContactKinematics& k = s.patches.at(0).kinematics;
      EXPECT_NEAR(k.velocity, 10.0, 1e-3);
      EXPECT_NEAR(k.chi, speed > 0.0 ? 0.0 : M_PI, 1e-12);
      EXPECT_LE(std::abs(k.xi), 3.0 * s.patches[0].approach / kWheel);
      EXPECT_NEAR(k.eta, 0.0, 1e-9);
      EXPECT_LE(std::abs(s.load.track.force.x()), 0.1 * 0.3 * 3e4);
    }
}

Geometry s1002_on(double roller_radius) {
  const NaturalSurface rail = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}, roller_radius});
  return {rail.surface, analytic::make_standard_surface({"S1002"}, Body::wheel, kWheel), roller_radius == 0.0, true};
}

Problem s1002_problem() {
  Problem p;
  p.state.position = {0.0, 1.5e-3, 0.0, 2e-4, 1e-3, 0.0};
  p.state.velocity.pitch = -10.0 / kWheel * 0.9995;
  p.vertical_force = 6e4;
  p.discretisation.dx = p.discretisation.ds = 0.8e-3;
  return p;
}

TEST(RollerContact, AVeryLargeRollerOrRingIsARail) {
  Problem on_rail = s1002_problem();
  on_rail.state.velocity.x = 10.0;
  const PairSolution rail = Pair(s1002_on(0.0)).solve(on_rail);
  ASSERT_EQ(rail.status, Status::ok) << rail.message;
  for (const double radius : {1e4, -1e4}) {
    Problem p = s1002_problem();
    p.roller = Roller{radius, 10.0 / radius};
    const PairSolution s = Pair(s1002_on(radius)).solve(p);
    ASSERT_EQ(s.status, Status::ok) << s.message;
    ASSERT_EQ(s.patches.size(), rail.patches.size());
    EXPECT_LE((s.load.track.force - rail.load.track.force).norm(), 1e-3 * rail.load.track.force.head<2>().norm() + 6.0)
        << radius;
  }
}

TEST(RollerContact, LeftIsTheMirrorImageOfRight) {
  for (const double radius : {kRoller, -kRoller}) {
    Problem right = s1002_problem();
    right.roller = Roller{radius, 10.0 / radius};
    Problem left = right;
    left.side = Side::left;
    left.state.position.y *= -1.0, left.state.position.roll *= -1.0, left.state.position.yaw *= -1.0;
    const Geometry geometry = s1002_on(radius);
    const PairSolution r = Pair(geometry).solve(right), l = Pair(geometry).solve(left);
    ASSERT_EQ(r.status, Status::ok) << r.message;
    EXPECT_LE((l.load.track.force - Vec3(1.0, -1.0, 1.0).cwiseProduct(r.load.track.force)).norm(), 1e-9 * 6e4);
  }
}

TEST(RollerContact, TheReferenceMeshCutsRailsIntoSectionsNotRollers) {
  for (const double radius : {0.0, kRoller}) {
    const Geometry geometry = s1002_on(radius);
    Problem p = s1002_problem();
    p.solver.conventions = Conventions::contact;
    if (radius != 0.0) p.roller = Roller{radius, 10.0 / radius};
    EXPECT_EQ(distance_mesh(p)->rail_sections, radius == 0.0);
  }
}

TEST(RollerContact, LiesBetweenTheAxles) {
  for (const double radius : {kRoller, -2.0}) {
    Problem p = ball_on_roller(radius);
    p.regime = kalker::Regime::frictionless;
    p.state.position.x = 8e-3;
    const PairSolution s = Pair(ball_on(radius)).solve(p);
    ASSERT_EQ(s.status, Status::ok) << s.message;
    EXPECT_NEAR(s.patches.at(0).frame.X_TC.origin.x(), 8e-3 * radius / (radius + kWheel), 1e-5) << radius;
  }
}

/// A surface of revolution turns about its own axle: roller, wheelset and all tilted together touch as before.
TEST(RollerContact, IsTheSameTiltedWithItsWheelset) {
  constexpr double kTilt = 0.05;
  const Mat3 tilt = rotation_x(kTilt);
  for (const double radius : {kRoller, -kRoller}) {
    SCOPED_TRACE(radius);
    Problem p = ball_on_roller(radius);
    p.vertical_force.reset();
    p.state.position.y = 5e-3, p.state.position.z = 6e-5;
    p.track.vroll = 0.02;
    p.state.velocity.pitch *= 0.999;
    Problem tilted = p;
    const Vec3 rail = tilt * Vec3(0.0, p.track.rail_y0, p.track.rail_z0),
               axle = tilt * Vec3(0.0, p.state.position.y, p.state.position.z - kWheel);
    tilted.track.rail_y0 = rail.y(), tilted.track.rail_z0 = rail.z(), tilted.track.roll = kTilt;
    tilted.state.position.y = axle.y(), tilted.state.position.z = axle.z() + kWheel, tilted.state.position.roll = kTilt;
    const PairSolution level = Pair(ball_on(radius)).solve(p), other = Pair(ball_on(radius)).solve(tilted);
    ASSERT_EQ(level.status, Status::ok) << level.message;
    ASSERT_EQ(other.status, Status::ok) << other.message;
    const PatchSolution &a = level.patches.at(0), &b = other.patches.at(0);
    ASSERT_GT(a.contact.force_n, 1e3);
    EXPECT_NEAR(b.contact.force_n / a.contact.force_n, 1.0, 1e-3);
    EXPECT_NEAR(b.kinematics.xi, a.kinematics.xi, 1e-7);
    EXPECT_NEAR(b.kinematics.eta, a.kinematics.eta, 1e-7);
    EXPECT_NEAR(b.kinematics.phi, a.kinematics.phi, 1e-5);  // [rad/m]; 0.07 if the axle stayed level
    EXPECT_NEAR(b.contact.force_x / a.contact.force_x, 1.0, 2e-3);
  }
}

/// As roll is about the origin of the profile, so is its rate.
TEST(RollerContact, RollsAboutTheOriginOfItsProfile) {
  const Geometry geometry = ball_on(kRoller);
  Problem p = ball_on_roller(kRoller, 0.0);
  constexpr double kStep = 1e-4;
  const Vec3 point_R(0.0, 0.01, 0.002);
  Problem before = p, after = p;
  before.track.roll = -kStep, after.track.roll = kStep;
  p.track.vroll = 1.0;
  const Placement placed = place(geometry, p);
  const Vec3 moved = place(geometry, after).X_TR.apply(point_R) - place(geometry, before).X_TR.apply(point_R);
  EXPECT_LE((material_velocity(p, placed).rail.at(placed.X_TR.apply(point_R)) - moved / (2.0 * kStep)).norm(), 1e-9);
}

TEST(RollerContact, AForceLengthwiseIsFound) {
  for (const double radius : {kRoller, -kRoller}) {
    Problem p = ball_on_roller(radius);
    p.longitudinal_force = 2e3;
    const PairSolution s = Pair(ball_on(radius)).solve(p);
    ASSERT_EQ(s.status, Status::ok) << s.message;
    EXPECT_NEAR(s.load.track.force.x(), 2e3, 10.0);
    EXPECT_NEAR(s.load.track.force.z(), 3e4, 10.0);
  }
}

}  // namespace
}  // namespace treadmark::wheelrail
