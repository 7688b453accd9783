// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <vector>

#include "beam_on_bed.hpp"
#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_on_rail.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"
#include "treadmark/solvers/vehicle/track/rail_on_seats.hpp"

// Joints of rails: hinges with springs, and dips of the unloaded rails.

namespace treadmark::vehicle {
namespace {

using Value = std::complex<double>;

constexpr double kJointBay = 0.05, kJointContact = 9e10;

/// Euler's beam on a bed, nearly: seats close to each other on which nothing has mass.
FlexibleTrack beam_with_joint(double hinge_stiffness) {
  FlexibleTrack track = zhai_track(kJointBay, 600);
  track.rail.shear_stiffness *= 1e4;
  track.rail.rotary_inertia = 0.0;
  track.bay_elements = 2;
  track.absorbing_bays = 150;
  track.absorption = 3000.0;
  for (RailSeat& seat : track.seats) seat = {seat.x, 80e6 / 0.545 * kJointBay, 60e3 / 0.545 * kJointBay, 1e-3, 1e13, 0};
  track.joints.push_back({track.seats[300].x + 0.3 * kJointBay, hinge_stiffness});
  return track;
}

/// Euler's beam on a bed with Z per length at one frequency, 4 b^4 = (Z - m w2)/EI. A force deflects it by
///   exp(-z)(cos z + sin z)/(8 b^3 EI), z = b |x|,
/// with the moment exp(-z)(cos z - sin z)/(4 b); a hinge that opens by 1 rad in the sense of that moment takes the
/// moment EI b/2 and deflects it by exp(-z)(cos z - sin z)/(4 b) (Hetenyi 1946).
struct BeamOnBed {
  BeamOnBed(const FlexibleTrack& track, double frequency) : ei(track.rail.bending_stiffness) {
    const double w = 2.0 * kPi * frequency;
    const RailSeat& seat = track.seats.front();
    const Value z = Value(seat.pad_stiffness, w * seat.pad_damping) / kJointBay - w * w * track.rail.mass;
    b = std::pow(0.25 * z / ei, 0.25);
  }
  Value by_force(double x) const {
    const Value z = b * std::abs(x);
    return std::exp(-z) * (std::cos(z) + std::sin(z)) / (8.0 * b * b * b * ei);
  }
  Value by_opening(double x) const {
    const Value z = b * std::abs(x);
    return std::exp(-z) * (std::cos(z) - std::sin(z)) / (4.0 * b);
  }
  /// Deflection at x under a unit force at a, with a joint at 0.
  Value deflection(double x, double a, double hinge) const {
    return by_force(x - a) + by_opening(x) * by_opening(a) / (hinge + 0.5 * ei * b);
  }
  double ei;
  Value b;
};

TEST(RailJoint, DeflectsAsAHingeOnABed) {
  for (const double hinge : {0.0, 1e5, 1e6, 1e7}) {
    const FlexibleTrack track = beam_with_joint(hinge);
    const RailOnSeats rail(track);
    const BeamOnBed beam(track, 0.0);
    const double at = track.joints[0].x, most = beam.deflection(0.0, 0.0, hinge).real();
    for (const double a : {0.0, 0.004, 0.3, -0.8}) {
      const std::vector<double> places{at, at + 0.3, at - 0.5, at + 1.1};
      const std::vector<double> found = rail.deflection(at + a, places);
      for (std::size_t i = 0; i < places.size(); ++i)
        EXPECT_NEAR(found[i], beam.deflection(places[i] - at, a, hinge).real(), 1e-3 * most) << hinge << ' ' << a;
    }
  }
  // A hinge lets two ends of beams carry a force, each half of it.
  const BeamOnBed beam(beam_with_joint(0.0), 0.0);
  EXPECT_NEAR(beam.deflection(0.0, 0.0, 0.0).real() / beam.by_force(0.0).real(), 2.0, 1e-12);
}

TEST(RailJoint, HasTheReceptanceOfAHingeOnABed) {
  for (const double hinge : {0.0, 1e6, 1e7}) {
    const FlexibleTrack track = beam_with_joint(hinge);
    const RailOnSeats rail(track);
    for (const double f : {30.0, 100.0, 300.0, 900.0})
      for (const double x : {0.0, 0.01, 0.4}) {
        const Value expected = BeamOnBed(track, f).deflection(x, x, hinge);
        EXPECT_LT(std::abs(rail.receptance(track.joints[0].x + x, f) / expected - 1.0), 0.01)
            << hinge << ' ' << f << " Hz " << x;
      }
  }
}

FlexibleTrack jointed_zhai(double place, double hinge, int elements) {
  FlexibleTrack track = zhai_track(0.6, 60);
  track.bay_elements = elements;
  track.absorbing_bays = 15;
  track.absorption = 2000.0;
  track.joints.push_back({track.seats[29].x + place, hinge});
  return track;
}

/// Elements with a hinge are exact at rest as those without: their number changes nothing, wherever the joint is.
TEST(RailJoint, IsExactAtRest) {
  for (const double place : {0.0, 0.01, 0.15, 0.3, 0.37})
    for (const double hinge : {0.0, 2e6}) {
      const FlexibleTrack few = jointed_zhai(place, hinge, 2), many = jointed_zhai(place, hinge, 24);
      const RailOnSeats a(few), b(many);
      const double at = few.joints[0].x;
      for (const double force : {at, at + 0.02, at - 0.4}) {
        const std::vector<double> places{at, at + 0.11, at - 0.7};
        const std::vector<double> x = a.deflection(force, places), y = b.deflection(force, places);
        // Where neither force nor place is at a node both bend an element beyond its ends.
        const double own = a.receptance(force, 0.0).real();
        EXPECT_NEAR(b.receptance(force, 0.0).real() / own, 1.0, 1e-8) << place << ' ' << force - at;
        EXPECT_NEAR(x[2], y[2], 1e-3 * own);
      }
      EXPECT_GT(a.receptance(at, 0.0).real(), 1.05 * RailOnSeats(zhai_track(0.6, 60)).receptance(at, 0.0).real());
    }
}

TEST(RailJoint, OfStiffFishplatesIsNone) {
  FlexibleTrack plain = jointed_zhai(0.2, 1e14, 8);
  const RailOnSeats stiff(plain);
  const double at = plain.joints[0].x;
  plain.joints.clear();
  const RailOnSeats none(plain);
  for (const double f : {0.0, 300.0, 1200.0})
    EXPECT_LT(std::abs(stiff.receptance(at, f) / none.receptance(at, f) - 1.0), 1e-6) << f;
}

TEST(RailJoint, NeverGivesEnergy) {
  Random random(5);
  FlexibleTrack track = jointed_zhai(0.1, 5e5, 8);
  track.joints.push_back({track.seats[10].x + 0.6 * random.uniform(), 0.0});
  const RailOnSeats rail(track);
  for (int i = 0; i < 200; ++i) {
    const double at = rail.begin() + random.uniform() * (rail.end() - rail.begin()),
                 f = 1.0 + 2000.0 * random.uniform();
    EXPECT_LT(rail.receptance(at, f).imag(), 0.0) << at << " m, " << f << " Hz";
  }
}

TEST(RailJoint, DipsMeetAtTheirAngle) {
  const RailJoint joint{0.0, 0.0, 2e-3, 0.8};
  EXPECT_EQ(joint.depth(0.0), 2e-3);
  EXPECT_EQ(joint.depth(0.8), 0.0);
  EXPECT_EQ(joint.depth(-3.0), 0.0);
  EXPECT_NEAR(joint.depth(-0.01) - joint.depth(-0.02), 0.01 * 2.0 * 2e-3 / 0.8, 1e-6);
}

TEST(RailJoint, RefusesWhatMakesNoSense) {
  const auto refused = [](auto change) {
    FlexibleTrack track = jointed_zhai(0.2, 1e6, 8);
    change(track);
    try {
      const RailOnSeats rail(track);
    } catch (const Error& error) {
      return error.kind() == ErrorKind::configuration;
    }
    return false;
  };
  EXPECT_FALSE(refused([](FlexibleTrack&) {}));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.joints[0].x = 1e3; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.joints[0].x = -0.31; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.joints[0].hinge_stiffness = -1.0; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.joints[0].dip_depth = -1e-3; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.joints[0].dip_length = 0.0; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.joints.push_back({t.joints[0].x + 0.01, 1e6}); }));
}

/// A force that crawls over a joint finds the deflection at rest there, and the dip.
TEST(RailJoint, CrawlingForceDeflectsAsAtRest) {
  constexpr double kForce = 55e3, kSpeed = 0.5;
  FlexibleTrack track = jointed_zhai(0.25, 1e6, 8);
  track.joints[0].dip_depth = 1e-3;
  track.joints[0].dip_length = 0.5;
  const RailOnSeats rest(track);
  MovingRail rail(track, constant_speed(kSpeed), {-1.2}, 1.0);
  const Eigen::VectorXd force = Eigen::Vector3d(0.0, kForce, 0.0);
  rail.begin(force);
  double most = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double time = 2e-3 * i, x = rest.middle() - 1.2 + kSpeed * time;
    const MovingRail::Answer& answer = rail.after(time);
    const double w = answer.free[1] + answer.compliance(1, 1) * kForce;
    rail.accept(force);
    const double expected = kForce * rest.receptance(x, 0.0).real() + track.joints[0].depth(x - track.joints[0].x);
    EXPECT_NEAR(w / expected, 1.0, 5e-3) << time;
    most = std::max(most, w);
  }
  EXPECT_GT(most, 1.5e-3);
}

/// What the force puts into the rail as it passes joints and their dips is stored or dissipated.
TEST(RailJoint, MovingRailKeepsTheBalanceOfItsEnergy) {
  constexpr double kForce = 55e3, kSpeed = 40.0, kStep = 5e-5;
  FlexibleTrack track = jointed_zhai(0.25, 1e6, 8);
  track.joints[0].dip_depth = 1e-3;
  track.joints.push_back({track.seats[36].x + 0.1, 0.0, 5e-4, 0.4});
  MovingRail rail(track, constant_speed(kSpeed), {0.0}, 1.0);
  const Eigen::VectorXd force = Eigen::Vector3d(0.0, kForce, 0.0);
  rail.begin(force);
  double energy = rail.moved_at_rest(force).energy, put_in = 0.0, dissipated = 0.0;
  double deflection = rail.motions_at_rest().free[1] + kForce * rail.motions_at_rest().compliance(1, 1);
  const double at_start = energy;
  for (int i = 1; i <= 4000; ++i) {
    const MovingRail::Answer& answer = rail.after(kStep * i);
    const double w = answer.free[1] + answer.compliance(1, 1) * kForce, slope = rail.slope(0, force).y();
    const MovingRail::Moved moved = rail.moved(force);
    put_in += kForce * (w - deflection - kSpeed * kStep * slope);
    dissipated += kStep * moved.power;
    deflection = w;
    energy = moved.energy;
    rail.accept(force);
  }
  EXPECT_GT(dissipated, 5.0);
  EXPECT_NEAR(put_in, dissipated + energy - at_start, 1e-5 * dissipated);
}

VehicleOnTrack before_joint(const FlexibleTrack& track, double speed, double ahead) {
  VehicleOnTrack v = on_hertz_springs(wheel_on_mass(1813.0, 9000.0, 2e6, 1e4), {}, speed, kJointContact);
  const double load = 0.5 * v.system.wheelset_load[0], start = track.joints[0].x - ahead - RailOnSeats(track).middle();
  for (WheelOnRail& wheel : v.wheels) {
    const auto rail =
        std::make_shared<LoadedRail>(MovingRail(track, constant_speed(speed), {start}, 1.0), std::vector{load});
    wheel.element = std::make_shared<ContactOnRail>(wheel.element, rail, 0, 1e-8, wheel.rail_marker, 0.46);
  }
  return v;
}

/// Forces of a wheel that passes a small dip, by superposition of its waves: -(wheel + 1/k + rail)^-1 times them, and
/// the low-frequency peak by the formula of Jenkins, Stephenson, Clayton, Morland & Lyon (1974):
///   P2 = P0 + 2 alpha V sqrt(Mu/(Mu + Mt)) (1 - pi Ct/(4 sqrt(Kt (Mu + Mt)))) sqrt(Kt Mu).
TEST(RailJoint, PeaksOfADipAreThoseOfTheLinearSystem) {
  constexpr double kSpeed = 40.0, kDepth = 25e-6, kLength = 1.0, kAhead = 2.0, kStep = 2e-5;
  FlexibleTrack track = beam_with_joint(1e14);  // stiff, the same everywhere
  track.joints[0].dip_depth = kDepth;
  track.joints[0].dip_length = kLength;
  const VehicleOnTrack v = before_joint(track, kSpeed, kAhead);
  Simulation s(v, find_equilibrium(v).state, equal_steps(0.1, kStep, 1e-6));
  const double load = 0.5 * v.system.wheelset_load[0],
               stiffness = 1.5 * std::pow(kJointContact, 2.0 / 3.0) * std::cbrt(load);
  constexpr double kUnsprung = 0.5 * 1813.0;

  constexpr double kPeriod = 0.5, kHighest = 8000.0;
  std::vector<Value> spectrum;
  for (int n = 1; n <= static_cast<int>(kHighest * kPeriod); ++n) {
    const double f = n / kPeriod, w = 2.0 * kPi * f, tau = kLength / kSpeed;
    const double dip = 4.0 * kDepth / (w * w * tau) * (1.0 - std::sin(w * tau) / (w * tau));
    const Value spring(1e6, w * 5e3), upper = -4500.0 * w * w, held = spring * upper / (spring + upper);
    const Value flexibility = 1.0 / (held - kUnsprung * w * w) + 1.0 / stiffness + BeamOnBed(track, f).by_force(0.0);
    spectrum.push_back(-dip / flexibility / kPeriod);
  }
  const auto expected = [&](double time) {  // from the joint
    double sum = 0.0;
    for (std::size_t n = 0; n < spectrum.size(); ++n)
      sum += 2.0 * (spectrum[n] * std::exp(Value(0.0, 2.0 * kPi * static_cast<double>(n + 1) / kPeriod * time))).real();
    return sum;
  };
  double first = 0.0, second = 0.0, first_expected = 0.0, second_expected = 0.0;
  for (int i = 0; !s.finished(); ++i) {
    s.advance();
    const double time = s.state().time - kAhead / kSpeed, force = s.reactions()[0].normal_force - load;
    if (time < 0.0 || time > 0.03) continue;
    (time < 1e-3 ? first : second) = std::max(time < 1e-3 ? first : second, force);
    if (time > 1e-3 && i % 5 != 0) continue;
    double& most = time < 1e-3 ? first_expected : second_expected;
    most = std::max(most, expected(time));
  }
  EXPECT_NEAR(first / first_expected, 1.0, 0.03) << first;
  EXPECT_NEAR(second / second_expected, 1.0, 0.03) << second;

  const double bed = track.seats[0].pad_stiffness / kJointBay,
               beta = std::pow(0.25 * bed / track.rail.bending_stiffness, 0.25);
  const double effective = 1.5 / beta;  // length of the deflected rail by its squared shape
  const double kt = 2.0 * bed / beta, mt = track.rail.mass * effective,
               ct = track.seats[0].pad_damping / kJointBay * effective;
  const double angle = 4.0 * kDepth / kLength;
  const double jenkins = angle * kSpeed * std::sqrt(kUnsprung / (kUnsprung + mt)) *
                         (1.0 - kPi * ct / (4.0 * std::sqrt(kt * (kUnsprung + mt)))) * std::sqrt(kt * kUnsprung);
  EXPECT_NEAR(second / jenkins, 1.0, 0.25) << second << ' ' << jenkins;
}

TEST(RailJoint, EnergyOfAWheelThatPassesIsBalanced) {
  FlexibleTrack track = jointed_zhai(0.25, 5e5, 8);
  track.joints[0].dip_depth = 1e-3;
  track.joints[0].dip_length = 0.6;
  const VehicleOnTrack v = before_joint(track, 20.0, 1.0);
  Simulation s(v, find_equilibrium(v).state, equal_steps(0.2, 1e-5, 1e-6));
  double most = 0.0;
  while (!s.finished()) s.advance(), most = std::max(most, s.reactions()[0].normal_force);
  EXPECT_GT(most, 1.5 * 0.5 * v.system.wheelset_load[0]);
  EXPECT_GT(s.energy().turnover, 10.0);
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
  EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
}

}  // namespace
}  // namespace treadmark::vehicle
