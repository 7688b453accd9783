// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/loaded_rail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "beam_on_bed.hpp"
#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_on_rail.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"

// Several wheels on one rail.

namespace treadmark::vehicle {
namespace {

using Wave = std::complex<double>;

constexpr double kWheelContact = 9e10;  // [N/m^1.5]
constexpr double kFineBay = 0.05;

/// Seats so close that they are a bed.
FlexibleTrack fine_zhai() {
  FlexibleTrack track = zhai_track(kFineBay, 400);
  track.bay_elements = 2;
  track.absorbing_bays = 100;
  track.absorption = 3000.0;
  return track;
}

FlexibleTrack usual_zhai() {
  FlexibleTrack track = zhai_track(0.545, 60);
  track.bay_elements = 8;
  track.absorbing_bays = 15;
  track.absorption = 2000.0;
  return track;
}

Wave on_bed(const FlexibleTrack& track, double f, double distance) {
  const double w = 2.0 * kPi * f;
  return infinite_beam(track.rail, bed_stiffness(track.seats[0], kFineBay, w), w, distance);
}

/// Vertical forces at two places.
Eigen::VectorXd two(double first, double second) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(6);
  forces[1] = first;
  forces[4] = second;
  return forces;
}

Eigen::VectorXd vertical(const Eigen::VectorXd& motions) { return motions(Eigen::seqN(1, motions.size() / 3, 3)); }

TEST(LoadedRail, WheelsDeflectEachOtherAtRestAsOnABed) {
  const FlexibleTrack track = fine_zhai();
  for (const double distance : {0.7, 1.8, 2.56}) {
    const MovingRail rail(track, constant_speed(1e-6), {0.02, 0.02 - distance}, 1.0);
    const double own = on_bed(track, 0.0, 0.0).real(), cross = on_bed(track, 0.0, distance).real();
    const Eigen::MatrixXd found = rail.motions_at_rest().compliance({1, 4}, {1, 4});
    EXPECT_NEAR(found(0, 0), own, 1e-3 * own);
    EXPECT_NEAR(found(1, 1), own, 1e-3 * own);
    EXPECT_NEAR(found(0, 1), cross, 2e-4 * own) << distance;
    EXPECT_NEAR(found(1, 0), found(0, 1), 1e-6 * own);
    EXPECT_GT(std::abs(cross), 4e-3 * own);
  }
}

/// Frequency by frequency the motion of a place under the force at another.
TEST(LoadedRail, CrossReceptanceIsThatOfABeamOnABed) {
  const FlexibleTrack track = fine_zhai();
  constexpr double kDistance = 1.8;
  for (const double f : {60.0, 300.0, 900.0}) {
    MovingRail rail(track, constant_speed(1e-6), {0.0, -kDistance}, 1.0);
    rail.begin(two(0.0, 0.0));
    const double w = 2.0 * kPi * f, step = 1.0 / (200.0 * f);
    Wave own = 0.0, cross = 0.0;
    const int periods = static_cast<int>(0.15 * f);
    for (int i = 1; i <= 200 * periods; ++i) {
      const double time = i * step;
      const Eigen::VectorXd force = two(std::cos(w * time), 0.0);
      const MovingRail::Answer& answer = rail.after(time);
      const Eigen::VectorXd deflection = vertical(answer.free + answer.compliance * force);
      rail.accept(force);
      if (i <= 200 * (periods - 2)) continue;
      const Wave turn = std::exp(Wave(0.0, -w * time)) / 200.0;
      own += deflection[0] * turn;
      cross += deflection[1] * turn;
    }
    const Wave expected = on_bed(track, f, kDistance);
    EXPECT_LT(std::abs(own / on_bed(track, f, 0.0) - 1.0), 0.01) << f << " Hz";
    EXPECT_LT(std::abs(cross / expected - 1.0), 0.02) << f << " Hz";
    EXPECT_GT(std::abs(expected), 0.02 * std::abs(on_bed(track, f, 0.0))) << f << " Hz";
  }
}

/// Deflections under both places by two histories of forces, in steps of 0.1 ms.
Eigen::MatrixXd deflections(MovingRail& rail, int steps, double first, double second) {
  Eigen::MatrixXd found(steps, rail.places());
  const auto force = [&](int i) -> Eigen::VectorXd {
    const double t = 1e-4 * i, f = 55e3 * (1.0 + 0.5 * std::sin(600.0 * t)), g = 40e3 * (1.0 + std::sin(217.0 * t));
    return rail.places() == 2 ? two(first * f, second * g)
                              : Eigen::VectorXd(Eigen::Vector3d(0.0, first * f + second * g, 0.0));
  };
  rail.begin(force(0));
  for (int i = 1; i <= steps; ++i) {
    const MovingRail::Answer& answer = rail.after(1e-4 * i);
    found.row(i - 1) = vertical(answer.free + answer.compliance * force(i));
    rail.accept(force(i));
  }
  return found;
}

TEST(LoadedRail, ForcesSuperpose) {
  const std::vector<double> places{1.0, -1.56};
  MovingRail one(usual_zhai(), constant_speed(40.0), places, 1.0),
      other(usual_zhai(), constant_speed(40.0), places, 1.0), both(usual_zhai(), constant_speed(40.0), places, 1.0);
  constexpr int kSteps = 1500;
  const Eigen::MatrixXd a = deflections(one, kSteps, 1.0, 0.0), b = deflections(other, kSteps, 0.0, 1.0),
                        c = deflections(both, kSteps, 1.0, 1.0);
  EXPECT_LT((a + b - c).cwiseAbs().maxCoeff(), 1e-9 * c.cwiseAbs().maxCoeff());
  EXPECT_GT(a.col(1).tail(1000).cwiseAbs().maxCoeff(), 0.02 * a.col(0).maxCoeff());
}

/// Wheels far from each other are wheels on rails of their own.
TEST(LoadedRail, FarWheelsDoNotFeelEachOther) {
  MovingRail both(usual_zhai(), constant_speed(40.0), {0.3, -40.0}, 1.0),
      front(usual_zhai(), constant_speed(40.0), {0.3}, 1.0), hind(usual_zhai(), constant_speed(40.0), {-40.0}, 1.0);
  constexpr int kSteps = 1500;
  const Eigen::MatrixXd a = deflections(both, kSteps, 1.0, 1.0), b = deflections(front, kSteps, 1.0, 0.0),
                        c = deflections(hind, kSteps, 0.0, 1.0);
  EXPECT_LT((a.col(0) - b).cwiseAbs().maxCoeff(), 1e-3 * b.maxCoeff());
  EXPECT_LT((a.col(1) - c).cwiseAbs().maxCoeff(), 1e-3 * c.maxCoeff());
}

/// Seats are looked at ahead of the first and behind the last wheel, also where they lie much closer than on average.
TEST(LoadedRail, ReachesBeyondItsWheels) {
  FlexibleTrack track = usual_zhai();
  for (std::size_t i = 0; i < track.seats.size(); ++i) track.seats[i].x = i < 30 ? 1.0 * i : 30.0 + 0.3 * (i - 30.0);
  FlexibleTrack longer = track;
  MovingRail rail(track, constant_speed(40.0), {14.0, -6.0}, 1.0),
      wide(longer, constant_speed(40.0), {14.0, -6.0}, 1.0, 60.0);
  const Eigen::MatrixXd a = deflections(rail, 1500, 1.0, 1.0), b = deflections(wide, 1500, 1.0, 1.0);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 2e-3 * b.maxCoeff());
}

TEST(LoadedRail, RefusesLoadsThatAreNotThoseOfItsWheels) {
  const auto made = [](std::vector<double> loads) {
    LoadedRail rail(MovingRail(usual_zhai(), constant_speed(20.0), {0.0, -1.8}, 1.0), loads);
  };
  EXPECT_NO_THROW(made({1e4, 1e4}));
  EXPECT_THROW(made({1e4}), Error);
  EXPECT_THROW(made({1e4, 0.0}), Error);
  const auto rail =
      std::make_shared<LoadedRail>(MovingRail(usual_zhai(), constant_speed(20.0), {0.0}, 1.0), std::vector{1e4});
  EXPECT_THROW(ContactOnRail(std::make_shared<HertzSpring>(1e11, 0.75), rail, 1, 1e-4, Vec3::Zero(), 0.46), Error);
  EXPECT_THROW(ContactOnRail(std::make_shared<HertzSpring>(1e11, 0.75), nullptr, 0, 1e-4, Vec3::Zero(), 0.46), Error);
}

constexpr double kBase = 1.8, kOne = 9000.0, kOther = 7000.0, kWheelset = 1813.0;

/// Two wheelsets with a mass on each, which only rails connect.
VehicleModel two_wheels_on_masses() {
  VehicleModel v;
  int number = 0;
  for (const double x : {0.0, -kBase}) {
    VehicleModel one = wheel_on_mass(kWheelset, number == 0 ? kOne : kOther, 2e6, 1e4);
    const std::string name = std::to_string(++number);
    for (BodySpec& b : one.bodies) b.name += name, b.position.x() = x, v.bodies.push_back(b);
    SpringSpec s = one.springs[0];
    s.name += name, s.body_a += name, s.body_b += name, s.position.x() = x;
    v.springs.push_back(s);
    v.wheelsets.push_back({"wheelset" + name, 0.46});
  }
  return v;
}

VehicleOnTrack on_shared_rails(const FlexibleTrack& track, double speed, double tolerance, bool shared = true,
                               double (*waves)(double) = nullptr) {
  VehicleOnTrack v = on_hertz_springs(two_wheels_on_masses(), {}, speed, kWheelContact);
  const std::vector<double> places{0.0, -kBase},
      loads{0.5 * v.system.wheelset_load[0], 0.5 * v.system.wheelset_load[1]};
  const auto below = [&] {
    return std::make_shared<LoadedRail>(MovingRail(track, constant_speed(speed), places, 1.0), loads);
  };
  const auto left = below(), right = below();
  for (WheelOnRail& wheel : v.wheels) {
    const auto set = static_cast<std::size_t>(wheel.wheelset);
    if (set == 0) std::dynamic_pointer_cast<HertzSpring>(wheel.element)->irregularity = waves;
    auto rail = wheel.side == wheelrail::Side::left ? left : right;
    if (!shared)
      rail = std::make_shared<LoadedRail>(MovingRail(track, constant_speed(speed), {places[set]}, 1.0),
                                          std::vector{loads[set]});
    wheel.element =
        std::make_shared<ContactOnRail>(wheel.element, rail, shared ? set : 0, tolerance, wheel.rail_marker, 0.46);
  }
  return v;
}

TEST(LoadedRail, WheelsetsRestOnTheRailThatBothDeflect) {
  const FlexibleTrack track = usual_zhai();
  const VehicleOnTrack v = on_shared_rails(track, 0.01, 1e-9);  // slow: dampers below move the deflection back
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  const RailOnSeats rest(track);
  const std::vector<double> places{rest.middle(), rest.middle() - kBase};
  const double loads[] = {0.5 * (kWheelset + kOne) * kGravity, 0.5 * (kWheelset + kOther) * kGravity};
  for (std::size_t i = 0; i < 2; ++i) {
    const double expected = loads[0] * rest.deflection(places[0], places)[i] +
                            loads[1] * rest.deflection(places[1], places)[i] +
                            std::pow(loads[i] / kWheelContact, 2.0 / 3.0);
    const int z = v.system.wheelsets[i].coordinate[2];
    EXPECT_NEAR(e.state.q[z], expected, 1e-8);
    // The neighbour is felt.
    EXPECT_GT(std::abs(loads[1 - i] * rest.deflection(places[1 - i], places)[i]), 1e-6);
  }
}

SystemState pushed(const VehicleOnTrack& v) {
  SystemState start = find_equilibrium(v).state;
  start.q[v.system.wheelsets[0].coordinate[2] - 1] += 0.01;
  return start;
}

TEST(LoadedRail, EnergyIsBalanced) {
  for (const double step : {2e-5, 2e-4}) {
    const VehicleOnTrack v = on_shared_rails(usual_zhai(), 20.0, 1e-8);
    Simulation s(v, pushed(v), equal_steps(0.3, step));
    while (!s.finished()) s.advance();
    EXPECT_GT(s.energy().turnover, 10.0);
    EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * s.energy().turnover) << step;
    EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-4 * s.energy().turnover) << step;
    if (step < 1e-4) {
      EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-5 * s.energy().turnover);
    }
  }
}

constexpr double kWaveLength = 0.2, kHeight = 1e-6;

/// A wavy rail below one wheelset moves the other. Linear in amplitudes: with the receptances of wheels A (rigid),
/// contact 1/k and rail R the forces are -(A + 1/k + R)^-1 times the waves.
TEST(LoadedRail, AWavyRailBelowOneWheelMovesTheOther) {
  const FlexibleTrack track = fine_zhai();
  constexpr double kSpeed = 20.0, kStep = 5e-5;
  const double w = 2.0 * kPi * kSpeed / kWaveLength;
  for (const bool shared : {true, false}) {
    const VehicleOnTrack v = on_shared_rails(track, kSpeed, 1e-8, shared,
                                             [](double x) { return kHeight * std::sin(2.0 * kPi * x / kWaveLength); });
    Simulation s(v, find_equilibrium(v).state, equal_steps(0.35, kStep));
    Wave found[2] = {};
    double last = 0.0, span = 0.0;
    while (!s.finished()) {
      s.advance();
      const double time = s.state().time, h = time - last;
      last = time;
      if (time < 0.25 + 0.5 * kStep) continue;  // ten periods
      span += h;
      for (const std::size_t set : {0, 1})
        found[set] += h * (s.reactions()[2 * set].normal_force - 0.5 * v.system.wheelset_load[set]) *
                      std::exp(Wave(0.0, -w * time));
    }
    const Wave wave = kHeight * Wave(0.0, -1.0);
    Eigen::Matrix2cd a;
    for (const int i : {0, 1}) {
      // Half a wheelset, which is hardly held by its spring.
      const double k = 1.5 * std::pow(kWheelContact, 2.0 / 3.0) *
                       std::cbrt(0.5 * v.system.wheelset_load[static_cast<std::size_t>(i)]);
      const double mass = i == 0 ? kOne : kOther;
      const Wave spring(1e6, w * 5e3), upper = -0.5 * mass * w * w, held = spring * upper / (spring + upper);
      for (const int j : {0, 1}) a(i, j) = on_bed(track, w / (2.0 * kPi), i == j ? 0.0 : kBase);
      if (!shared) a(i, 1 - i) = 0.0;
      a(i, i) += 1.0 / k + 1.0 / (held - 0.5 * kWheelset * w * w);
    }
    const Eigen::Vector2cd expected = -a.inverse() * Eigen::Vector2cd(wave, 0.0);
    for (const int i : {0, 1}) {
      const Wave force = 2.0 * found[i] / span;
      EXPECT_LT(std::abs(force - expected[i]), 0.02 * std::abs(expected[0])) << shared << ' ' << i;
    }
    if (shared) {
      EXPECT_GT(std::abs(expected[1]), 0.05 * std::abs(expected[0]));
    }
  }
}

TEST(LoadedRail, GoesOnWithTheSameBits) {
  const SimulationSettings settings = equal_steps(0.15, 5e-5);
  const VehicleOnTrack first = on_shared_rails(usual_zhai(), 20.0, 1e-6);
  Simulation whole(first, pushed(first), settings);
  ByteWriter saved;
  for (int i = 0; !whole.finished(); ++i) {
    if (i == 1500) whole.save(saved);
    whole.advance();
  }
  const VehicleOnTrack second = on_shared_rails(usual_zhai(), 20.0, 1e-6);
  Simulation rest(second, pushed(second), settings);
  ByteReader reader(saved.bytes());
  rest.restore(reader);
  EXPECT_TRUE(reader.at_end());
  while (!rest.finished()) rest.advance();
  EXPECT_EQ(rest.state().q, whole.state().q);
  EXPECT_EQ(rest.energy().elastic, whole.energy().elastic);
  EXPECT_EQ(rest.counts().steps, whole.counts().steps);
  // Not into rails with other wheels.
  const VehicleOnTrack third = on_shared_rails(usual_zhai(), 20.0, 1e-6, false);
  Simulation other(third, pushed(third), settings);
  ByteReader again(saved.bytes());
  EXPECT_THROW(other.restore(again), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
