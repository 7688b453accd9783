// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "small_vehicles.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/solvers/vehicle/contacts/full_contact.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kWheelRadius = 0.46;

wheelrail::Geometry bodies(bool flat) {
  SurfaceSpec rail{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  SurfaceSpec wheel{Body::wheel, kWheelRadius, StandardProfile{"S1002"}, {}};
  if (flat) wheel.defects.flats = {{.length = 0.10, .depth = 0.9e-3, .theta_center = 0.0, .y_center = 0.006}};
  return {create_surface(rail), create_surface(wheel), true, !flat};
}

wheelrail::Problem prototype(wheelrail::Side side, kalker::Regime regime, double element = 1e-3) {
  wheelrail::Problem p;
  p.side = side;
  p.track.cant = 1.0 / 40.0;
  p.wheelset.nominal_radius = kWheelRadius;
  p.regime = regime;
  p.discretisation.dx = p.discretisation.ds = element;
  return p;
}

PairMotion rolling(double speed, double z, double pitch = 1.0) {
  PairMotion m;
  m.wheelset.z = z;
  m.wheelset.pitch = pitch;
  m.wheelset_velocity.x = speed;
  m.wheelset_velocity.pitch = -speed / kWheelRadius * 1.001;
  return m;
}

/// Power of the reaction on both bodies, from velocities of the points at which it acts.
double power(const ContactReaction& r, const PairMotion& m) {
  const auto& v = m.wheelset_velocity;
  const Vec3 pitch_axis = (rotation_x(m.wheelset.roll) * rotation_z(m.wheelset.yaw)).col(1);
  const Vec3 spin = v.roll * Vec3::UnitX() + v.yaw * rotation_x(m.wheelset.roll).col(2) + v.pitch * pitch_axis;
  return r.on_wheelset.force.dot(Vec3(v.x, v.y, v.z)) + r.on_wheelset.moment.dot(spin) +
         r.on_rail.force.y() * m.rail.vy + r.on_rail.force.z() * m.rail.vz + r.on_rail.moment.x() * m.rail.vroll;
}

TEST(FullContact, IsTheSolutionOfAPair) {
  FullContact element(bodies(false), prototype(wheelrail::Side::right, kalker::Regime::steady));
  const PairMotion m = rolling(20.0, 2.8e-4);
  const ContactReaction r = element.evaluate(m);
  ASSERT_EQ(r.status, Status::ok) << r.message;

  wheelrail::Pair pair(bodies(false));
  wheelrail::Problem p = prototype(wheelrail::Side::right, kalker::Regime::steady);
  p.state.position = m.wheelset;
  p.state.velocity = m.wheelset_velocity;
  const wheelrail::PairSolution plane = pair.solve(p);
  p.surface_loads = true;
  const wheelrail::PairSolution s = pair.solve(p);
  const double load = s.load.track.force.z();
  // On the tread the normals of the surfaces are nearly that of the contact plane.
  EXPECT_LT((s.load.track.force - plane.load.track.force).norm(), 1e-3 * load);
  EXPECT_LT((r.on_rail.force - s.load.track.force).norm(), 1e-6 * load);
  Vec3 force = Vec3::Zero(), about_rail = Vec3::Zero(), about_axle = Vec3::Zero();
  for (const auto& patch : s.patches) {
    const auto& [origin, rotation] = patch.frame.X_TC;
    const Vec3 on_rail = rotation * patch.surface_loads->rail.force;
    force += on_rail;
    about_rail += rotation * patch.surface_loads->rail.moment + (origin - s.placement.X_TR.origin).cross(on_rail);
    about_axle += rotation * patch.surface_loads->wheel.moment + (origin - s.placement.X_TWs.origin).cross(on_rail);
  }
  EXPECT_LT((r.on_rail.force - force).norm(), 1e-6 * load);
  EXPECT_LT((r.on_wheelset.force + force).norm(), 1e-6 * load);
  EXPECT_LT((r.on_rail.moment - about_rail).norm(), 1e-6 * load);
  EXPECT_LT((r.on_wheelset.moment + about_axle).norm(), 1e-6 * load);
}

TEST(FullContact, FrictionIsThatOfItsPlaceAlongTheRail) {
  FrictionLaw high, low;
  high.kinetic = 0.3, low.kinetic = 0.05;
  FullContact element(bodies(false), prototype(wheelrail::Side::left, kalker::Regime::steady), 0.2, 0.0,
                      {{0.0, 0.5, 0.55}, {high, high, low}, 0.2});
  PairMotion m = rolling(20.0, 2.8e-4);
  m.wheelset_velocity.pitch *= 0.9;  // slides all over: friction carries what it can
  ContactReaction r;
  for (const auto& [travelled, coefficient] : {std::pair{0.1, 0.3}, {0.34, 0.1}, {0.6, 0.05}, {0.325, 0.175}}) {
    m.wheelset.x = travelled;
    r = element.evaluate(m);
    ASSERT_EQ(r.status, Status::ok) << r.message;
    const double bound = coefficient * r.normal_force;
    EXPECT_NEAR(std::hypot(r.longitudinal_creep_force, r.lateral_creep_force), bound, 0.01 * bound) << travelled;
  }
  // What was accepted is solved again with the friction that it had.
  element.accept();
  m.wheelset.x = 5.0;
  element.evaluate(m);
  const wheelrail::PairSolution again = element.repeat(element.accepted());
  EXPECT_LT((again.load.track.force - r.on_rail.force).norm(), 1e-9 * r.normal_force);
}

TEST(FullContact, SidesAreMirrorImages) {
  FullContact right(bodies(false), prototype(wheelrail::Side::right, kalker::Regime::steady));
  FullContact left(bodies(false), prototype(wheelrail::Side::left, kalker::Regime::steady));
  PairMotion m = rolling(20.0, 2.8e-4), mirrored = m;
  m.wheelset.y = 1e-3, mirrored.wheelset.y = -1e-3;
  m.wheelset.yaw = 1e-3, mirrored.wheelset.yaw = -1e-3;
  m.rail.roll = 5e-4, mirrored.rail.roll = -5e-4;
  m.rail.y = 2e-4, mirrored.rail.y = -2e-4;
  m.rail.vy = 0.01, mirrored.rail.vy = -0.01;
  const ContactReaction r = right.evaluate(m), l = left.evaluate(mirrored);
  EXPECT_GT(r.normal_force, 1e4);
  EXPECT_DOUBLE_EQ(r.on_rail.force.y(), -l.on_rail.force.y());
  EXPECT_DOUBLE_EQ(r.on_rail.force.z(), l.on_rail.force.z());
  EXPECT_DOUBLE_EQ(r.on_rail.moment.x(), -l.on_rail.moment.x());
  EXPECT_NEAR(r.on_wheelset.moment.x(), -l.on_wheelset.moment.x(), 1e-9 * r.normal_force);
  EXPECT_NEAR(r.on_wheelset.moment.y(), l.on_wheelset.moment.y(), 1e-9 * r.normal_force);
  EXPECT_NEAR(r.contact_y, -l.contact_y, 1e-12);
}

/// The work on both bodies is that of creepage and spin on forces and moment; what slip and tractions of the elements
/// dissipate tends to it with their size.
TEST(FullContact, SteadyRollingDissipatesWhatItTakes) {
  PairMotion m = rolling(20.0, 2.8e-4);
  m.wheelset.yaw = 2e-3;
  std::vector<double> missing;
  for (const double element : {1e-3, 0.5e-3, 0.25e-3}) {
    FullContact contact(bodies(false), prototype(wheelrail::Side::right, kalker::Regime::steady, element));
    const ContactReaction r = contact.evaluate(m);
    ASSERT_EQ(r.status, Status::ok);
    contact.accept();
    double creep_power = 0.0, elements = 0.0;
    for (const wheelrail::PatchSolution& patch : contact.repeat(contact.accepted()).patches) {
      const auto& k = patch.kinematics;
      creep_power -= k.velocity * (k.xi * patch.force_C.x() + k.eta * patch.force_C.y() + k.phi * patch.moment_C.z());
      elements -= patch.contact.frictional_power;
    }
    EXPECT_GT(r.frictional_power, 100.0);
    EXPECT_NEAR(r.frictional_power, creep_power, 1e-9 * creep_power);
    EXPECT_NEAR(-power(r, m), creep_power, 1e-4 * creep_power);
    missing.push_back(std::abs(creep_power - elements));
  }
  EXPECT_LT(missing[1], 0.7 * missing[0]);
  EXPECT_LT(missing[2], 0.7 * missing[1]);
}

/// A right wheel that stands aside under a load, and how steep its contact is.
struct Aside {
  PairMotion motion;
  double steepest = 0.0;
};
Aside aside(double y, double yaw, double load = 55e3) {
  wheelrail::Pair pair(bodies(false));
  wheelrail::Problem p = prototype(wheelrail::Side::right, kalker::Regime::frictionless, 0.5e-3);
  Aside at{rolling(10.0, 0.0), 0.0};
  at.motion.wheelset.y = y;
  at.motion.wheelset.yaw = yaw;
  p.state.position = at.motion.wheelset;
  p.state.velocity = at.motion.wheelset_velocity;
  p.vertical_force = load;
  const wheelrail::PairSolution s = pair.solve(p);
  EXPECT_EQ(s.status, Status::ok) << s.message;
  at.motion.wheelset.z = s.z;
  for (const auto& patch : s.patches) at.steepest = std::max(at.steepest, std::abs(patch.frame.angle));
  return at;
}

/// Virtual work: what the bodies lose to a contact that rolls on steadily is what friction takes, at any contact angle
/// and yaw; pressures do no work.
TEST(FullContact, PressuresDoNoWorkAtFlanges) {
  constexpr double kBalanced = 1e-6;
  double steepest = 0.0;
  for (const double y : {0.0, 4e-3, 6e-3, 6.3e-3, 6.6e-3, 7e-3, 8e-3, 10e-3})
    for (const double yaw : {0.0, -15e-3, 15e-3, 40e-3}) {
      const Aside at = aside(y, yaw);
      steepest = std::max(steepest, at.steepest);
      wheelrail::Problem p = prototype(wheelrail::Side::right, kalker::Regime::steady, 0.5e-3);
      p.tangential_model = kalker::TangentialModel::fastsim;
      FullContact contact(bodies(false), p);
      const ContactReaction r = contact.evaluate(at.motion);
      ASSERT_NE(r.status, Status::no_contact);
      EXPECT_NEAR(-power(r, at.motion), r.frictional_power, kBalanced * r.frictional_power)
          << "y = " << y << ", yaw = " << yaw << ", angle " << at.steepest;
      EXPECT_LT((r.on_wheelset.force + r.on_rail.force).norm(), 1e-9 * r.normal_force);
    }
  EXPECT_GT(steepest, 65.0 / 180.0 * std::numbers::pi);
}

TEST(FullContact, SlipOfTheSurfacesDoesItsWorkToo) {
  for (const auto reference : {ReferenceSurface::plane_surface_slip, ReferenceSurface::curved})
    for (const double y : {6.2e-3, 7e-3}) {
      const Aside at = aside(y, 15e-3);
      wheelrail::Problem p = prototype(wheelrail::Side::right, kalker::Regime::steady, 0.5e-3);
      p.reference_surface = reference;
      FullContact contact(bodies(false), p);
      const ContactReaction r = contact.evaluate(at.motion);
      ASSERT_EQ(r.status, Status::ok) << r.message;
      EXPECT_NEAR(-power(r, at.motion), r.frictional_power, 1e-6 * r.frictional_power);
      contact.accept();
      double elements = 0.0;
      for (const auto& patch : contact.repeat(contact.accepted()).patches) elements -= patch.contact.frictional_power;
      constexpr double kLastStep = 0.02;  // in which material leaves the contact, with these elements
      EXPECT_NEAR(elements, r.frictional_power, kLastStep * r.frictional_power);
    }
}

/// Contact that goes round the gauge corner: the resultant leans as that of pressures along local normals.
TEST(FullContact, PressureLeansAsInConformalContact) {
  const Aside at = aside(6.4e-3, 15e-3);
  std::vector<double> lean;
  for (const auto reference : {ReferenceSurface::plane, ReferenceSurface::curved}) {
    wheelrail::Problem p = prototype(wheelrail::Side::right, kalker::Regime::frictionless, 0.25e-3);
    p.reference_surface = reference;
    FullContact contact(bodies(false), p);
    const ContactReaction r = contact.evaluate(at.motion);
    ASSERT_NE(r.status, Status::no_contact);
    lean.push_back(std::atan2(r.on_rail.force.y(), r.on_rail.force.z()));
  }
  EXPECT_NEAR(lean[0], lean[1], 2e-3);  // along the normal of the plane 0.017 more
}

/// Along a curve the rail has turned where a yawed flange touches ahead of the axle.
TEST(FullContact, PressuresDoNoWorkInACurve) {
  constexpr double kCurvature = 1.0 / 150.0, kBalanced = 1e-6;
  for (const double y : {6.3e-3, 7e-3})
    for (const double yaw : {20e-3, -15e-3})
      for (const auto side : {wheelrail::Side::right, wheelrail::Side::left}) {
        Aside at = aside(y, yaw);
        PairMotion& m = at.motion;
        const double mirrored = side == wheelrail::Side::left ? -1.0 : 1.0;
        m.wheelset.y *= mirrored;
        m.wheelset.yaw *= mirrored;
        m.curvature = mirrored * kCurvature;
        m.wheelset_velocity.yaw = m.curvature * m.wheelset_velocity.x;
        FullContact contact(bodies(false), prototype(side, kalker::Regime::steady, 0.5e-3));
        const ContactReaction r = contact.evaluate(m);
        ASSERT_NE(r.status, Status::no_contact);
        EXPECT_NEAR(-power(r, m), r.frictional_power, kBalanced * r.frictional_power)
            << y << ' ' << yaw << ' ' << mirrored;
      }
}

TEST(FullContact, TrialsLeaveTheAcceptedInstantAlone) {
  const auto make = [] {
    return FullContact(bodies(true), prototype(wheelrail::Side::right, kalker::Regime::transient));
  };
  FullContact disturbed = make(), plain = make();
  PairMotion m = rolling(20.0, 2.8e-4, 0.12);
  const double dx = 1e-3;
  for (int i = 0; i < 30; ++i) {
    if (i > 0) {
      PairMotion other = m;
      other.wheelset.z += 4e-5;
      other.wheelset.x += dx;
      disturbed.evaluate(other);
      other.wheelset.z -= 3e-3;
      disturbed.evaluate(other);
    }
    const ContactReaction a = disturbed.evaluate(m), b = plain.evaluate(m);
    ASSERT_EQ(a.on_rail.force, b.on_rail.force) << i;
    ASSERT_EQ(a.least_gap, b.least_gap);
    disturbed.accept();
    plain.accept();
    m.wheelset.x += dx;
    m.wheelset.pitch -= dx / kWheelRadius;
    m.wheelset.y += 2e-6;
  }
}

TEST(FullContact, StepsNearTheUsualOneGiveTheForcesOfAnyOther) {
  const double dx = 1e-3;
  const auto make = [](double usual_travel) {
    return FullContact(bodies(true), prototype(wheelrail::Side::right, kalker::Regime::transient), 0.0, usual_travel);
  };
  FullContact interpolated = make(dx), at_the_limit = make(dx / 1.0019), evaluated = make(0.0), far = make(1.1 * dx);
  PairMotion m = rolling(20.0, 2.8e-4, 0.17);
  double most = 0.0;
  for (int i = 0; i < 30; ++i) {
    const ContactReaction r = evaluated.evaluate(m);
    const double scale = r.normal_force;
    ASSERT_GT(scale, 1e3);
    ASSERT_EQ(far.evaluate(m).on_rail.force, r.on_rail.force) << i;
    for (FullContact* other : {&interpolated, &at_the_limit}) {
      const double difference = (other->evaluate(m).on_rail.force - r.on_rail.force).norm();
      ASSERT_LT(difference, 1e-7 * scale) << i;
      most = std::max(most, difference);
    }
    for (FullContact* contact : {&interpolated, &at_the_limit, &evaluated, &far}) contact->accept();
    m.wheelset.x += dx * (1.0 + 5e-4 * std::sin(i));
    m.wheelset.pitch -= dx / kWheelRadius;
    m.wheelset.y += 2e-6;
  }
  EXPECT_GT(most, 0.0);
}

TEST(FullContact, AnInstantCanBeSolvedAgainAlsoInAnotherProcess) {
  const auto make = [] {
    return FullContact(bodies(true), prototype(wheelrail::Side::right, kalker::Regime::transient));
  };
  FullContact element = make();
  PairMotion m = rolling(20.0, 2.8e-4, 0.12);
  ContactReaction last;
  ByteWriter state, instant;
  for (int i = 0; i < 20; ++i) {
    last = element.evaluate(m);
    element.accept();
    m.wheelset.x += 7e-4;
    m.wheelset.pitch -= 7e-4 / kWheelRadius;
  }
  element.save(state);
  FullContact::write(element.accepted(), instant);
  const ContactReaction next = element.evaluate(m);

  FullContact other = make();
  ByteReader read_state(state.bytes()), read_instant(instant.bytes());
  other.restore(read_state);
  EXPECT_TRUE(read_state.at_end());
  const wheelrail::PairSolution again = other.repeat(FullContact::read(read_instant));
  EXPECT_EQ(again.load.track.force, last.on_rail.force);
  EXPECT_EQ(other.evaluate(m).on_rail.force, next.on_rail.force);
}

/// A wheel pressed onto the rail so that it rolls without leaving it, slowly: its centre follows the flat. Chord flats
/// of a rigid wheel drop it by (x + L/2)^2/(2 R) on the way in (Newton and Clark 1979).
TEST(FullContact, SlowlyOverAChordFlatTheWheelDropsAsGeometrySays) {
  // Light load, so that the bodies are nearly rigid. Elements pass the edge of the flat at 100 Hz: the wheelset bounces
  // on its contacts three times as fast, and its damper takes what remains of that.
  SurfaceSpec rail{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  SurfaceSpec wheel{Body::wheel, kWheelRadius, StandardProfile{"S1002"}, {}};
  constexpr double kLength = 0.04, kLoad = 400.0, kDepth = kLength * kLength / (8.0 * kWheelRadius), kMass = 100.0;
  WheelFlat flat;
  flat.shape = WheelFlat::Shape::fresh;
  flat.length = kLength;
  wheel.defects.flats = {flat};
  const wheelrail::Geometry geometry{create_surface(rail), create_surface(wheel), true, false};
  VehicleModel model = wheel_on_mass(kMass, 0.01, 1e3, 0.0);
  model.springs.push_back(spring("wheelset", kGround, {0, 0, -0.46}, {}, {0, 0, 3e4, 0, 0, 0}));
  VehicleOnTrack v;
  constexpr double kSpeed = 0.05;
  v.system = assemble(model, {}, kSpeed, 2.0 * kLoad / kMass);
  v.speed = kSpeed;
  v.pitch_at_start = {0.05};
  for (const auto side : {wheelrail::Side::left, wheelrail::Side::right}) {
    const wheelrail::Problem p = prototype(side, kalker::Regime::frictionless, 0.5e-3);
    v.wheels.push_back({0, side, side == wheelrail::Side::left ? "left" : "right",
                        std::make_shared<FullContact>(geometry, p), rail_marker_at_rest(geometry, p)});
  }
  v.connect();
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  SimulationSettings settings;
  settings.duration = 0.046 / kSpeed;
  settings.max_step = 5e-3;
  settings.max_travel = 0.5e-3;
  Simulation s(v, e.state, settings);
  double worst = 0.0, deepest = 0.0;
  const double z0 = s.state().q[1];
  while (!s.finished()) {
    s.advance();
    // Pivoting about an edge of the flat, the wheel's centre falls by half the square of the way it is off the edge.
    const double x = std::abs(kSpeed * s.state().time - 0.05 * kWheelRadius), drop = s.state().q[1] - z0;
    const double rigid = x < 0.5 * kLength ? (0.5 * kLength - x) * (0.5 * kLength - x) / (2.0 * kWheelRadius) : 0.0;
    worst = std::max(worst, std::abs(drop - rigid));
    deepest = std::max(deepest, drop);
  }
  EXPECT_GT(deepest, 0.9 * kDepth);
  EXPECT_LT(worst, 0.02 * kDepth);
}

}  // namespace
}  // namespace treadmark::vehicle
