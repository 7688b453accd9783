// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/train.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "small_vehicles.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/vehicle/free_run.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kRailSpring = 9e10;    // of Hertz' springs [N/m^1.5]
constexpr double kTrainSpeed = 20.0;    // [m/s]
constexpr double kApart = 10.0;         // of the vehicles [m]
constexpr double kCarSpring = 2e6;      // of the suspension [N/m]
constexpr double kSprungMass = 9000.0;  // [kg]
constexpr double kWheelMass = 1800.0;   // [kg]

/// A mass on a wheelset, which both go up and down; the mass rubs on its guide.
VehicleModel car() {
  VehicleModel v = wheel_on_mass(kWheelMass, kSprungMass, kCarSpring, 1e4);
  DryFrictionSpec guide;
  guide.name = "guide";
  guide.body_a = "wheelset";
  guide.body_b = "mass";
  guide.position = {0, 0, -0.5};
  guide.directions[2] = true;
  guide.stiffness = 1e7;
  guide.coefficient = 0.2;
  guide.load_of = "mass-wheelset";
  v.frictions = {guide};
  BumpStopSpec stop{"stop", "wheelset", "mass", {0, 0, -0.5}, Freedom::z, {0.0, 0.001, 0.01}, {0.0, 0.0, 1e5}, {}};
  v.bump_stops = {stop};
  return v;
}

VehicleModel train(const VehicleModel& one, int count) {
  VehicleModel all = one;
  for (int i = 1; i < count; ++i) append_vehicle(all, one, -kApart * i);
  return all;
}

VehicleOnTrack on_rails(const VehicleModel& model) {
  return on_hertz_springs(model, rails_on_springs(200.0, 6e7, 5e4), kTrainSpeed, kRailSpring);
}

/// From its balance, with the masses lifted.
Simulation thrown(const VehicleOnTrack& v, double up) {
  Equilibrium e = find_equilibrium(v, {1e-12, 1e-6, 60});
  EXPECT_EQ(e.report.status, Status::ok) << e.report.message;
  for (const Multibody::Range& vehicle : v.system.vehicles) e.state.q[vehicle.first] -= up;
  return Simulation(v, e.state, equal_steps(0.05, 2e-4));
}

void run_all(Simulation& s) {
  while (!s.finished()) s.advance();
}

TEST(Train, CoordinatesOfVehiclesFollowEachOther) {
  const VehicleOnTrack one = on_rails(car()), three = on_rails(train(car(), 3));
  ASSERT_EQ(three.system.vehicles.size(), 3u);
  EXPECT_EQ(three.system.size(), 3 * one.system.size());
  for (int i = 0; i < three.system.size(); ++i) {
    const auto vehicle = static_cast<std::size_t>(i / one.system.size());
    const Coordinate& c = three.system.coordinates[static_cast<std::size_t>(i)];
    const std::string& own = one.system.coordinates[static_cast<std::size_t>(i % one.system.size())].name;
    EXPECT_EQ(c.vehicle, static_cast<int>(vehicle));
    if (own.find('@') == std::string::npos) {
      EXPECT_EQ(c.name, vehicle_prefix(c.vehicle) + own);
    }
  }
  for (const Matrix* m : {&three.system.stiffness, &three.system.damping})
    for (int row = 0; row < m->rows(); ++row)
      for (int column = 0; column < m->cols(); ++column)
        if (row / one.system.size() != column / one.system.size()) {
          EXPECT_EQ((*m)(row, column), 0.0);
        }
}

/// Vehicles that nothing couples do, to the last bit, what each does alone.
TEST(Train, VehiclesWithoutCouplersRunAsAlone) {
  Simulation alone = thrown(on_rails(car()), 0.02), four = thrown(on_rails(train(car(), 4)), 0.02);
  run_all(alone);
  run_all(four);
  EXPECT_EQ(four.counts().steps, alone.counts().steps);
  EXPECT_EQ(four.counts().evaluations, alone.counts().evaluations);
  for (const Multibody::Range& vehicle : four.vehicle().system.vehicles) {
    EXPECT_EQ(Vector(part_of(four.state().q, vehicle)), alone.state().q);
    EXPECT_EQ(Vector(part_of(four.state().v, vehicle)), alone.state().v);
  }
  // Friction has been at work: what it does is shared out by vehicles, too.
  EXPECT_GT(alone.energy().dampers, 1.0);
  EXPECT_NEAR(four.energy().dampers, 4.0 * alone.energy().dampers, 1e-9 * four.energy().dampers);
  EXPECT_LT(std::abs(four.energy().integration_error(four.energy_at_start())), 1e-2 * four.energy().turnover);
}

/// What a step works through, counted: contacts are evaluated once a wheel and round.
TEST(Train, WorkGrowsWithItsVehiclesAlone) {
  const auto numbers = [](int count) {
    const VehicleOnTrack v = on_rails(train(car(), count));
    const Equilibrium e = find_equilibrium(v);
    ImplicitStep scheme(v, {});
    EXPECT_TRUE(scheme.take(scheme.start(e.state, e.reactions), 1e-4).converged);
    return scheme.factorised_numbers();
  };
  const std::size_t one = numbers(1);
  EXPECT_GT(one, 0u);
  for (const int count : {2, 3, 10}) EXPECT_EQ(numbers(count), static_cast<std::size_t>(count) * one);
}

TEST(Train, RefusesSpringsBetweenItsVehicles) {
  VehicleModel two = train(car(), 2);
  two.springs.push_back(spring("mass", "v2_mass", {-5, 0, -1}, {1e6, 0, 1e6, 0, 0, 0}));
  EXPECT_THROW(assemble(two, {}, kTrainSpeed, kGravity), Error);
}

/// The mass of each vehicle moves along x as well, on wheels that do not hold it.
VehicleModel sliding_car() {
  VehicleModel v = wheel_on_mass(kWheelMass, kSprungMass, kCarSpring, 1e4);
  v.bodies[0].free[0] = true;
  return v;
}

constexpr double kCoupling = 4e6;  // [N/m]

VehicleModel coupled(int count, const std::function<void(CouplerSpec&)>& change) {
  VehicleModel all = train(sliding_car(), count);
  for (int i = 1; i < count; ++i) {
    CouplerSpec c;
    c.name = std::to_string(i);
    c.front = vehicle_prefix(i - 1) + "mass";
    c.rear = vehicle_prefix(i) + "mass";
    c.position = {-kApart * (i - 0.5), 0.0, -1.0};
    c.travel = {0.0, 0.1};
    c.force = {0.0, 0.1 * kCoupling};
    change(c);
    all.couplers.push_back(c);
  }
  return all;
}

/// Of the mass of a vehicle along x.
int x_of(const Multibody& s, int vehicle) { return s.vehicles[static_cast<std::size_t>(vehicle)].first; }

Simulation pulled_apart(const VehicleModel& model, double stretch, double rate, double duration, double step,
                        double spectral_radius = 1.0) {
  const VehicleOnTrack v = on_hertz_springs(model, {}, kTrainSpeed, kRailSpring);
  Equilibrium e = find_equilibrium(v, {1e-12, 1e-6, 60});
  EXPECT_EQ(e.report.status, Status::ok) << e.report.message;
  for (const auto& [vehicle, sign] : {std::pair{0, 0.5}, {1, -0.5}}) {
    e.state.q[x_of(v.system, vehicle)] = sign * stretch;
    e.state.v[x_of(v.system, vehicle)] = sign * rate;
  }
  SimulationSettings settings = equal_steps(duration, step);
  settings.step.spectral_radius = spectral_radius;
  return Simulation(v, e.state, settings);
}

double stretch_of(const Simulation& s) {
  const Multibody& system = s.vehicle().system;
  return s.state().q[x_of(system, 0)] - s.state().q[x_of(system, 1)];
}

/// Two masses on a spring swing against each other with sqrt(2 k / M).
TEST(Coupler, TwoMassesSwingAsInClosedForm) {
  constexpr double kStretch = 0.02, kStep = 2e-4;
  const double omega = std::sqrt(2.0 * kCoupling / kSprungMass), period = 2.0 * std::numbers::pi / omega;
  Simulation s = pulled_apart(coupled(2, [](CouplerSpec&) {}), kStretch, 0.0, 3.0 * period, kStep);
  while (!s.finished()) {
    s.advance();
    EXPECT_NEAR(stretch_of(s), kStretch * std::cos(omega * s.state().time), 1e-3 * kStretch);
    EXPECT_NEAR(s.element_force()[0], kCoupling * stretch_of(s), 1e-6 * kCoupling * kStretch);
  }
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * 0.5 * kCoupling * kStretch * kStretch);
}

/// From one end of the free play to the other and back, with a half swing of the spring at each end.
TEST(Coupler, FreePlayAndSpringMakeAPeriodInClosedForm) {
  constexpr double kSlack = 0.04, kRate = 0.5, kStep = 1e-4;
  const double omega = std::sqrt(2.0 * kCoupling / kSprungMass);
  const double period = 2.0 * kSlack / kRate + 2.0 * std::numbers::pi / omega;
  Simulation s = pulled_apart(coupled(2, [](CouplerSpec& c) { c.slack = kSlack; }), 0.0, kRate, period, kStep);
  double most = 0.0;
  while (!s.finished()) {
    s.advance();
    most = std::max(most, s.element_force()[0]);
  }
  EXPECT_NEAR(stretch_of(s), 0.0, 0.01 * kSlack);
  EXPECT_NEAR(most, kRate * std::sqrt(0.5 * kSprungMass * kCoupling), 1e-3 * most);
}

/// Friction of a draft gear takes F (1 + mu) in and gives F (1 - mu) back.
TEST(Coupler, FrictionTakesItsShareOfAnImpact) {
  constexpr double kFriction = 0.4, kSlack = 0.01, kRate = 0.5;
  const auto gear = [](CouplerSpec& c) {
    c.slack = kSlack;
    c.friction = kFriction;
    c.friction_stiffness = 100.0 * kCoupling;
  };
  // slack / (2 rate) and a quarter of both swings take 0.1226 s, the way back through the free play 0.031 s
  Simulation s = pulled_apart(coupled(2, gear), 0.0, kRate, 0.138, 2e-5);
  run_all(s);
  const Multibody& system = s.vehicle().system;
  const double rate = s.state().v[x_of(system, 0)] - s.state().v[x_of(system, 1)];
  ASSERT_LT(std::abs(stretch_of(s)), 0.5 * kSlack) << "between both ends of the free play";
  EXPECT_NEAR(rate, -kRate * std::sqrt((1.0 - kFriction) / (1.0 + kFriction)), 0.02 * kRate);
  EXPECT_NEAR(s.energy().dampers, 0.25 * kSprungMass * (kRate * kRate - rate * rate), 0.01 * s.energy().dampers);
}

/// The damper takes energy, and never pulls where the spring pushes.
TEST(Coupler, DamperFollowsItsSpring) {
  const auto damped = [](CouplerSpec& c) {
    c.slack = 0.02;
    c.damping = 2e5;
  };
  Simulation s = pulled_apart(coupled(2, damped), 0.03, 0.0, 1.0, 1e-4);
  while (!s.finished()) {
    s.advance();
    const double beyond = std::abs(stretch_of(s)) - 0.01;
    if (beyond < -1e-6) {
      EXPECT_EQ(s.element_force()[0], 0.0);
    } else if (beyond > 1e-6) {
      EXPECT_GE(s.element_force()[0] * stretch_of(s), 0.0);
    }
  }
  EXPECT_GT(s.energy().dampers, 0.2 * 0.5 * kCoupling * 1e-4);
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 0.01 * s.energy().dampers);
}

/// A train that is pulled in front: each coupler bears m a of what hangs behind it.
TEST(Coupler, BearsWhatItAcceleratesBehindIt) {
  constexpr int kCount = 4;
  constexpr double kPull = 4e4;  // [N]
  VehicleOnTrack v =
      on_hertz_springs(coupled(kCount, [](CouplerSpec& c) { c.damping = 5e5; }), {}, kTrainSpeed, kRailSpring);
  LineSetup setup;
  setup.gravity = kGravity;
  setup.speed = constant_speed(kTrainSpeed);
  setup.forces.push_back({"mass", {}, {}, {}, Freedom::x, {0.0, 2.0}, {0.0, kPull}, {}});
  v.line = std::make_shared<const LineEffects>(v.system, std::move(setup));
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  Simulation s(v, e.state, equal_steps(4.0, 1e-3));
  run_all(s);
  const double acceleration = kPull / (kCount * kSprungMass);
  for (int i = 0; i < kCount - 1; ++i)
    EXPECT_NEAR(s.element_force()[i], (kCount - 1 - i) * kSprungMass * acceleration, 0.01 * kPull);
  for (int i = 0; i < kCount; ++i) EXPECT_NEAR(s.acceleration()[x_of(v.system, i)], acceleration, 0.01 * acceleration);
}

/// Masses and wheelsets of a train run freely, pulled in front, up a gradient and against a resistance.
TEST(FreeRun, TrainFollowsItsPointMass) {
  constexpr int kCount = 3;
  constexpr double kPull = 2e4, kDistance = 200.0, kSteep = 0.005;
  VehicleModel model = coupled(kCount, [](CouplerSpec& c) { c.damping = 5e5; });
  for (BodySpec& b : model.bodies) b.free[0] = true;
  for (SpringSpec& s : model.springs) s.stiffness[0] = 1e7, s.damping[0] = 1e5;
  FreeRun run_of;
  run_of.resistance = 1000.0;
  run_of.by_square = 2.0;
  run_of.place = {50.0, 60.0};
  run_of.gradient = {0.0, kSteep};
  const std::vector<BodyForce> forces{{"mass", {}, {}, {}, Freedom::x, {0.0, 1.0}, {0.0, kPull}, {}}};
  VehicleOnTrack v = on_hertz_springs(model, {}, kTrainSpeed, kRailSpring);
  LineSetup setup;
  setup.gravity = kGravity;
  setup.free_run = run_of;
  setup.forces = forces;
  setup.speed = free_speed(run_of, {model, {}, forces, kGravity, 0.0}, kTrainSpeed, kDistance);
  const SpeedProfile profile = setup.speed;
  v.line = std::make_shared<const LineEffects>(v.system, std::move(setup));
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  Simulation s(v, e.state, equal_steps(time_at(profile, kDistance), 1e-3));
  while (!s.finished()) {
    s.advance();
    ASSERT_NEAR(v.mean_speed(s.state()), v.travel(s.state().time).speed, 5e-3);
  }
  EXPECT_NE(profile.speed.back(), kTrainSpeed);
  const double mass = kCount * (kSprungMass + kWheelMass), speed = profile.speed.back();
  const double taken = kPull - resistance_at(run_of, speed) - mass * kGravity * kSteep;
  EXPECT_NEAR(travel_at(profile, s.state().time - 0.01).acceleration, taken / mass, 1e-3 * kPull / mass);
  // Equal vehicles share what pulls them equally, whatever takes it.
  for (int i = 0; i < kCount - 1; ++i)
    EXPECT_NEAR(s.element_force()[i], kPull * (kCount - 1 - i) / kCount, 0.01 * kPull);
}

TEST(FreeRun, SpeedsAreThoseOfClosedForms) {
  VehicleModel one = sliding_car();
  const double mass = kSprungMass + kWheelMass;
  const DrivenTrain alone{one, {}, {}, kGravity, 0.0};
  FreeRun drag;
  drag.by_square = 30.0;
  const SpeedProfile coasting = free_speed(drag, alone, 40.0, 500.0);
  for (std::size_t i = 0; i < coasting.time.size(); ++i)
    EXPECT_NEAR(coasting.speed[i], 40.0 / (1.0 + 40.0 * drag.by_square * coasting.time[i] / mass), 1e-6);
  FreeRun hill;
  hill.place = {0.0};
  hill.gradient = {0.02};
  const SpeedProfile climbing = free_speed(hill, alone, 30.0, 1000.0);
  for (std::size_t i = 0; i < climbing.time.size(); ++i)
    EXPECT_NEAR(climbing.speed[i] * climbing.speed[i], 900.0 - 2.0 * kGravity * 0.02 * climbing.distance[i], 1e-3);
  EXPECT_THROW(free_speed(hill, alone, 10.0, 1000.0), Error);

  // Wheelsets that turn take their part of a torque.
  one.bodies[1].free[4] = true;
  one.bodies[1].inertia = {1.0, 110.0, 1.0};
  const std::vector<AxleTorque> torques{{0, {0.0}, {4600.0}, "mass", {}}};
  const SpeedProfile driven = free_speed({}, {one, torques, {}, kGravity, 0.0}, 10.0, 100.0);
  EXPECT_NEAR((driven.speed.back() - 10.0) / driven.time.back(), 1e4 / (mass + 110.0 / (0.46 * 0.46)), 1e-9);
}

/// The integral of a broken line whose ends are held, from 0.
double by_trapezoids(const std::vector<double>& x, const std::vector<double>& y, double to) {
  std::vector<double> places = x, values = y;
  places.insert(places.begin(), -1e3), values.insert(values.begin(), y.front());
  places.push_back(1e6), values.push_back(y.back());
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double low = std::max(0.0, places[i]), high = std::min(to, places[i + 1]);
    const double slope = (values[i + 1] - values[i]) / (places[i + 1] - places[i]);
    if (low < high) sum += (high - low) * (values[i] + slope * (0.5 * (low + high) - places[i]));
  }
  return sum;
}

/// A table whose steps are of all orders from one to the other.
std::pair<std::vector<double>, std::vector<double>> random_table(std::mt19937& random, double from, double to,
                                                                 double most, double end) {
  std::uniform_real_distribution<double> order(std::log(from), std::log(to)), value(-most, most);
  std::vector<double> at, values;
  for (double x = 0.0; x < end; x += std::exp(order(random))) at.push_back(x), values.push_back(value(random));
  return {at, values};
}

/// A mass on a wheelset that turns, both free along x.
VehicleModel rolling_car() {
  VehicleModel one = sliding_car();
  one.bodies[1].free[0] = one.bodies[1].free[4] = true;
  one.bodies[1].inertia = {1.0, 110.0, 1.0};
  one.springs[0].stiffness[0] = 1e7;
  return one;
}
constexpr double kRollingMass = kSprungMass + kWheelMass + 110.0 / (0.46 * 0.46);

TEST(FreeRun, MomentumOfAnyForceArrives) {
  const VehicleModel one = rolling_car();
  std::mt19937 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    AxleTorque torque;
    torque.reaction = kGround;
    BodyForce force, moment;
    force.body = "mass";
    force.direction = Freedom::x;
    moment.body = "wheelset";
    moment.direction = Freedom::pitch;
    std::tie(torque.time, torque.torque) = random_table(random, 1e-3, 1.0, 4e3, 12.0);
    std::tie(force.time, force.force) = random_table(random, 1e-3, 1.0, 9e3, 12.0);
    std::tie(moment.time, moment.force) = random_table(random, 1e-3, 1.0, 4e3, 12.0);
    const std::vector<AxleTorque> torques{torque};
    const std::vector<BodyForce> forces{force, moment};
    const SpeedProfile profile = free_speed({}, {one, torques, forces, kGravity, 0.0}, 40.0, 400.0);
    for (std::size_t i = 0; i < profile.time.size(); ++i) {
      const double t = profile.time[i], momentum = (by_trapezoids(torque.time, torque.torque, t) -
                                                    by_trapezoids(moment.time, moment.force, t)) /
                                                       0.46 +
                                                   by_trapezoids(force.time, force.force, t);
      ASSERT_NEAR(profile.speed[i], 40.0 + momentum / kRollingMass, 1e-9) << trial << ' ' << t;
    }
  }
}

/// Three periods of 50 ms, once in the rhythm of the longest steps and once not.
TEST(FreeRun, RipplesAndPulsesBrakeByTheirMean) {
  const VehicleModel one = rolling_car();
  for (const double begin : {0.2, 0.2137}) {
    AxleTorque ripple;
    for (int i = 0; i <= 6; ++i) {
      ripple.time.push_back(begin + 0.025 * i);
      ripple.torque.push_back(i % 2 == 0 ? 0.0 : -8000.0);
    }
    const std::vector<AxleTorque> torques{ripple};
    const SpeedProfile profile = free_speed({}, {one, torques, {}, kGravity, 0.0}, 15.0, 15.0);
    EXPECT_NEAR(profile.speed.back(), 15.0 - 4000.0 * 0.15 / 0.46 / kRollingMass, 1e-9);
  }
}

/// Height that is gained is speed that is lost.
TEST(FreeRun, WorkOfAnyGradientArrives) {
  const VehicleModel one = sliding_car();
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    FreeRun hills;
    std::tie(hills.place, hills.gradient) = random_table(random, 0.5, 1.0, 0.02, 300.0);
    const SpeedProfile profile = free_speed(hills, {one, {}, {}, kGravity, 0.0}, 40.0, 400.0);
    for (std::size_t i = 0; i < profile.time.size(); ++i) {
      const double height = by_trapezoids(hills.place, hills.gradient, profile.distance[i]);
      ASSERT_NEAR(profile.speed[i] * profile.speed[i], 1600.0 - 2.0 * kGravity * height, 1600.0e-9)
          << trial << ' ' << i;
    }
  }
}

/// A train in whose couplers nothing acts before a pulse of 0.2 ms, on steps of 1 ms.
TEST(FreeRun, NoPulseFallsBetweenTwoInstants) {
  constexpr double kPulse = 1e6, kHalf = 1e-4;  // [N], [s]
  for (const double begin : {0.05, 0.050433}) {
    VehicleOnTrack v = on_hertz_springs(coupled(2, [](CouplerSpec&) {}), {}, kTrainSpeed, kRailSpring);
    LineSetup setup;
    setup.gravity = kGravity;
    setup.speed = constant_speed(kTrainSpeed);
    setup.forces.push_back(
        {"mass", {}, {}, {}, Freedom::x, {begin, begin + kHalf, begin + 2.0 * kHalf}, {0.0, kPulse, 0.0}, {}});
    v.line = std::make_shared<const LineEffects>(v.system, std::move(setup));
    const Equilibrium e = find_equilibrium(v);
    ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
    SimulationSettings settings = equal_steps(0.1, 1e-3);
    settings.step.spectral_radius = 1.0;
    Simulation s(v, e.state, settings);
    run_all(s);
    const double gained = kPulse * kHalf / (2.0 * (kSprungMass + kWheelMass));
    EXPECT_NEAR(v.mean_speed(s.state()) - kTrainSpeed, gained, 1e-6 * gained) << begin;
  }
}

TEST(FreeRun, StepsEndOnlyAtPointsThatAreNear) {
  const VehicleOnTrack v = on_hertz_springs(sliding_car(), {}, kTrainSpeed, kRailSpring);
  LineSetup setup;
  setup.speed = {{0.0, 1.0, 1.004}, {kTrainSpeed, kTrainSpeed, kTrainSpeed}, {}};
  setup.forces.push_back({"mass", {}, {}, {}, Freedom::x, {0.5, 1.0, 2.0}, {0.0, 1.0, 0.0}, {}});
  const LineEffects line(v.system, std::move(setup));
  EXPECT_EQ(line.step_within(0.499, 0.002), 0.002) << "one point within it";
  EXPECT_NEAR(line.step_within(0.999, 0.01), 0.001, 1e-12) << "a pulse begins";
  EXPECT_NEAR(line.step_within(1.0, 0.01), 0.004, 1e-12) << "a pulse ends";
  EXPECT_NEAR(line.step_within(1.001, 0.01), 0.003, 1e-12);
  EXPECT_EQ(line.step_within(0.999, 0.003), 0.003) << "no shorter than a step";
  EXPECT_EQ(line.step_within(1.004, 0.01), 0.01);
  EXPECT_EQ(line.step_within(3.0, 0.01), 0.01);
}

TEST(Train, RunsFreeWhereNothingHoldsIt) {
  const VehicleModel free = coupled(3, [](CouplerSpec&) {});
  EXPECT_TRUE(runs_free(free));
  EXPECT_FALSE(runs_free(train(car(), 3))) << "nothing moves along x";
  const auto held = [&](const std::function<void(VehicleModel&)>& change) {
    VehicleModel changed = free;
    change(changed);
    return !runs_free(changed);
  };
  EXPECT_TRUE(held([](VehicleModel& v) { v.springs.push_back(spring(kGround, "v2_mass", {}, {1.0, 0, 0, 0, 0, 0})); }));
  EXPECT_TRUE(held([](VehicleModel& v) { v.springs[0].damping[0] = 1.0; })) << "wheelsets do not move along x";
  EXPECT_TRUE(held([](VehicleModel& v) { v.couplers[1].rear = "v3_wheelset"; }));
  EXPECT_TRUE(held([](VehicleModel& v) {
    DryFrictionSpec f;
    f.body_a = kGround;
    f.body_b = "mass";
    f.directions[0] = true;
    v.frictions = {f};
  }));
  EXPECT_FALSE(held([](VehicleModel& v) { v.springs.push_back(spring(kGround, "mass", {}, {0, 1.0, 0, 0, 0, 0})); }));
}

/// A wheel that takes a force along the track, whatever it does.
class Dragging : public HertzSpring {
 public:
  Dragging(double side_y, double drag) : HertzSpring(kRailSpring, side_y), drag_(drag) {}
  ContactReaction evaluate(const PairMotion& m) override {
    ContactReaction r = HertzSpring::evaluate(m);
    r.on_rail.force.x() += drag_;
    r.on_wheelset.force.x() -= drag_;
    return r;
  }

 private:
  double drag_;
};

/// The masses slow down by all that wheels take; what of it is not that of their own wheels comes through the coupler.
TEST(Train, StartsWithWhatItsWheelsTake) {
  constexpr double kDrag = 200.0;  // of a vehicle's wheels [N]
  for (const auto& [first, second] : {std::pair{1.0, 1.0}, {0.0, 1.0}, {1.0, 0.0}}) {
    VehicleModel model = coupled(2, [](CouplerSpec&) {});
    for (BodySpec& b : model.bodies) b.free[0] = true;
    for (SpringSpec& s : model.springs) s.stiffness[0] = 1e7;
    VehicleOnTrack v = on_hertz_springs(model, {}, kTrainSpeed, kRailSpring);
    ASSERT_TRUE(v.system.free_along);
    for (std::size_t i = 0; i < 4; ++i)
      v.wheels[i].element =
          std::make_shared<Dragging>(i % 2 == 0 ? -0.75 : 0.75, 0.5 * kDrag * (i < 2 ? first : second));
    const Equilibrium e = find_equilibrium(v, {1e-10});
    ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
    EXPECT_LE(e.residual, 1e-10);
    const Simulation s(v, e.state, equal_steps(1.0, 1e-3));
    EXPECT_NEAR(s.element_force()[0], 0.5 * kDrag * (second - first), 1e-4 * kDrag);
    const double acceleration = -0.5 * kDrag * (first + second) / (kSprungMass + kWheelMass);
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(s.acceleration()[x_of(v.system, i)], acceleration, 1e-3 * kDrag / kSprungMass);
    EXPECT_NEAR(stretch_of(s), s.element_force()[0] / kCoupling, 1e-12);
    EXPECT_LT(std::abs(s.state().q[x_of(v.system, 0)]), 1e-3) << "it starts where it stands";
  }
}

TEST(Train, NamesOfTheLeadingVehicleAreItsOwn) {
  const auto refused = [](const std::function<void(VehicleModel&)>& change) {
    VehicleModel leading = car();
    change(leading);
    try {
      append_vehicle(leading, car(), -kApart);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused([](VehicleModel& v) { v.bodies[0].name = "v3_mass"; }), "");
  EXPECT_EQ(refused([](VehicleModel& v) { v.bodies[0].name = "v2_load"; }), "");
  EXPECT_NE(refused([](VehicleModel& v) { v.bodies[0].name = "v2_mass"; }).find("'v2_mass' of the leading vehicle"),
            std::string::npos);
  EXPECT_NE(refused([](VehicleModel& v) { v.bump_stops[0].name = "v2_stop"; }).find("'stop' of vehicle 2"),
            std::string::npos);
}

/// Places of a profile that knows its distances are those of one that does not, to the last bit.
TEST(FreeRun, DistancesAreFoundAsEver) {
  SpeedProfile known{{0.0, 0.1, 0.25, 0.9}, {10.0, 11.0, 10.5, 12.0}, {0.0}};
  const SpeedProfile unknown{known.time, known.speed, {}};
  for (std::size_t i = 1; i < known.time.size(); ++i)
    known.distance.push_back(travel_at(unknown, known.time[i]).distance);
  for (double t = 0.0; t < 1.2; t += 0.01) {
    EXPECT_EQ(travel_at(known, t).distance, travel_at(unknown, t).distance);
    EXPECT_EQ(travel_at(known, t).speed, travel_at(unknown, t).speed);
  }
}

/// In a curve a pull acts across both vehicles, to its inside.
TEST(Coupler, PullsToTheInsideOfACurve) {
  constexpr double kRadius = 200.0;
  VehicleModel model = coupled(2, [](CouplerSpec&) {});
  for (BodySpec& b : model.bodies) b.free[1] = true;
  VehicleOnTrack v = on_hertz_springs(model, {}, kTrainSpeed, kRailSpring);
  TrackLayout layout;
  LayoutElement circle;
  circle.length = 1000.0;
  circle.curvature = {1.0 / kRadius, 1.0 / kRadius};
  circle.gauge = {1.435, 1.435};
  layout.elements = {circle};
  LineSetup setup;
  setup.path = std::make_shared<const TrackPath>(layout);
  setup.start = 100.0;
  setup.gravity = kGravity;
  setup.speed = constant_speed(kTrainSpeed);
  const LineEffects line(v.system, std::move(setup));
  Vector sum = Vector::Zero(v.system.size());
  constexpr double kForce = 1e5;
  line.state(0.0).add_couplers_aside(Vector::Constant(1, kForce), 1.0, sum);
  for (const Multibody::Body& b : v.system.bodies) {
    if (b.coordinate[0] < 0) continue;
    EXPECT_NEAR(sum[b.coordinate[1]], kForce * std::sin(0.5 * kApart / kRadius), 1e-9 * kForce) << b.name;
  }
  // Ends of straight vehicles stand apart where their middles are as far from each other along the line as ever.
  const double half = 0.5 * kApart, turned = half / kRadius;
  EXPECT_NEAR(line.state(0.0).element_stretch[0], 2.0 * (kRadius * std::sin(turned) - half * std::cos(turned)), 1e-9);
}

TEST(Coupler, GoesOnFromASavedStateToTheLastBit) {
  const auto gear = [](CouplerSpec& c) {
    c.slack = 0.01;
    c.damping = 1e5;
    c.friction = 0.3;
    c.friction_stiffness = 2e7;
  };
  const auto start = [&] { return pulled_apart(coupled(3, gear), 0.02, 0.1, 0.2, 1e-4, 0.8); };
  Simulation whole = start(), half = start(), later = start();
  run_all(whole);
  while (half.state().time < 0.1) half.advance();
  ByteWriter out;
  half.save(out);
  ByteReader in(out.bytes());
  later.restore(in);
  run_all(later);
  ByteWriter once, again;
  whole.save(once);
  later.save(again);
  EXPECT_EQ(once.bytes(), again.bytes());
}

TEST(Coupler, RefusesWhatMakesNoSense) {
  const auto refuses = [](const std::function<void(CouplerSpec&)>& change) {
    EXPECT_THROW(assemble(coupled(2, change), {}, kTrainSpeed, kGravity), Error);
  };
  refuses([](CouplerSpec& c) { c.rear = c.front; });
  refuses([](CouplerSpec& c) { c.rear = "nobody"; });
  refuses([](CouplerSpec& c) { c.force = {0.0}; });
  refuses([](CouplerSpec& c) { c.slack = -1e-3; });
  refuses([](CouplerSpec& c) { c.friction = 0.2; });
}

}  // namespace
}  // namespace treadmark::vehicle
