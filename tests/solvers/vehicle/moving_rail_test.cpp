// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/moving_rail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "beam_on_bed.hpp"
#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_on_rail.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kBendingContact = 9e10;  // [N/m^1.5]

FlexibleTrack short_zhai(int seats = 60, int elements = 8) {
  FlexibleTrack track = zhai_track(0.545, seats);
  track.bay_elements = elements;
  track.absorbing_bays = 15;
  track.absorption = 2000.0;
  return track;
}

/// A rail below a single force.
class OneForce {
 public:
  struct Answer {
    double free, compliance;
  };
  struct Moved {
    double slope, energy, power;
  };
  OneForce(const FlexibleTrack& track, double speed, double start, double radius,
           double length = MovingRail::kUsualLength)
      : rail_(track, constant_speed(speed), {start}, radius, length) {}
  double compliance_at_rest() const { return rail_.motions_at_rest().compliance(1, 1); }
  double energy_at_rest(double force) const { return rail_.moved_at_rest(column(force)).energy; }
  Answer after(double time) {
    const MovingRail::Answer& a = rail_.after(time);
    return {a.free[1], a.compliance(1, 1)};
  }
  Moved moved(double force) {
    const MovingRail::Moved m = rail_.moved(column(force));
    return {rail_.slope(0, column(force)).y(), m.energy, m.power};
  }
  void begin(double force) { rail_.begin(column(force)); }
  void accept(double force) { rail_.accept(column(force)); }
  void accept(double force, double ahead) { rail_.accept(column(force), {ahead}); }

 private:
  static Eigen::VectorXd column(double force) { return Eigen::Vector3d(0.0, force, 0.0); }
  MovingRail rail_;
};

FlexibleTrack uneven_zhai() {
  FlexibleTrack track = short_zhai(80);
  for (std::size_t i = 0; i < track.seats.size(); ++i) {
    track.seats[i].x += 0.06 * std::sin(2.1 * static_cast<double>(i));
    track.seats[i].pad_stiffness *= i % 3 == 0 ? 0.4 : 1.2;
  }
  track.seats[40].bed_stiffness = track.seats[41].bed_stiffness = 0.0;
  return track;
}

/// A force that crawls finds the deflection at rest at every place, also where the rail that is looked at has moved on,
/// over hanging sleepers and on unequal ones.
TEST(MovingRail, CrawlingForceDeflectsAsAtRest) {
  constexpr double kForce = 55e3, kSpeed = 0.5, kStart = 0.1;
  for (const FlexibleTrack& track : {short_zhai(), uneven_zhai()}) {
    const RailOnSeats rest(track);
    OneForce rail(track, kSpeed, kStart, 0.8);
    const double from = rest.middle() + kStart;
    EXPECT_NEAR(rail.compliance_at_rest() / rest.receptance(from, 0.0).real(), 1.0, 2e-3);  // dampers at 0.5 m/s
    rail.begin(kForce);
    double least = 1.0, most = 0.0;
    for (int i = 1; i <= 1800; ++i) {
      const double time = 2e-3 * i;
      const OneForce::Answer answer = rail.after(time);
      const double w = answer.free + answer.compliance * kForce;
      rail.accept(kForce);
      if (i % 40 != 0) continue;
      const double expected = kForce * rest.receptance(from + kSpeed * time, 0.0).real();
      EXPECT_NEAR(w / expected, 1.0, 3e-3) << time;
      least = std::min(least, w), most = std::max(most, w);
    }
    if (track.seats[40].bed_stiffness == 0.0) {
      EXPECT_GT(most, 1.3 * least);
    }
  }
}

/// A force that runs ahead of the speed that is given is where it is.
TEST(MovingRail, GoesOnWithAForceThatRunsAhead) {
  constexpr double kForce = 55e3, kSpeed = 0.5, kAhead = 0.15;
  const FlexibleTrack track = uneven_zhai();
  const RailOnSeats rest(track);
  OneForce rail(track, kSpeed, 0.0, 0.8);
  rail.begin(kForce);
  double largest = 0.0;
  for (int i = 1; i <= 1800; ++i) {
    const double time = 2e-3 * i, ahead = kAhead * time, without = rest.middle() + kSpeed * time;
    const OneForce::Answer answer = rail.after(time);
    const double w = (answer.free + answer.compliance * kForce) / kForce;
    rail.accept(kForce, ahead);
    if (i % 40 != 0) continue;
    EXPECT_NEAR(w / rest.receptance(without + ahead, 0.0).real(), 1.0, 4e-3) << time;
    largest = std::max(largest, std::abs(w / rest.receptance(without, 0.0).real() - 1.0));
  }
  EXPECT_GT(largest, 0.05);
}

/// Beyond its seats a track goes on with those at its ends.
TEST(MovingRail, ContinuesTheTrack) {
  FlexibleTrack few = short_zhai(12), many = short_zhai(300);
  few.absorbing_bays = many.absorbing_bays = 3;
  constexpr double kSpeed = 30.0, kForce = 55e3, kBay = 0.545;
  // Both begin at the same place of an equal bay.
  OneForce a(few, kSpeed, 7.0 * kBay, 0.8), b(many, kSpeed, 0.0, 0.8);
  EXPECT_NEAR(a.compliance_at_rest() / b.compliance_at_rest(), 1.0, 1e-9);
  a.begin(kForce), b.begin(kForce);
  for (int i = 1; i <= 2000; ++i) {
    const double force = kForce * (1.0 + 0.5 * std::sin(0.1 * i)), time = 1e-4 * i;
    const OneForce::Answer x = a.after(time), y = b.after(time);
    a.accept(force), b.accept(force);
    ASSERT_NEAR((x.free + x.compliance * force) / (y.free + y.compliance * force), 1.0, 1e-7) << time;
  }
}

/// A force that hardly moves meets the receptance of the place.
TEST(MovingRail, HarmonicForceMeetsTheReceptance) {
  const FlexibleTrack track = short_zhai();
  const RailOnSeats rest(track);
  constexpr double kStart = 0.11;
  for (const double f : {60.0, 300.0, 900.0}) {
    OneForce rail(track, 1e-6, kStart, 1.0);
    rail.begin(0.0);
    const double w = 2.0 * kPi * f, step = 1.0 / (200.0 * f);
    std::complex<double> found = 0.0;
    const int periods = static_cast<int>(0.15 * f);
    for (int i = 1; i <= 200 * periods; ++i) {
      const double time = i * step, force = std::cos(w * time);
      const OneForce::Answer answer = rail.after(time);
      rail.accept(force);
      if (i > 200 * (periods - 2))
        found += (answer.free + answer.compliance * force) * std::exp(std::complex<double>(0.0, -w * time)) / 200.0;
    }
    EXPECT_LT(std::abs(found / rest.receptance(rest.middle() + kStart, f) - 1.0), 0.01) << f << " Hz";
  }
}

/// What the force puts into the rail is stored or dissipated, over 15 sleepers and as many elements and windows as
/// there are.
TEST(MovingRail, KeepsTheBalanceOfItsEnergy) {
  constexpr double kForce = 55e3, kSpeed = 40.0, kStep = 5e-5;
  OneForce rail(uneven_zhai(), kSpeed, 0.0, 1.0);
  rail.begin(kForce);
  double energy = rail.energy_at_rest(kForce), deflection = kForce * rail.compliance_at_rest();
  double put_in = 0.0, dissipated = 0.0;
  const double at_start = energy;
  for (int i = 1; i <= 4000; ++i) {
    const OneForce::Answer answer = rail.after(kStep * i);
    const OneForce::Moved moved = rail.moved(kForce);
    const double w = answer.free + answer.compliance * kForce;
    put_in += kForce * (w - deflection - kSpeed * kStep * moved.slope);
    dissipated += kStep * moved.power;
    deflection = w;
    energy = moved.energy;
    rail.accept(kForce);
  }
  EXPECT_GT(dissipated, 5.0);
  EXPECT_NEAR(put_in, dissipated + energy - at_start, 1e-5 * dissipated);
}

/// Frýba's closed form for Euler's beam on a bed: the deflection under a force grows by 1/sqrt(1 - (V/c)^2) with the
/// critical speed c = (4 k E I/m2)^(1/4), until it has left its start behind.
TEST(MovingRail, FastForceOnABed) {
  FlexibleTrack track = zhai_track(0.08, 500);
  track.rail.shear_stiffness *= 1e3;
  track.rail.rotary_inertia = 0.0;
  track.bay_elements = 2;
  track.absorbing_bays = 150;
  track.absorption = 4000.0;
  const double bed = 65e6 / 0.545;
  for (RailSeat& seat : track.seats) seat = {seat.x, bed * 0.08, 0.0, 1.0, 1e13, 0.0};
  const double b = track.rail.bending_stiffness;
  const double critical = std::pow(4.0 * bed * b / (track.rail.mass * track.rail.mass), 0.25);
  const double at_rest = 1.0 / (2.0 * std::sqrt(2.0) * std::pow(b, 0.25) * std::pow(bed, 0.75));
  for (const double share : {0.3, 0.5}) {
    const double speed = share * critical;
    OneForce rail(track, speed, 0.0, 0.9, 40.0);
    rail.begin(1.0);
    const double step = 0.01 / speed;
    double mean = 0.0;
    constexpr int kSteps = 4000, kAveraged = 1600;
    for (int i = 1; i <= kSteps; ++i) {
      const OneForce::Answer answer = rail.after(i * step);
      rail.accept(1.0);
      if (i > kSteps - kAveraged) mean += (answer.free + answer.compliance) / kAveraged;
    }
    EXPECT_NEAR(mean / at_rest * std::sqrt(1.0 - share * share), 1.0, 0.01) << share;
  }
}

TEST(MovingRail, RefusesWhatItCannotFollow) {
  const auto made = [](double speed, std::vector<double> start, double radius, double length = 30.0) {
    return MovingRail(short_zhai(), constant_speed(speed), start, radius, length);
  };
  EXPECT_NO_THROW(made(20.0, {0.0}, 0.8));
  EXPECT_NO_THROW(made(20.0, {0.0, -0.1}, 0.8));
  EXPECT_THROW(made(20.0, {}, 0.8), Error);
  EXPECT_THROW(made(0.0, {0.0}, 0.8), Error);
  EXPECT_THROW(made(20.0, {0.0}, 0.1), Error);
  EXPECT_THROW(made(20.0, {1e7}, 0.8), Error);
  EXPECT_THROW(made(20.0, {0.0}, 0.8, 1e9), Error);
  EXPECT_THROW(made(20.0, {0.0, -0.06}, 0.8), Error);
}

/// A wheelset with a mass upon it, each wheel on a rail of its own.
VehicleOnTrack on_bending_rails(const FlexibleTrack& track, double speed, double tolerance) {
  VehicleOnTrack v = on_hertz_springs(wheel_on_mass(1813.0, 9000.0, 2e6, 1e4), {}, speed, kBendingContact);
  const double load = 0.5 * v.system.wheelset_load[0];
  for (WheelOnRail& wheel : v.wheels) {
    const auto rail =
        std::make_shared<LoadedRail>(MovingRail(track, constant_speed(speed), {0.0}, 1.0), std::vector<double>{load});
    wheel.element = std::make_shared<ContactOnRail>(wheel.element, rail, 0, tolerance, wheel.rail_marker, 0.46);
  }
  return v;
}

TEST(ContactOnRail, EquilibriumRestsOnTheDeflectedRail) {
  const FlexibleTrack track = short_zhai();
  const VehicleOnTrack v = on_bending_rails(track, 20.0, 1e-9);
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok);
  const RailOnSeats rest(track);
  const double load = 0.5 * (1813.0 + 9000.0) * kGravity;
  EXPECT_NEAR(e.state.q[1],
              load * rest.receptance(rest.middle(), 0.0).real() + std::pow(load / kBendingContact, 2.0 / 3.0), 1e-8);
}

TEST(ContactOnRail, EnergyIsBalanced) {
  const VehicleOnTrack v = on_bending_rails(short_zhai(), 20.0, 1e-8);
  SystemState start = find_equilibrium(v).state;
  start.q[0] += 0.01;
  Simulation s(v, start, equal_steps(0.3, 2e-5));
  while (!s.finished()) s.advance();
  EXPECT_GT(s.energy().turnover, 10.0);
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
  EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-5 * s.energy().turnover);
}

TEST(ContactOnRail, GoesOnWithTheSameBits) {
  const SimulationSettings settings = equal_steps(0.15, 5e-5);
  const VehicleOnTrack first = on_bending_rails(short_zhai(), 20.0, 1e-6);
  const auto start_of = [](const VehicleOnTrack& v) {
    SystemState state = find_equilibrium(v).state;
    state.q[0] += 0.01;
    return state;
  };
  Simulation whole(first, start_of(first), settings);
  ByteWriter saved;
  for (int i = 0; !whole.finished(); ++i) {
    if (i == 1500) whole.save(saved);
    whole.advance();
  }
  const VehicleOnTrack second = on_bending_rails(short_zhai(), 20.0, 1e-6);
  Simulation rest(second, start_of(second), settings);
  ByteReader reader(saved.bytes());
  rest.restore(reader);
  EXPECT_TRUE(reader.at_end());
  while (!rest.finished()) rest.advance();
  EXPECT_EQ(rest.state().q, whole.state().q);
  EXPECT_EQ(rest.energy().elastic, whole.energy().elastic);
  EXPECT_EQ(rest.counts().steps, whole.counts().steps);
}

}  // namespace
}  // namespace treadmark::vehicle
