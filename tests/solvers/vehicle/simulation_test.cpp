// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <boost/numeric/odeint.hpp>

#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"
#include "treadmark/tests/support/counting_token.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kHertz = 9e10;

SimulationSettings fixed_steps(double duration, double step) {
  SimulationSettings s;
  s.duration = duration;
  s.position_tolerance = 1.0;
  s.max_step = s.first_step = step;
  s.min_step = 1e-3 * step;
  s.max_travel = 1.0;
  s.step.force_tolerance = 1e-10;
  return s;
}

SystemState lifted(const VehicleOnTrack& v, double mass_by) {
  Equilibrium e = find_equilibrium(v, {1e-12, 1e-6, 60});
  EXPECT_EQ(e.report.status, Status::ok);
  e.state.q[0] += mass_by;
  return e.state;
}

void run(Simulation& s) {
  while (!s.finished()) s.advance();
}

/// The same system by odeint's Dormand-Prince method: mass, wheelset, two rails with their dampers.
using Flat = std::array<double, 8>;
Flat by_odeint(Flat state, double duration) {
  const auto rhs = [](const Flat& x, Flat& d, double) {
    const double suspension = 2e6 * (x[0] - x[1]) + 1e4 * (x[4] - x[5]);
    d = {x[4], x[5], x[6], x[7], -suspension / 9000.0, suspension / 1813.0 + (1813.0 + 9000.0) * kGravity / 1813.0,
         0.0,  0.0};
    for (std::size_t rail : {2u, 3u}) {
      const double f = kHertz * std::pow(std::max(0.0, x[1] - x[rail]), 1.5);
      d[5] -= f / 1813.0;
      d[4 + rail] = (f - 6e7 * x[rail] - 5e4 * x[4 + rail]) / 200.0;
    }
  };
  namespace ode = boost::numeric::odeint;
  ode::integrate_adaptive(ode::make_controlled<ode::runge_kutta_dopri5<Flat>>(1e-14, 1e-12), rhs, state, 0.0, duration,
                          1e-6);
  return state;
}

VehicleOnTrack test_vehicle() {
  return on_hertz_springs(wheel_on_mass(1813.0, 9000.0, 2e6, 1e4), rails_on_springs(200.0, 6e7, 5e4), 20.0, kHertz);
}

TEST(Simulation, SecondOrderAgainstAnotherIntegrator) {
  constexpr double kDuration = 0.02;
  for (const double spectral_radius : {1.0, 0.8, 0.5}) {
    std::vector<double> errors;
    for (const double step : {2e-4, 1e-4, 5e-5, 2.5e-5}) {
      const VehicleOnTrack v = test_vehicle();
      const SystemState start = lifted(v, 0.02);
      Flat flat{};
      for (int i = 0; i < 4; ++i) flat[static_cast<std::size_t>(i)] = start.q[i];
      const Flat truth = by_odeint(flat, kDuration);
      SimulationSettings settings = fixed_steps(kDuration, step);
      settings.step.spectral_radius = spectral_radius;
      Simulation s(v, start, settings);
      run(s);
      double worst = 0.0;
      for (int i = 0; i < 4; ++i)
        worst = std::max(worst, std::abs(s.state().q[i] - truth[static_cast<std::size_t>(i)]));
      errors.push_back(worst);
    }
    for (std::size_t i = 1; i < errors.size(); ++i) {
      const double order = std::log2(errors[i - 1] / errors[i]);
      EXPECT_GT(order, 1.8) << "spectral radius " << spectral_radius << ", halving " << i << ", error " << errors[i];
      EXPECT_LT(order, 2.4) << "spectral radius " << spectral_radius << ", halving " << i;
    }
  }
}

TEST(Simulation, ErrorFollowsTheTolerance) {
  constexpr double kDuration = 0.05;
  double before = 1.0;
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const VehicleOnTrack v = test_vehicle();
    const SystemState start = lifted(v, 0.02);
    Flat flat{};
    for (int i = 0; i < 4; ++i) flat[static_cast<std::size_t>(i)] = start.q[i];
    const Flat truth = by_odeint(flat, kDuration);
    SimulationSettings settings = fixed_steps(kDuration, 5e-3);
    settings.first_step = 1e-6;
    settings.position_tolerance = tolerance;
    settings.step.force_tolerance = 1e-8;
    Simulation s(v, start, settings);
    run(s);
    double worst = 0.0;
    for (int i = 0; i < 4; ++i) worst = std::max(worst, std::abs(s.state().q[i] - truth[static_cast<std::size_t>(i)]));
    EXPECT_LT(worst, 300.0 * tolerance);
    EXPECT_LT(worst, 0.25 * before);
    before = worst;
  }
}

TEST(Simulation, StaysAtRestInEquilibrium) {
  const VehicleOnTrack v = test_vehicle();
  const SystemState start = lifted(v, 0.0);
  Simulation s(v, start, fixed_steps(0.1, 1e-3));
  run(s);
  EXPECT_LT((s.state().q - start.q).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(s.state().time, 0.1, 1e-12);
}

/// A wheelset alone, thrown up: flight is ballistic, contact a nonlinear spring that gives all its energy back.
TEST(Simulation, ContactLostAndRegainedIsLocated) {
  VehicleModel model;
  model.bodies = {body("wheelset", 1813.0, {1, 1, 1}, {0, 0, -0.46}, kVertical)};
  model.wheelsets = {{"wheelset", 0.46}};
  const VehicleOnTrack v = on_hertz_springs(model, {}, 20.0, kHertz);
  Equilibrium e = find_equilibrium(v);
  constexpr double kUp = 0.1;
  e.state.v[0] = -kUp;
  SimulationSettings settings = fixed_steps(0.06, 1e-3);
  settings.position_tolerance = 1e-11;
  settings.first_step = 1e-7;
  settings.min_step = 1e-12;
  settings.event_tolerance = 1e-12;
  settings.step.spectral_radius = 1.0;
  Simulation s(v, e.state, settings);
  run(s);
  // Both wheels leave and come together, each counted.
  ASSERT_GE(s.events().size(), 8u);
  const double potential = 2.0 * 0.4 * kHertz * std::pow(e.state.q[0], 2.5) - 1813.0 * kGravity * e.state.q[0];
  const double leaving = std::sqrt(kUp * kUp + 2.0 * potential / 1813.0);
  for (std::size_t i = 0; i + 2 < s.events().size(); i += 4) {
    EXPECT_FALSE(s.events()[i].regained);
    EXPECT_TRUE(s.events()[i + 2].regained);
    EXPECT_NEAR(s.events()[i + 2].time - s.events()[i].time, 2.0 * leaving / kGravity, 2e-6);
  }
}

TEST(Simulation, EnergyIsBalanced) {
  VehicleModel model = wheel_on_mass(1813.0, 9000.0, 2e6, 1e4);
  model.bodies[1].free = {true, true, true, true, true, true};
  model.bodies[1].inertia = {1100.0, 110.0, 1100.0};
  model.springs[0].stiffness = {1e6, 1e6, 2e6, 1e5, 0, 1e5};
  model.springs[0].damping = {1e3, 2e3, 1e4, 1e2, 0, 1e2};
  model.springs[0].damper_stiffness = {0, 0, 1e6, 0, 0, 0};
  const VehicleOnTrack v = on_hertz_springs(model, rails_on_springs(200.0, 6e7, 5e4), 20.0, kHertz, 1e5);
  SystemState start = lifted(v, 0.01);
  start.v[4] += 0.3;
  SimulationSettings settings = fixed_steps(0.2, 1e-3);
  settings.position_tolerance = 1e-9;
  settings.first_step = 1e-6;
  settings.min_step = 1e-10;
  Simulation s(v, start, settings);
  run(s);
  EXPECT_GT(s.energy().turnover, 10.0);
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
  EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
}

TEST(Simulation, EveryAcceptedInstantOnceThoughStepsAreRepeated) {
  const VehicleOnTrack v = test_vehicle();
  SystemState start = lifted(v, -0.08);  // wheels leave the rails
  SimulationSettings settings = fixed_steps(0.05, 2e-3);
  settings.position_tolerance = 1e-8;
  settings.min_step = 1e-10;
  Simulation s(v, start, settings);
  run(s);
  EXPECT_GT(s.counts().rejected, 0);
  EXPECT_FALSE(s.events().empty());
  const auto& element = dynamic_cast<const HertzSpring&>(*v.wheels[0].element);
  EXPECT_EQ(element.instants, s.counts().steps + 1);
  EXPECT_DOUBLE_EQ(element.last_x, 20.0 * s.state().time);
}

TEST(Simulation, GoesOnWithTheSameBits) {
  const auto settings = [] {
    SimulationSettings s = fixed_steps(0.05, 2e-3);
    s.position_tolerance = 1e-8;
    s.min_step = 1e-10;
    return s;
  }();
  const VehicleOnTrack first = test_vehicle();
  const SystemState start = lifted(first, -0.08);
  Simulation whole(first, start, settings);
  ByteWriter saved;
  for (int i = 0; !whole.finished(); ++i) {
    if (i == 57) whole.save(saved);
    whole.advance();
  }
  const VehicleOnTrack second = test_vehicle();
  Simulation rest(second, start, settings);
  ByteReader reader(saved.bytes());
  rest.restore(reader);
  EXPECT_TRUE(reader.at_end());
  run(rest);
  EXPECT_EQ(rest.state().q, whole.state().q);
  EXPECT_EQ(rest.state().v, whole.state().v);
  EXPECT_EQ(rest.energy().mechanical, whole.energy().mechanical);
  EXPECT_EQ(rest.counts().steps, whole.counts().steps);
  ASSERT_EQ(rest.events().size(), whole.events().size());
  for (std::size_t i = 0; i < rest.events().size(); ++i) EXPECT_EQ(rest.events()[i].time, whole.events()[i].time);

  for (std::size_t length = 0; length < saved.bytes().size(); length += 61) {
    ByteReader cut(std::span(saved.bytes()).first(length));
    EXPECT_THROW(rest.restore(cut), Error) << length;
  }
}

TEST(Simulation, CancelledStepsLeaveItWhereItWas) {
  SimulationSettings settings = fixed_steps(0.05, 2e-3);
  settings.position_tolerance = 1e-8;
  settings.min_step = 1e-10;
  const VehicleOnTrack first = test_vehicle(), second = test_vehicle();
  const SystemState start = lifted(first, -0.08);
  Simulation whole(first, start, settings), disturbed(second, start, settings);
  run(whole);
  int cancelled = 0;
  constexpr long kNever = 1000;
  for (long last = 1; !disturbed.finished(); last = last == kNever ? 1 : last == 7 ? kNever : last + 1) {
    const treadmark::testing::CountingToken token(last);
    const CancellationScope scope(&token);
    const double time = disturbed.state().time;
    try {
      disturbed.advance();
    } catch (const Cancelled&) {
      ++cancelled;
      EXPECT_EQ(disturbed.state().time, time);
    }
  }
  EXPECT_GT(cancelled, 10);
  EXPECT_EQ(disturbed.state().q, whole.state().q);
  EXPECT_EQ(disturbed.state().v, whole.state().v);
  EXPECT_EQ(disturbed.counts().steps, whole.counts().steps);
  EXPECT_EQ(disturbed.counts().evaluations, whole.counts().evaluations);
}

/// A wheel that climbs its rail at a place.
class Climbing : public HertzSpring {
 public:
  using HertzSpring::HertzSpring;
  ContactReaction evaluate(const PairMotion& m) override {
    ContactReaction r = HertzSpring::evaluate(m);
    if (!(m.wheelset.x > kPlace)) return r;
    r.status = Status::failed;
    r.derailed = true;
    r.message = "the flange has climbed the rail";
    return r;
  }
  static constexpr double kPlace = 0.731;
};

TEST(Simulation, ADerailmentIsAResult) {
  VehicleOnTrack v = test_vehicle();
  const SystemState start = lifted(v, -0.01);
  v.wheels.at(0).element = std::make_shared<Climbing>(kHertz, -0.75);
  constexpr double kNear = 1e-5, kLong = 5e-4;  // [s], also where no step may be as short
  for (const double shortest : {1e-6, kLong}) {
    SimulationSettings settings = fixed_steps(0.1, 1e-3);
    settings.min_step = shortest;
    Simulation s(v, start, settings);
    ByteWriter before;
    s.save(before);
    run(s);
    EXPECT_NEAR(s.state().time, Climbing::kPlace / v.speed, std::max(kNear, 4.0 * shortest));
    EXPECT_EQ(s.derailed(), v.wheels[0].name + ": the flange has climbed the rail");
    const long steps = s.counts().steps;
    EXPECT_NO_THROW(s.advance());
    EXPECT_EQ(s.counts().steps, steps);
    ByteReader in(before.bytes());
    s.restore(in);
    EXPECT_FALSE(s.finished()) << "before it derailed it goes on";
  }
}

TEST(Simulation, BadSettingsAndStuckStepsAreErrors) {
  const VehicleOnTrack v = test_vehicle();
  const SystemState start = lifted(v, 0.0);
  SimulationSettings settings = fixed_steps(0.1, 1e-3);
  settings.duration = 0.0;
  EXPECT_THROW(Simulation(v, start, settings), Error);
  settings = fixed_steps(0.1, 1e-3);
  settings.position_tolerance = 1e-30;
  SystemState pushed = start;
  pushed.v[1] = 0.3;
  Simulation s(v, pushed, settings);
  const auto advance = [&] {
    while (!s.finished()) s.advance();
  };
  EXPECT_THROW(advance(), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
