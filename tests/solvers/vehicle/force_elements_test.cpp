// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/force_elements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "small_vehicles.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark::vehicle {
namespace {

using std::numbers::pi;

constexpr double kRail = 9e10;                         // of Hertz' springs [N/m^1.5]
constexpr double kSpeedOn = 20.0;                      // [m/s]
constexpr double kMassOfSlider = 1000.0, kPull = 1e5;  // [kg], [N/m]

/// A wheelset below a mass, and beside them a body that slides along x and hangs on the ground by a spring.
VehicleModel with_slider() {
  VehicleModel v = wheel_on_mass(1800.0, 9000.0, 2e6, 1e4);
  v.bodies.push_back(body("slider", kMassOfSlider, {1, 1, 1}, {3, 0, -1}, {true, false, false, false, false, false}));
  v.springs.push_back(spring(kGround, "slider", {3, 0, -1}, {kPull, 0, 0, 0, 0, 0}));
  return v;
}

DryFrictionSpec rubbing(std::string a, std::string b, Vec3 position, Freedom direction) {
  DryFrictionSpec f;
  f.name = "friction";
  f.body_a = std::move(a);
  f.body_b = std::move(b);
  f.position = position;
  f.directions[static_cast<std::size_t>(direction)] = true;
  return f;
}

VehicleOnTrack with_line(const VehicleModel& model, const std::function<void(LineSetup&)>& change) {
  VehicleOnTrack v = on_hertz_springs(model, {}, kSpeedOn, kRail);
  LineSetup setup;
  setup.gravity = kGravity;
  setup.speed = constant_speed(kSpeedOn);
  change(setup);
  v.line = std::make_shared<const LineEffects>(v.system, std::move(setup));
  return v;
}

int place_of(const Multibody& s, const std::string& name) {
  for (int i = 0; i < s.size(); ++i)
    if (s.coordinates[static_cast<std::size_t>(i)].name == name) return i;
  ADD_FAILURE() << "no coordinate " << name;
  return 0;
}

SystemState at_rest(const VehicleOnTrack& v) {
  const Equilibrium e = find_equilibrium(v);
  EXPECT_EQ(e.report.status, Status::ok) << e.report.message;
  return e.state;
}

SimulationSettings steps_of(double duration, double step) {
  SimulationSettings s = equal_steps(duration, step);
  s.max_travel = 10.0;
  return s;
}

/// What the time integration lost over what was turned over.
double lost(const Simulation& s) {
  return std::abs(s.energy().integration_error(s.energy_at_start())) / s.energy().turnover;
}
constexpr double kMostLost = 1e-4;

TEST(ForceCurve, GoesThroughItsPointsAndHasAPotential) {
  const ForceCurve falls{{0.0, 0.01, 0.02, 0.03}, {0.0, 400.0, 100.0, 500.0}},
      one_way{{-0.02, 0.0, 0.03}, {-50.0, 0.0, 6000.0}, false};
  EXPECT_NEAR(value_at(falls, 0.015).force, 250.0, 1e-9);
  EXPECT_NEAR(value_at(falls, -0.015).force, -250.0, 1e-9);
  EXPECT_NEAR(value_at(falls, 0.015).slope, -3e4, 1e-6);
  EXPECT_NEAR(value_at(one_way, -0.04).force, -100.0, 1e-9);
  EXPECT_NEAR(value_at(one_way, 0.06).force, 12000.0, 1e-9);
  EXPECT_NEAR(value_at(one_way, 0.0).integral, 0.0, 1e-12);
  for (const ForceCurve& c : {falls, one_way})
    for (const double u : {0.004, 0.017, 0.06, -0.013, -0.05}) {
      constexpr double h = 1e-7;
      EXPECT_NEAR((value_at(c, u + h).integral - value_at(c, u - h).integral) / (2 * h), value_at(c, u).force, 1e-3);
      EXPECT_NEAR((value_at(c, u + h).force - value_at(c, u - h).force) / (2 * h), value_at(c, u).slope, 1e-1);
    }
}

/// Friction in x and y with a bound of 300 N, pressed less as column 2 grows.
ForceElements in_a_plane() {
  ForceElements e;
  e.columns.resize(3);
  DryFriction f;
  f.directions = 2;
  f.stiffness = 1e6;
  f.damping = 2e3;
  f.coefficient = {0.3, 0.3};
  f.normal_force = 1000.0;
  f.load = 2;
  f.by_load = -1e5;
  e.frictions.push_back(f);
  return e;
}

TEST(DryFriction, SlidesInThePlaneAgainstTheMotion) {
  const ForceElements e = in_a_plane();
  Vector memory = e.fresh_memory(), u = Vector::Zero(3);
  const Vector still = Vector::Zero(3);
  // Once round a circle of 10 mm, by steps of a thousandth of it: the force points against the motion, as large as it
  // may be.
  for (int i = 1; i <= 1000; ++i) {
    const double angle = 2.0 * pi * i / 1000.0;
    u << 0.01 * std::cos(angle) - 0.01, 0.01 * std::sin(angle), 0.0;
    const ElementResponse r = respond(e, u, still, memory);
    memory = r.memory;
    if (i < 200) continue;
    EXPECT_NEAR(r.force.head<2>().norm(), 300.0, 1e-9);
    const double along = std::atan2(r.force[1], r.force[0]), way = angle + pi / 2.0;
    EXPECT_NEAR(std::remainder(along - way, 2.0 * pi), 0.0, 0.04);  // 0.3 mm of its spring on 10 mm
  }
  // Lifted off it bears nothing.
  u[2] = 0.02;
  EXPECT_EQ(respond(e, u, still, memory).force.norm(), 0.0);
}

TEST(DryFriction, DoesNotSlideBackForWhatItsDamperBears) {
  ForceElements e;
  e.columns.resize(1);
  DryFriction f;
  f.stiffness = 1e7;
  f.damping = 2e4;
  f.coefficient = {0.3, 0.3};
  f.normal_force = 1e4;
  e.frictions.push_back(f);
  Vector u(1), v(1);
  u << 2.7e-4;
  v << 0.02;
  // Spring and damper, 2700 N and 400 N, are beyond the bound, the spring alone is not.
  const ElementResponse broken = respond(e, u, v, e.fresh_memory());
  EXPECT_NEAR(broken.force[0], 3000.0, 1e-9);
  EXPECT_EQ(broken.memory[0], 0.0);
  EXPECT_EQ(broken.memory[1], 1.0);
  u << 6e-4;
  EXPECT_NEAR(respond(e, u, v, broken.memory).memory[0], 3e-4, 1e-12);
}

TEST(DryFriction, TangentsAreDerivatives) {
  const ForceElements e = in_a_plane();
  Random random(3);
  int slid = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Vector u(3), v(3), memory = e.fresh_memory();
    for (int c = 0; c < 3; ++c) {
      u[c] = (c < 2 ? 1e-3 : 5e-3) * (random.uniform() - 0.5);
      v[c] = 0.1 * (random.uniform() - 0.5);
    }
    const ElementResponse r = respond(e, u, v, memory);
    if (r.memory[3] != 0.0) ++slid;
    for (int c = 0; c < 3; ++c) {
      constexpr double h = 1e-9, hv = 1e-6;
      const Vector by = h * Vector::Unit(3, c), by_rate = hv * Vector::Unit(3, c);
      const Vector k = (respond(e, u + by, v, memory).force - respond(e, u - by, v, memory).force) / (2 * h),
                   d = (respond(e, u, v + by_rate, memory).force - respond(e, u, v - by_rate, memory).force) / (2 * hv);
      EXPECT_NEAR((k - r.stiffness.col(c)).norm(), 0.0, 1e-5 * 1e6) << trial;
      EXPECT_NEAR((d - r.damping.col(c)).norm(), 0.0, 1e-5 * 2e3) << trial;
    }
  }
  EXPECT_GT(slid, 10);
  EXPECT_LT(slid, 55);
}

/// A spring's end that goes on at constant speed pulls a body that sticks and slips, in closed form: it sticks until
/// the spring is as strong as friction at rest, then swings about the spring's stretch under sliding friction.
struct StickSlip {
  double speed = 0.05, sliding = 3000.0, ratio = 1.5;  // [m/s], [N]
  double omega() const { return std::sqrt(kPull / kMassOfSlider); }
  double beyond() const { return (ratio - 1.0) * sliding / kPull; }  ///< stretch at break-away, over that of sliding
  double period() const {
    return 2.0 * beyond() / speed + 2.0 / omega() * (pi - std::atan(beyond() * omega() / speed));
  }
  double amplitude() const { return std::hypot(beyond(), speed / omega()); }  ///< of the stretch
};

VehicleOnTrack stick_slip(const StickSlip& of) {
  VehicleModel model = with_slider();
  DryFrictionSpec f = rubbing(kGround, "slider", {3, 0, -1}, Freedom::x);
  f.normal_force = 1e4;
  f.coefficient = of.sliding / f.normal_force;
  f.static_ratio = of.ratio;
  f.stiffness = 1e3 * kPull;
  f.damping = 0.6 * std::sqrt(f.stiffness * kMassOfSlider);
  model.frictions = {f};
  return with_line(model, [&](LineSetup& setup) {
    SpringMotion m;
    m.spring = std::string(kGround) + "-slider";
    m.direction = Freedom::x;
    m.time = {0.0, 100.0};
    m.displacement = {0.0, 100.0 * of.speed};
    setup.spring_motions = {m};
  });
}

TEST(DryFriction, SticksAndSlipsAsInClosedForm) {
  const StickSlip of;
  const VehicleOnTrack v = stick_slip(of);
  const int x = place_of(v.system, "slider.x");
  Simulation s(v, at_rest(v), steps_of(8.0 * of.period(), 1e-3));
  std::vector<double> breaks;
  double least = 1e9, most = -1e9;
  bool slid = false;
  while (!s.finished()) {
    s.advance();
    const bool slides = s.element_memory().tail<1>()[0] != 0.0;
    if (slides && !slid) breaks.push_back(s.state().time);
    slid = slides;
    if (s.state().time < 3.0 * of.period()) continue;
    const double stretch = of.speed * s.state().time - s.state().q[x];
    least = std::min(least, stretch);
    most = std::max(most, stretch);
  }
  ASSERT_THAT(breaks.size(), ::testing::AllOf(::testing::Ge(6u), ::testing::Le(9u)));  // no chatter
  const double period = (breaks.back() - breaks[1]) / static_cast<double>(breaks.size() - 2);
  EXPECT_NEAR(period / of.period(), 1.0, 0.01);
  EXPECT_NEAR(0.5 * (most - least) / of.amplitude(), 1.0, 0.01);
  EXPECT_NEAR(0.5 * (most + least) * kPull / of.sliding, 1.0, 0.01);
  EXPECT_LT(lost(s), kMostLost);
  // What friction took is the sliding force times the way, and the jump at each break-away on its stiff spring.
  EXPECT_GT(s.energy().dampers, 0.99 * of.sliding * s.state().q[x]);
}

TEST(DryFriction, GoesOnFromASavedStateToTheLastBit) {
  const StickSlip of;
  const VehicleOnTrack v = stick_slip(of);
  const SimulationSettings settings = steps_of(2.0 * of.period(), 1e-3);
  Simulation whole(v, at_rest(v), settings), half(v, at_rest(v), settings);
  while (half.state().time < of.period()) half.advance();  // while it slides
  ByteWriter out;
  half.save(out);
  Simulation other(v, at_rest(v), settings);
  ByteReader in(out.bytes());
  other.restore(in);
  for (Simulation* s : {&whole, &other})
    while (!s->finished()) s->advance();
  EXPECT_EQ(whole.state().q, other.state().q);
  EXPECT_EQ(whole.state().v, other.state().v);
  EXPECT_EQ(whole.element_memory(), other.element_memory());
  EXPECT_EQ(whole.energy().dampers, other.energy().dampers);
}

constexpr double kLeaf = 2e6, kOnLeaf = 9000.0 * kGravity;  // of wheel_on_mass [N/m], [N]

constexpr double kLeafDamping = 1e5;  // of a linear damper beside it [N s/m]

/// The mass on a leaf spring, whose friction is a share of its load.
VehicleModel on_leaf_spring(double share, double damping = kLeafDamping) {
  VehicleModel model = wheel_on_mass(1800.0, 9000.0, kLeaf, damping);
  DryFrictionSpec f = rubbing("mass", "wheelset", {0, 0, -0.46}, Freedom::z);
  f.load_of = model.springs[0].name;
  f.coefficient = share;
  f.stiffness = 500.0 * kLeaf;
  f.damping = 1e5;
  model.frictions = {f};
  return model;
}

BodyForce on_mass(std::vector<double> time, std::vector<double> force) {
  BodyForce f;
  f.body = "mass";
  f.direction = Freedom::z;
  f.time = std::move(time);
  f.force = std::move(force);
  return f;
}

TEST(DryFriction, LeafSpringLosesTheAreaOfItsLoop) {
  constexpr double kShare = 0.08, kForce = 30e3, kPeriod = 4.0;
  const VehicleOnTrack v = with_line(on_leaf_spring(kShare), [&](LineSetup& setup) {
    std::vector<double> time, force;
    for (int i = 0; i <= 4; ++i) {
      time.push_back(kPeriod * (i + 0.25));
      force.push_back(kForce);
      time.push_back(kPeriod * (i + 0.75));
      force.push_back(-kForce);
    }
    setup.forces = {on_mass(time, force)};
  });
  const int mass = place_of(v.system, "mass.z"), set = place_of(v.system, "wheelset.z");
  Simulation s(v, at_rest(v), steps_of(4.25 * kPeriod, 1e-3));
  // Over one loop: how far the spring goes in and out, and what is lost.
  double in = -1.0, out = 1.0, before = 0.0, linear = 0.0;
  while (!s.finished()) {
    const double taken = s.energy().dampers, then = s.state().time;
    const Vector q = s.state().q;
    s.advance();
    if (then < 3.25 * kPeriod) {
      before = s.energy().dampers;
      continue;
    }
    const double compressed = s.state().q[mass] - s.state().q[set], moved = compressed - (q[mass] - q[set]);
    in = std::max(in, compressed);
    out = std::min(out, compressed);
    linear += kLeafDamping * moved * moved / (s.state().time - then);
    EXPECT_GE(s.energy().dampers, taken - 1e-4);
  }
  // Friction is share (P + k u) in and out, but for what its own spring takes up where the motion turns.
  const double area = 2.0 * kShare * (kOnLeaf * (in - out) + 0.5 * kLeaf * (in * in - out * out));
  const double at_in = kShare * (kOnLeaf + kLeaf * in), at_out = kShare * (kOnLeaf + kLeaf * out);
  const double turning = 2.0 * (at_in * at_in + at_out * at_out) / (500.0 * kLeaf);
  EXPECT_GT(in - out, 0.02);
  EXPECT_NEAR((s.energy().dampers - before - linear) / (area - turning), 1.0, 0.01);
  EXPECT_LT(lost(s), kMostLost);
}

TEST(DryFriction, BalancesAsByHand) {
  // A load that is laid on slowly compresses spring and friction, which grows along with the load.
  constexpr double kShare = 0.08, kMore = 20e3, kNoSwing = 3e5;
  const VehicleOnTrack v = with_line(on_leaf_spring(kShare, kNoSwing), [&](LineSetup& setup) {
    setup.forces = {on_mass({0.0, 4.0}, {0.0, kMore})};
  });
  const int mass = place_of(v.system, "mass.z"), set = place_of(v.system, "wheelset.z");
  Simulation s(v, at_rest(v), steps_of(6.0, 1e-3));
  while (!s.finished()) s.advance();
  const double u = (kMore - kShare * kOnLeaf) / (kLeaf * (1.0 + kShare));
  EXPECT_NEAR((s.state().q[mass] - s.state().q[set]) / u, 1.0, 0.005);
  EXPECT_NEAR(-s.element_force()[0] / (kShare * (kOnLeaf + kLeaf * u)), 1.0, 0.005);
  double load = 0.0;
  for (const ContactReaction& r : s.reactions()) load += r.on_rail.force.z();
  EXPECT_NEAR(load / ((1800.0 + 9000.0) * kGravity + kMore), 1.0, 1e-4);
  EXPECT_LT(lost(s), kMostLost);
}

TEST(DryFriction, WedgesHoldMoreOneWay) {
  VehicleModel model = with_slider();
  model.springs.back().damping[0] = 2.0 * std::sqrt(kPull * kMassOfSlider);
  DryFrictionSpec f = rubbing(kGround, "slider", {3, 0, -1}, Freedom::x);
  f.normal_force = 1e4;
  f.coefficient = 0.4;
  f.coefficient_back = 0.1;
  f.stiffness = 1e3 * kPull;
  f.damping = 1e5;
  model.frictions = {f};
  const VehicleOnTrack v = with_line(model, [&](LineSetup& setup) {
    BodyForce push;
    push.body = "slider";
    push.direction = Freedom::x;
    push.time = {0.0, 2.0, 4.0, 8.0, 10.0};
    push.force = {0.0, 10e3, 10e3, -10e3, -10e3};
    setup.forces = {push};
  });
  const int x = place_of(v.system, "slider.x");
  Simulation s(v, at_rest(v), steps_of(10.0, 1e-3));
  double forwards = 0.0;
  while (!s.finished()) {
    s.advance();
    if (s.state().time < 4.0) forwards = s.state().q[x];
  }
  EXPECT_NEAR(forwards, (10e3 - 4e3) / kPull, 0.005 * forwards);
  EXPECT_NEAR(s.state().q[x], -(10e3 - 1e3) / kPull, 0.005 * 0.09);
}

/// The mass on air in place of its spring, with a linear damper beside it. swapped: the mass is the first body.
VehicleModel on_air(bool swapped) {
  VehicleModel model = wheel_on_mass(1800.0, 9000.0, 0.0, 3e5);
  AirSpringSpec air;
  air.name = "air";
  air.body_a = swapped ? "mass" : "wheelset";
  air.body_b = swapped ? "wheelset" : "mass";
  air.position = {0, 0, -0.46};
  air.load = 80e3;  // about what it bears
  air.area = 0.2;
  air.bellows = 0.02, air.reservoir = 0.03;
  air.orifice = 0.02, air.loss = 1.5;
  air.exponent = 1.3;
  model.air_springs = {air};
  return model;
}

/// A load that is laid on slowly: by the gas law of both volumes.
TEST(AirSpring, BearsItsLoadAsByHand) {
  constexpr double kMore = 20e3, kVolume = 0.05, kAreaOfAir = 0.2,
                   kPressure = 101325.0 + 9000.0 * kGravity / kAreaOfAir;
  for (const bool swapped : {false, true}) {
    const VehicleOnTrack v = with_line(on_air(swapped), [&](LineSetup& setup) {
      setup.forces = {on_mass({0.0, 4.0}, {0.0, kMore})};
    });
    EXPECT_NEAR(v.system.elements.air_springs[0].pressure, kPressure, 1.0);
    const int mass = place_of(v.system, "mass.z"), set = place_of(v.system, "wheelset.z");
    Simulation s(v, at_rest(v), steps_of(10.0, 1e-3));
    while (!s.finished()) s.advance();
    const double left = kVolume * std::pow(kPressure / (kPressure + kMore / kAreaOfAir), 1.0 / 1.3);
    EXPECT_NEAR((s.state().q[mass] - s.state().q[set]) * kAreaOfAir / (kVolume - left), 1.0, 2e-3) << swapped;
    EXPECT_NEAR(s.element_memory()[v.system.elements.memory_of_air(0) + 1], kPressure + kMore / kAreaOfAir, 100.0);
    EXPECT_LT(lost(s), kMostLost);
  }
}

TEST(DryFriction, IsPressedByABumpStop) {
  VehicleModel model = wheel_on_mass(1800.0, 9000.0, 2e6, 1e4);
  BumpStopSpec stop;
  stop.name = "bearer";
  stop.body_a = "mass";
  stop.body_b = "wheelset";
  stop.direction = Freedom::z;
  stop.displacement = {0.004, 0.014};
  stop.force = {0.0, 1e4};
  model.bump_stops = {stop};
  DryFrictionSpec f = rubbing("mass", "wheelset", {0, 0, -0.46}, Freedom::x);
  f.load_of = "bearer";
  f.load_share = 0.5;
  f.coefficient = 0.2;
  f.stiffness = 1e7;
  model.frictions = {f};
  const Multibody s = assemble(model, {}, kSpeedOn, kGravity);
  ASSERT_EQ(s.elements.size(), 2);
  Vector u(2);
  u << 1.0, -0.009;
  EXPECT_NEAR(respond(s.elements, u, Vector::Zero(2), s.elements.fresh_memory()).force[0], 0.2 * 0.5 * 5e3, 1e-9);
  u[1] = 0.003;
  EXPECT_EQ(respond(s.elements, u, Vector::Zero(2), s.elements.fresh_memory()).force[0], 0.0);
}

TEST(DryFriction, RefusesLoadsThatAreNotThere) {
  VehicleModel model = on_leaf_spring(0.1);
  model.frictions[0].load_of = "no spring";
  EXPECT_THROW(assemble(model, {}, kSpeedOn, kGravity), Error);
}

/// m x'' = -k x - force of the damper, whose spring in series has the stiffness series; by Runge and Kutta's method.
double damped_by_hand(const ForceCurve& curve, double series, double x, double duration) {
  constexpr double kStep = 1e-5;
  const auto rate_of_force = [&](double force) {  // of the damper's inner end
    double low = -10.0, high = 10.0;
    for (int i = 0; i < 60; ++i) (value_at(curve, 0.5 * (low + high)).force < force ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  };
  std::array<double, 3> y{x, 0.0, x};  // displacement, rate, inner end
  const auto slope = [&](const std::array<double, 3>& at) -> std::array<double, 3> {
    const double force = series > 0.0 ? series * (at[0] - at[2]) : value_at(curve, at[1]).force;
    return {at[1], (-kPull * at[0] - force) / kMassOfSlider, series > 0.0 ? rate_of_force(force) : 0.0};
  };
  const auto moved = [](const std::array<double, 3>& at, const std::array<double, 3>& by, double h) {
    return std::array<double, 3>{at[0] + h * by[0], at[1] + h * by[1], at[2] + h * by[2]};
  };
  for (double t = 0.0; t < duration - 0.5 * kStep; t += kStep) {
    const auto a = slope(y), b = slope(moved(y, a, 0.5 * kStep)), c = slope(moved(y, b, 0.5 * kStep)),
               d = slope(moved(y, c, kStep));
    for (std::size_t i = 0; i < 3; ++i) y[i] += kStep / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
  }
  return y[0];
}

TEST(DamperCurve, BlowsOffAsAnotherIntegratorSays) {
  const std::vector<double> velocity{0.0, 0.05, 0.3}, force{0.0, 1000.0, 1500.0};
  constexpr double kDuration = 0.5, kStart = 0.1;
  for (const double series : {0.0, 4e5}) {
    VehicleModel model = with_slider();
    DamperCurveSpec damper;
    damper.name = "damper";
    damper.body_a = kGround;
    damper.body_b = "slider";
    damper.position = {3, 0, -1};
    damper.direction = Freedom::x;
    damper.velocity = velocity;
    damper.force = force;
    damper.series_stiffness = series;
    model.damper_curves = {damper};
    const VehicleOnTrack v = on_hertz_springs(model, {}, kSpeedOn, kRail);
    const int x = place_of(v.system, "slider.x");
    SystemState start = at_rest(v);
    start.q[x] = kStart;
    if (series > 0.0) start.q[place_of(v.system, "damper.damper_x")] = kStart;
    SimulationSettings settings = steps_of(kDuration, 2e-4);
    settings.step.spectral_radius = 1.0;
    Simulation s(v, start, settings);
    while (!s.finished()) s.advance();
    const double truth = damped_by_hand({velocity, force}, series, kStart, kDuration);
    EXPECT_LT(std::abs(truth), 0.09);
    EXPECT_NEAR(s.state().q[x], truth, 2e-4 * kStart) << series;
    EXPECT_LT(lost(s), kMostLost);
  }
}

TEST(DamperCurve, ALinearOneIsALinearDamper) {
  VehicleModel linear = with_slider(), curved = linear;
  linear.springs.back() = spring(kGround, "slider", {3, 0, -1}, {kPull, 0, 0, 0, 0, 0}, {4e3, 0, 0, 0, 0, 0});
  DamperCurveSpec damper;
  damper.body_a = kGround;
  damper.body_b = "slider";
  damper.position = {3, 0, -1};
  damper.direction = Freedom::x;
  damper.velocity = {0.0, 0.1};
  damper.force = {0.0, 400.0};
  curved.damper_curves = {damper};
  double end[2];
  for (int i = 0; i < 2; ++i) {
    const VehicleOnTrack v = on_hertz_springs(i == 0 ? linear : curved, {}, kSpeedOn, kRail);
    SystemState start = at_rest(v);
    const int x = place_of(v.system, "slider.x");
    const LinearSystem tangent = linearised_system(v, start);
    EXPECT_NEAR(tangent.damping(x, x), 4e3, 1e-6);
    start.q[x] = 0.1;
    Simulation s(v, start, steps_of(0.3, 1e-3));
    while (!s.finished()) s.advance();
    end[i] = s.state().q[x];
  }
  EXPECT_NEAR(end[0], end[1], 1e-9);
}

TEST(RailShift, LiftsWhatStandsOnTheRails) {
  const VehicleOnTrack v = with_line(wheel_on_mass(1800.0, 9000.0, 2e6, 1e5), [&](LineSetup& setup) {
    RailShift shift;
    shift.time = {0.0, 2.0};
    shift.displacement = {0.0, -0.01};
    setup.rail_shifts = {shift};
  });
  const int mass = place_of(v.system, "mass.z");
  const SystemState start = at_rest(v);
  Simulation s(v, start, steps_of(4.0, 1e-3));
  while (!s.finished()) s.advance();
  EXPECT_NEAR(s.state().q[mass] - start.q[mass], -0.01, 1e-6);
}

TEST(BodyForce, ActsAtItsPoint) {
  VehicleModel model = wheel_on_mass(1800.0, 9000.0, 2e6, 1e4);
  model.bodies[0].free = {false, true, true, true, false, false};
  model.springs = {spring("mass", "wheelset", {0, -1, -0.46}, {0, 3e5, 1e6, 0, 0, 0}),
                   spring("mass", "wheelset", {0, 1, -0.46}, {0, 3e5, 1e6, 0, 0, 0})};
  constexpr double kAbove = 0.7, kForce = 5e3;
  const VehicleOnTrack v = with_line(model, [&](LineSetup& setup) {
    BodyForce wind = on_mass({0.0}, {kForce});
    wind.direction = Freedom::y;
    wind.point = Vec3(0.0, 0.0, -1.0 - kAbove);
    setup.forces = {wind};
  });
  const LineState line = *v.line_state(0.0);
  EXPECT_DOUBLE_EQ(line.force[place_of(v.system, "mass.y")], kForce);
  EXPECT_NEAR(line.force[place_of(v.system, "mass.roll")], kForce * kAbove, 1e-9);  // a roll takes y towards z
  EXPECT_EQ(line.force[place_of(v.system, "mass.z")], 0.0);
}

TEST(BodyForce, ThatNothingFollowsIsRefused) {
  const auto pulled = [](bool free_run) {
    return with_line(wheel_on_mass(1800.0, 9000.0, 2e6, 1e4), [&](LineSetup& setup) {
      BodyForce pull = on_mass({0.0}, {5e3});
      pull.direction = Freedom::x;
      setup.forces = {pull};
      if (free_run) setup.free_run = FreeRun{};
    });
  };
  EXPECT_THROW(pulled(false), Error) << "the mass moves up and down only";
  EXPECT_NO_THROW(pulled(true)) << "it makes the speed";
}

/// Both rails together go down by what the bed of one gives way to the force.
TEST(BodyForce, ActsOnARailThatRunsAlong) {
  constexpr double kBedStiffness = 5e7, kForce = 8e3;
  const auto pushed = [&](double force, Freedom direction) {
    VehicleOnTrack v = on_hertz_springs(wheel_on_mass(1800.0, 9000.0, 2e6, 1e4),
                                        rails_on_springs(100.0, kBedStiffness, 1e5), kSpeedOn, kRail);
    LineSetup setup;
    setup.gravity = kGravity;
    setup.speed = constant_speed(kSpeedOn);
    BodyForce push = on_mass({0.0}, {force});
    push.body.clear();
    push.left = true;
    push.direction = direction;
    setup.forces = {push};
    v.line = std::make_shared<const LineEffects>(v.system, std::move(setup));
    return v;
  };
  const auto down = [&](double force) {
    const VehicleOnTrack v = pushed(force, Freedom::z);
    const Equilibrium e = find_equilibrium(v, {1e-12, 1e-6, 1e-3, 60});
    EXPECT_EQ(e.report.status, Status::ok) << e.report.message;
    return std::pair{e.state.q[place_of(v.system, "left_rail@1.z")], e.state.q[place_of(v.system, "right_rail@1.z")]};
  };
  const auto [left_before, right_before] = down(0.0);
  const auto [left, right] = down(kForce);
  EXPECT_NEAR(left + right - left_before - right_before, kForce / kBedStiffness, 1e-5 * kForce / kBedStiffness);
  EXPECT_GT(left - left_before, right - right_before);
  EXPECT_THROW(pushed(kForce, Freedom::y), Error) << "these rails only move vertically";
  EXPECT_THROW(with_line(wheel_on_mass(1800.0, 9000.0, 2e6, 1e4),
                         [&](LineSetup& setup) {
                           BodyForce push = on_mass({0.0}, {kForce});
                           push.body.clear();
                           push.left = false;
                           setup.forces = {push};
                         }),
               Error)
      << "these do not move at all";
}

}  // namespace
}  // namespace treadmark::vehicle
