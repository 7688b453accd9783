// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "beam_on_bed.hpp"
#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_on_rail.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"

// Rails that bend sideways and twist.

namespace treadmark::vehicle {
namespace {

using Phasor = std::complex<double>;
using Dense2 = Eigen::Matrix2cd;

/// A rail of 60 kg/m; sleepers so held sideways that pads and ballast share the deflection.
FlexibleTrack side_track(double spacing = 0.545, int seats = 120, int bay_elements = 8) {
  FlexibleTrack track = zhai_track(spacing, seats);
  track.bay_elements = bay_elements;
  track.sideways = RailSideways{1.08e6, 245e6, 0.041, 1.7e5, 0.294, 0.176, 0.081, 0.045};
  const double share = spacing / 0.545;
  for (RailSeat& seat : track.seats) {
    seat.lateral_pad_stiffness = share * 20e6;
    seat.lateral_pad_damping = share * 50e3;
    seat.roll_stiffness = share * 1.2e5;
    seat.roll_damping = share * 150.0;
    seat.lateral_bed_stiffness = share * 15e6;
    seat.lateral_bed_damping = share * 60e3;
  }
  return track;
}

/// Neither seats nor mass couple bending with torsion about the foot.
FlexibleTrack uncoupled(FlexibleTrack track) {
  track.sideways->centroid = track.sideways->shear_centre = 0.0;
  return track;
}

FlexibleTrack calm_ends(FlexibleTrack track, int bays, double absorption = 2000.0) {
  track.absorbing_bays = bays;
  track.absorption = absorption;
  return track;
}

RailBeam side_beam(const FlexibleTrack& track) {
  return {track.sideways->bending_stiffness, track.sideways->shear_stiffness, track.rail.mass,
          track.sideways->rotary_inertia, 0.0};
}

/// Stiffness of pad and half a sleeper on its bed, one seat.
Phasor side_spring(const RailSeat& seat, double w) {
  const Phasor pad(seat.lateral_pad_stiffness, w * seat.lateral_pad_damping),
      below(seat.lateral_bed_stiffness - w * w * seat.sleeper_mass, w * seat.lateral_bed_damping);
  return pad * below / (pad + below);
}

/// Rotation at a distance from a unit moment on an infinite bar: 1/(2 G J g) exp(-g x), g2 = (bed - rho Ip w2)/(G J).
Phasor infinite_bar(double torsional_stiffness, Phasor bed_less_inertia, double distance) {
  Phasor g = std::sqrt(bed_less_inertia / torsional_stiffness);
  if (g.real() < 0.0) g = -g;
  return std::exp(-g * distance) / (2.0 * torsional_stiffness * g);
}

/// Of motions y and roll of the top at a height above the axis whose deflection and rotation these are.
Dense2 at_top(const Dense2& of_axis, double above) {
  Dense2 arm = Dense2::Identity();
  arm(0, 1) = above;
  return arm * of_axis * arm.transpose();
}

double largest_error(const Eigen::MatrixXcd& found, const Dense2& expected) {
  double most = 0.0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) most = std::max(most, std::abs(found(i, j) / expected(i, j) - 1.0));
  return most;
}

Dense2 uncoupled_on_bed(const FlexibleTrack& track, double spacing, double w) {
  const RailSeat& seat = track.seats[0];
  Dense2 axis = Dense2::Zero();
  axis(0, 0) = infinite_beam(side_beam(track), side_spring(seat, w) / spacing, w);
  axis(1, 1) = infinite_bar(
      track.sideways->torsional_stiffness,
      Phasor(seat.roll_stiffness, w * seat.roll_damping) / spacing - w * w * track.sideways->polar_inertia, 0.0);
  return at_top(axis, track.sideways->height);
}

/// Coordinates of a place are those of its elements' ends, and nothing is written beyond them.
TEST(RailSideways, PlacesNameAsManyCoordinatesAsTheyHaveRows) {
  const FlexibleTrack track = side_track(0.6, 12, 2);
  std::vector<Eigen::Index> sizes;
  for (const RailPlane plane : {RailPlane::vertical, RailPlane::sideways}) {
    const RailOnSeats rail(track, plane, 0.1);
    for (double x = rail.begin() + 0.011; x < rail.end(); x += 0.0173) {
      const RailOnSeats::Place place = rail.place(x);
      sizes.push_back(place.value.rows());
      for (std::size_t i = 0; i < place.coordinate.size(); ++i) {
        if (i < static_cast<std::size_t>(place.value.rows())) {
          ASSERT_GE(place.coordinate[i], i > 0 ? place.coordinate[i - 1] + 1 : 0) << x;
          ASSERT_LT(place.coordinate[i], rail.size()) << x;
        } else {
          ASSERT_EQ(place.coordinate[i], 0) << x;
        }
      }
    }
  }
  for (const Eigen::Index rows : {4, 6, 9}) EXPECT_NE(ranges::find(sizes, rows), sizes.end()) << rows;
}

/// Bending by Timoshenko's beam on a bed, torsion by a bar on an elastic bed.
TEST(RailSideways, ReceptancesAreThoseOfBeamAndBarOnABed) {
  constexpr double kSpacing = 0.02;
  const FlexibleTrack track = calm_ends(uncoupled(side_track(kSpacing, 1601, 2)), 400);
  const RailOnSeats rail(track, RailPlane::sideways);
  const double places[] = {track.seats[800].x};
  for (const double f : {0.0, 10.0, 50.0, 100.0, 200.0, 300.0, 500.0, 700.0, 1000.0, 1500.0}) {
    const Dense2 expected = uncoupled_on_bed(track, kSpacing, 2.0 * kPi * f);
    EXPECT_LT(largest_error(rail.receptances(places, f)[0], expected), f == 0.0 ? 1e-3 : 3e-3) << f << " Hz";
  }
}

/// All coupled, by Fourier's integral over the wave number k: sections move by v, turn by psi and roll by phi,
///   S (k2 v - i k psi) - m w2 (v + e phi) + Z (v - s phi) = 1 and so on.
Dense2 coupled_on_bed(const FlexibleTrack& track, double spacing, double w) {
  const RailSideways& side = *track.sideways;
  const RailSeat& seat = track.seats[0];
  const double m = track.rail.mass, e = side.centroid - side.shear_centre, s = side.shear_centre, w2 = w * w;
  const Phasor z = side_spring(seat, w) / spacing, roll = Phasor(seat.roll_stiffness, w * seat.roll_damping) / spacing;
  constexpr int kPoints = 200000;
  constexpr double kScale = 3.0;  // [1/m]
  Dense2 sum = Dense2::Zero();
  for (int i = 0; i < kPoints; ++i) {
    const double t = 0.5 * kPi * (i + 0.5) / kPoints, k = kScale * std::tan(t), k2 = k * k;
    const double shear = side.shear_stiffness, turned = side.bending_stiffness * k2 + shear - side.rotary_inertia * w2;
    Dense2 d;
    d(0, 0) = shear * k2 - shear * shear * k2 / turned - m * w2 + z;
    d(0, 1) = d(1, 0) = -m * e * w2 - s * z;
    d(1, 1) = side.torsional_stiffness * k2 - (side.polar_inertia + m * e * e) * w2 + s * s * z + roll;
    sum += kScale / (std::cos(t) * std::cos(t)) * d.inverse();
  }
  return at_top(sum * (0.5 * kPi / kPoints / kPi), side.height - side.shear_centre);
}

TEST(RailSideways, CoupledReceptancesAreThoseOfFouriersIntegral) {
  constexpr double kSpacing = 0.02;
  const FlexibleTrack track = calm_ends(side_track(kSpacing, 1601, 2), 400);
  const RailOnSeats rail(track, RailPlane::sideways);
  const double places[] = {track.seats[800].x};
  for (const double f : {0.0, 20.0, 100.0, 200.0, 400.0, 700.0, 1000.0, 1500.0}) {
    const Dense2 expected = coupled_on_bed(track, kSpacing, 2.0 * kPi * f);
    const Eigen::MatrixXcd found = rail.receptances(places, f)[0];
    EXPECT_LT(largest_error(found, expected), f == 0.0 ? 2e-3 : 5e-3) << f << " Hz";
    EXPECT_LT(std::abs(found(0, 1) - found(1, 0)), 1e-9 * std::abs(found(0, 1)));
    // Coupling is felt.
    EXPECT_GT(largest_error(uncoupled_on_bed(uncoupled(track), kSpacing, 2.0 * kPi * f), expected), 0.05);
  }
}

/// On single seats, unequal ones and hanging ones too, by superposition: beam and bar are free, and each seat answers
/// deflection and rotation at its foot, below the axis (Heckl 1995 for bending).
Dense2 side_on_points(const FlexibleTrack& track, double x, double w) {
  const RailSideways& side = *track.sideways;
  const auto free = [&](double distance) {
    Dense2 axis = Dense2::Zero();
    axis(0, 0) = infinite_beam(side_beam(track), Phasor(0.0, 1e-9 * w * w * track.rail.mass), w, distance);
    axis(1, 1) = infinite_bar(side.torsional_stiffness, w * w * side.polar_inertia * Phasor(-1.0, 1e-9), distance);
    return axis;
  };
  const auto n = static_cast<Eigen::Index>(track.seats.size());
  const auto seat = [&](Eigen::Index i) -> const RailSeat& { return track.seats[static_cast<std::size_t>(i)]; };
  Eigen::MatrixXcd system = Eigen::MatrixXcd::Identity(2 * n, 2 * n), under(2 * n, 2), back(2, 2 * n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Phasor z = side_spring(seat(j), w);
    Dense2 stiffness;
    stiffness << z, -side.shear_centre * z, -side.shear_centre * z,
        side.shear_centre * side.shear_centre * z + Phasor(seat(j).roll_stiffness, w * seat(j).roll_damping);
    under.middleRows<2>(2 * j) = free(std::abs(seat(j).x - x));
    back.middleCols<2>(2 * j) = free(std::abs(seat(j).x - x)) * stiffness;
    for (Eigen::Index i = 0; i < n; ++i)
      system.block<2, 2>(2 * i, 2 * j) += free(std::abs(seat(i).x - seat(j).x)) * stiffness;
  }
  const Dense2 axis = free(0.0) - back * system.partialPivLu().solve(under);
  return at_top(axis, side.height - side.shear_centre);
}

FlexibleTrack on_foot(FlexibleTrack track) {
  track.sideways->centroid = track.sideways->shear_centre;  // the free rail is not coupled, its seats are
  return track;
}

TEST(RailSideways, ReceptancesAreThoseOfASuperpositionOfSeats) {
  FlexibleTrack even = on_foot(side_track(0.545, 80, 32)), uneven = even;
  for (std::size_t i = 0; i < uneven.seats.size(); ++i) {
    uneven.seats[i].x += 0.08 * std::sin(2.1 * static_cast<double>(i));
    uneven.seats[i].lateral_pad_damping = 20e3;
    uneven.seats[i].lateral_bed_stiffness *= i % 7 == 3 ? 0.0 : 1.0;
  }
  for (const FlexibleTrack& track : {even, uneven}) {
    const RailOnSeats rail(calm_ends(track, 20), RailPlane::sideways);
    // Away from 700 Hz, where half a wave of torsion fits between sleepers.
    for (const double f : {40.0, 100.0, 300.0, 550.0, 1000.0, 1500.0})
      for (const double part : {-0.5, -0.22, 0.0}) {
        const double x[] = {rail.middle() + part * rail.middle_bay()};
        EXPECT_LT(largest_error(rail.receptances(x, f)[0], side_on_points(track, x[0], 2.0 * kPi * f)), 0.02)
            << f << " Hz, " << part;
      }
  }
}

TEST(RailSideways, PinnedPinnedFrequencyIsThatOfTheBeam) {
  for (const double spacing : {0.545, 0.7}) {
    FlexibleTrack track = uncoupled(side_track(spacing, 121, 16));
    track.sideways->height = 1e-6;  // at the axis
    for (RailSeat& seat : track.seats) seat.lateral_pad_damping = 5e3;
    const RailOnSeats rail(calm_ends(track, 30), RailPlane::sideways);
    const double expected = pinned_pinned_frequency(beam_in(track, RailPlane::sideways), spacing);
    double peak = 0.0, at = 0.0;
    for (double f = 0.8 * expected; f < 1.2 * expected; f += 2e-3 * expected) {
      const double between = std::abs(rail.receptance(rail.middle(), f));
      if (between > peak) peak = between, at = f;
    }
    EXPECT_NEAR(at / expected, 1.0, 0.01) << spacing;
    EXPECT_GT(peak, 3.0 * std::abs(rail.receptance(rail.middle() + 0.5 * spacing, at))) << spacing;
  }
}

TEST(RailSideways, NeverGivesEnergy) {
  const FlexibleTrack track = calm_ends(side_track(0.6, 40), 8);
  const RailOnSeats rail(track, RailPlane::sideways);
  for (int i = 0; i < 60; ++i) {
    const double x[] = {rail.begin() + (rail.end() - rail.begin()) * (i + 0.5) / 60.0}, f = 3.0 + 37.0 * i;
    const Eigen::MatrixXcd found = rail.receptances(x, f)[0];
    const Eigen::Matrix2d taken = -0.5 * (found + found.transpose()).imag();
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(taken).eigenvalues().minCoeff(), 0.0) << f;
  }
}

TEST(RailSideways, RefusesWhatMakesNoSense) {
  const auto refused = [](auto change) {
    FlexibleTrack track = side_track(0.6, 20);
    change(track);
    EXPECT_THROW(RailOnSeats(track, RailPlane::sideways), Error);
  };
  refused([](FlexibleTrack& t) { t.sideways.reset(); });
  refused([](FlexibleTrack& t) { t.sideways->torsional_stiffness = 0.0; });
  refused([](FlexibleTrack& t) { t.sideways->centroid = 0.2; });
  refused([](FlexibleTrack& t) { t.seats[3].roll_stiffness = -1.0; });
  refused([](FlexibleTrack& t) { t.seats[3].lateral_pad_stiffness = t.seats[3].lateral_bed_stiffness = 0.0; });
}

/// Lateral forces and moments that hardly move meet the receptances of the place.
TEST(RailSidewaysInTime, HarmonicForcesMeetTheReceptances) {
  FlexibleTrack track = calm_ends(side_track(0.545, 60), 15);
  track.rail.damping_time = 20e-6;  // so that ends do not count
  const RailOnSeats rest(track, RailPlane::sideways);
  constexpr double kStart = 0.11;
  const double x[] = {rest.middle() + kStart};
  constexpr int kSteps = 100;  // a period
  for (const double f : {60.0, 300.0, 600.0})
    for (const Eigen::Index by : {0, 2}) {
      MovingRail rail(track, constant_speed(1e-6), {kStart}, 1.0);
      rail.begin(Eigen::Vector3d::Zero());
      const double w = 2.0 * kPi * f, step = 1.0 / (kSteps * f);
      Eigen::Vector3cd found = Eigen::Vector3cd::Zero();
      const int periods = static_cast<int>(0.1 * f);
      for (int i = 1; i <= kSteps * periods; ++i) {
        const double time = i * step;
        const Eigen::Vector3d force = std::cos(w * time) * Eigen::Vector3d::Unit(by);
        const MovingRail::Answer& answer = rail.after(time);
        const Eigen::Vector3d motion = answer.free + answer.compliance * force;
        rail.accept(force);
        if (i > kSteps * (periods - 2))
          found += motion * std::exp(Phasor(0.0, -w * time)) / static_cast<double>(kSteps);
      }
      const Eigen::MatrixXcd expected = rest.receptances(x, f)[0];
      EXPECT_LT(std::abs(found[0] / expected(0, by / 2) - 1.0), 0.012) << f << " Hz";
      EXPECT_LT(std::abs(found[2] / expected(1, by / 2) - 1.0), 0.012) << f << " Hz";
      EXPECT_EQ(found[1], 0.0);
    }
}

TEST(RailSidewaysInTime, CrawlingForceDeflectsAsAtRest) {
  FlexibleTrack track = calm_ends(side_track(0.545, 80), 15);
  for (std::size_t i = 0; i < track.seats.size(); ++i)
    track.seats[i].x += 0.05 * std::sin(2.1 * static_cast<double>(i));
  const RailOnSeats rest(track, RailPlane::sideways);
  constexpr double kSpeed = 0.5, kStart = 0.1;
  MovingRail rail(track, constant_speed(kSpeed), {kStart}, 0.8);
  const Eigen::Vector3d force(8e3, 0.0, 300.0);
  rail.begin(force);
  for (int i = 1; i <= 1500; ++i) {
    const double time = 2e-3 * i, x[] = {rest.middle() + kStart + kSpeed * time};
    const MovingRail::Answer& answer = rail.after(time);
    const Eigen::Vector3d motion = answer.free + answer.compliance * force;
    rail.accept(force);
    if (i % 50 != 0) continue;
    const Eigen::Vector2d expected = rest.receptances(x, 0.0)[0].real() * Eigen::Vector2d(force[0], force[2]);
    EXPECT_NEAR(motion[0] / expected[0], 1.0, 4e-3) << time;
    EXPECT_NEAR(motion[2] / expected[1], 1.0, 4e-3) << time;
  }
}

/// What constant forces put into the rail is stored or dissipated, at changing speed too.
TEST(RailSidewaysInTime, KeepsTheBalanceOfItsEnergy) {
  constexpr double kStep = 5e-5;
  for (const SpeedProfile& speed : {constant_speed(40.0), SpeedProfile{{0.0, 0.05, 0.15}, {40.0, 20.0, 50.0}}}) {
    MovingRail rail(calm_ends(side_track(0.545, 80), 15), speed, {0.0}, 1.0);
    const Eigen::Vector3d force(20e3, 55e3, 800.0);
    rail.begin(force);
    double energy = rail.moved_at_rest(force).energy, put_in = 0.0, dissipated = 0.0;
    Eigen::Vector3d motion = rail.motions_at_rest().compliance * force;
    const double at_start = energy;
    for (int i = 1; i <= 4000; ++i) {
      const MovingRail::Answer& answer = rail.after(kStep * i);
      const Eigen::Vector3d now = answer.free + answer.compliance * force;
      const double travelled = travel_at(speed, kStep * i).distance - travel_at(speed, kStep * (i - 1)).distance;
      const MovingRail::Moved moved = rail.moved(force);
      put_in += force.dot(now - motion - travelled * rail.slope(0, force));
      dissipated += kStep * moved.power;
      motion = now;
      energy = moved.energy;
      rail.accept(force);
    }
    EXPECT_GT(dissipated, 5.0);
    EXPECT_NEAR(put_in, dissipated + energy - at_start, 2e-5 * dissipated);
  }
}

/// A speed that a profile keeps is a constant one.
TEST(RailSidewaysInTime, AFlatProfileIsAConstantSpeed) {
  const SpeedProfile flat{{0.0, 0.04, 0.1}, {30.0, 30.0, 30.0}};
  MovingRail a(calm_ends(side_track(0.545, 60), 15), constant_speed(30.0), {0.2}, 1.0),
      b(calm_ends(side_track(0.545, 60), 15), flat, {0.2}, 1.0);
  a.begin(Eigen::Vector3d(5e3, 5e4, 0.0)), b.begin(Eigen::Vector3d(5e3, 5e4, 0.0));
  for (int i = 1; i <= 2500; ++i) {
    const Eigen::Vector3d force(5e3, 5e4 * (1.0 + 0.3 * std::sin(0.1 * i)), 0.0);
    const MovingRail::Answer x = a.after(5e-5 * i), y = b.after(5e-5 * i);
    a.accept(force), b.accept(force);
    const Eigen::Vector3d one = x.free + x.compliance * force, other = y.free + y.compliance * force;
    ASSERT_LT((one - other).norm(), 1e-9 * one.norm()) << i;
  }
}

/// Oracle: a normal that leans by an angle, beside the middle of the head and at its height, with lateral creep c,
/// which friction may bound, and F = k d^1.5.
class LeaningSpring : public ContactElement {
 public:
  static constexpr double kLean = 0.3, kAside = 0.012, kStiffness = 9e10, kCreep = 3e5, kRadius = 0.46,
                          kSteepCreep = 3e6;
  explicit LeaningSpring(double side_y, double friction)
      : y_(side_y), out_(side_y > 0.0 ? 1.0 : -1.0), mu_(friction), creep_(friction > 0.0 ? kSteepCreep : kCreep) {}

  ContactReaction evaluate(const PairMotion& m) override {
    // Into the rail and outwards.
    const Vec3 normal(0.0, out_ * std::sin(kLean), std::cos(kLean)),
        aside(0.0, std::cos(kLean), -out_ * std::sin(kLean));
    const Vec3 rail_arm(0.0, -out_ * kAside, 0.0), wheel_arm(0.0, y_ - out_ * kAside, kRadius);
    const auto at = [](double y, double z, double roll, const Vec3& arm) {
      return Vec3(Vec3(0.0, y, z) + roll * Vec3::UnitX().cross(arm));
    };
    const auto &q = m.wheelset, &v = m.wheelset_velocity;
    const Vec3 apart = at(q.y, q.z, q.roll, wheel_arm) - at(m.rail.y, m.rail.z, m.rail.roll, rail_arm),
               slip = at(v.y, v.z, v.roll, wheel_arm) - at(m.rail.vy, m.rail.vz, m.rail.vroll, rail_arm);
    ContactReaction r;
    const double d = normal.dot(apart);
    r.least_gap = -d;
    if (!(d > 0.0)) {
      r.status = Status::no_contact;
      return r;
    }
    const double f = kStiffness * std::pow(d, 1.5), used = mu_ > 0.0 ? creep_ * aside.dot(slip) / (mu_ * f) : 0.0,
                 creep = creep_ * aside.dot(slip) / std::hypot(1.0, used);
    const Vec3 force = f * normal + creep * aside;
    r.on_rail = {force, rail_arm.cross(force)};
    r.on_wheelset = {-force, -wheel_arm.cross(force)};
    r.normal_force = f;
    r.lateral_creep_force = creep;
    r.elastic_energy = 0.4 * f * d;
    r.frictional_power = creep * aside.dot(slip);
    r.patches = 1;
    PatchTangent t;
    t.X_TC.origin = Vec3(0.0, y_ + m.rail.y, m.rail.z) + rail_arm;
    t.X_TC.rotation.col(0) = Vec3::UnitX();
    t.X_TC.rotation.col(1) = aside;
    t.X_TC.rotation.col(2) = normal;
    t.stiffness_n = 1.5 * f / d;
    constexpr double kLeast = 0.02;  // as a contact in full has
    t.damping_s = creep_ * std::max(kLeast, 1.0 / std::pow(std::hypot(1.0, used), 3.0));
    t.normal_force = f;
    r.tangents = {t};
    return r;
  }
  void accept() override {}
  void save(ByteWriter&) const override {}
  void restore(ByteReader&) override {}

 private:
  double y_, out_, mu_, creep_;
};

/// Two wheelsets below masses, free sideways and in roll.
VehicleOnTrack on_leaning_springs(const FlexibleTrack& track, double speed, double tolerance, bool shared,
                                  const SpeedProfile& profile, double friction = 0.0) {
  constexpr std::array<bool, kFreedoms> kFree{false, true, true, true, false, false};
  VehicleModel model;
  for (int i = 0; i < 2; ++i) {
    const std::string wheelset = "wheelset" + std::to_string(i + 1), mass = "mass" + std::to_string(i + 1);
    const double x = -1.8 * i;
    model.bodies.push_back(body(mass, 9000.0 - 1000.0 * i, {3000, 1, 1}, {x, 0, -1.0}, kFree));
    model.bodies.push_back(body(wheelset, 1813.0, {1120, 112, 1120}, {x, 0, -0.46}, kFree));
    for (const double y : {-1.0, 1.0}) {
      model.springs.push_back(spring(mass, wheelset, {x, y, -0.46}, {0, 2e6, 1e6, 0, 0, 0}, {0, 2e4, 1e4, 0, 0, 0}));
      model.springs.back().name += y > 0.0 ? "right" : "left";
    }
    model.wheelsets.push_back({wheelset, LeaningSpring::kRadius});
  }
  VehicleOnTrack v;
  v.system = assemble(model, std::nullopt, speed, kGravity);
  v.speed = speed;
  std::vector<double> places{0.0, -1.8}, loads{0.5 * v.system.wheelset_load[0], 0.5 * v.system.wheelset_load[1]};
  std::map<wheelrail::Side, std::shared_ptr<LoadedRail>> rails;
  for (const auto side : {wheelrail::Side::left, wheelrail::Side::right}) {
    rails[side] = std::make_shared<LoadedRail>(MovingRail(track, profile, places, 1.0), loads);
    for (int set = 0; set < 2; ++set) {
      const double y = side == wheelrail::Side::left ? -0.75 : 0.75;
      const auto own = static_cast<std::size_t>(set);
      const auto rail = shared ? rails[side]
                               : std::make_shared<LoadedRail>(MovingRail(track, profile, {places[own]}, 1.0),
                                                              std::vector{loads[own]});
      v.wheels.push_back(
          {set, side, "wheel",
           std::make_shared<ContactOnRail>(std::make_shared<LeaningSpring>(y, friction), rail, shared ? own : 0,
                                           tolerance, Vec3(0.0, y, 0.0), LeaningSpring::kRadius),
           Vec3(0.0, y, 0.0)});
    }
  }
  v.connect();
  if (profile.time.size() > 1) {
    LineSetup line;
    line.speed = profile;
    line.gravity = kGravity;
    v.line = std::make_shared<const LineEffects>(v.system, std::move(line));
  }
  return v;
}

/// Each rail lies as the forces and the moment upon its top deflect it at rest, dampers aside at this speed.
TEST(ContactOnRailSideways, EquilibriumRestsOnTheDeflectedRail) {
  const FlexibleTrack track = calm_ends(side_track(0.545, 60), 15);
  const VehicleOnTrack v = on_leaning_springs(track, 0.01, 1e-7, false, constant_speed(0.01));
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  const RailOnSeats rest(track, RailPlane::sideways), vertical(track);
  for (std::size_t i = 0; i < v.wheels.size(); ++i) {
    const ContactReaction& r = e.reactions[i];
    const double x[] = {rest.middle() - 1.8 * v.wheels[i].wheelset};
    const Eigen::Vector2d expected =
        rest.receptances(x, 0.0)[0].real() * Eigen::Vector2d(r.on_rail.force.y(), r.on_rail.moment.x());
    EXPECT_NEAR(r.on_rail.force.z(), 0.5 * v.system.wheelset_load[static_cast<std::size_t>(v.wheels[i].wheelset)], 1.0);
    EXPECT_NEAR(r.bending.y / expected[0], 1.0, 1e-3);
    EXPECT_NEAR(r.bending.roll / expected[1], 1.0, 1e-3);
    EXPECT_NEAR(r.bending.z / (r.on_rail.force.z() * vertical.receptance(x[0], 0.0).real()), 1.0, 1e-3);
    EXPECT_GT(std::abs(r.bending.y), 1e-4);
  }
}

SystemState kicked(const VehicleOnTrack& v) {
  SystemState start = find_equilibrium(v).state;
  for (const Multibody::Wheelset& set : v.system.wheelsets) {
    start.v[set.coordinate[1]] += 0.005;
    start.q[set.coordinate[2] - 3] += 0.01;  // the mass above
  }
  return start;
}

TEST(ContactOnRailSideways, EnergyIsBalanced) {
  const SpeedProfile braking{{0.0, 0.1, 0.25}, {20.0, 14.0, 22.0}};
  for (const bool shared : {false, true}) {
    const VehicleOnTrack v = on_leaning_springs(calm_ends(side_track(0.545, 60), 15), 20.0, 1e-8, shared,
                                                shared ? braking : constant_speed(20.0));
    Simulation s(v, kicked(v), equal_steps(0.15, 2e-5));
    while (!s.finished()) s.advance();
    const double turnover = s.energy().turnover;
    EXPECT_GT(turnover, 10.0);
    EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * turnover) << shared;
    EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-4 * turnover) << shared;
  }
}

/// As the wheelset suddenly goes to and fro: what counts as agreed is the force at the slip that it leaves.
TEST(ContactOnRailSideways, CreepThatFrictionBoundsAgreesWithItsSlip) {
  constexpr double kFriction = 0.3, kSide = 0.75, kTolerance = 1e-3;
  constexpr int kMost = 30;
  for (const double step : {2e-6, 1e-5, 5e-5})
    for (const double kick : {-0.4, -0.1, -0.02, 0.02, 0.1, 0.4}) {
      const auto rail = std::make_shared<LoadedRail>(
          MovingRail(calm_ends(side_track(0.545, 60), 15), constant_speed(20.0), {0.0}, 1.0), std::vector{5e4});
      const auto spring = std::make_shared<LeaningSpring>(kSide, kFriction);
      ContactOnRail contact(spring, rail, 0, 1e-6, Vec3(0.0, kSide, 0.0), LeaningSpring::kRadius);
      PairMotion m;
      m.wheelset.z = 5e-4;
      m.wheelset_velocity.x = 20.0;
      ContactReaction r = contact.evaluate(m);
      ASSERT_EQ(r.status, Status::ok) << r.message;
      ASSERT_TRUE(contact.settle(r));
      contact.accept();
      for (const double velocity : {kick, -kick, 0.2 * kick}) {
        m.time += step;
        m.wheelset.x = 20.0 * m.time;
        m.wheelset_velocity.y = velocity;
        int rounds = 0;
        do {
          r = contact.evaluate(m);
          contact.settle(r);
        } while (r.corrected > kTolerance * r.normal_force && ++rounds < kMost);
        ASSERT_LT(rounds, kMost) << velocity << " m/s, " << step << " s";
        PairMotion there = m;
        there.rail = r.bending;
        EXPECT_NEAR(r.lateral_creep_force, spring->evaluate(there).lateral_creep_force,
                    0.01 * kFriction * r.normal_force)
            << velocity << " m/s, " << step << " s";
        contact.accept();
      }
    }
}

/// One evaluation a step: what the linearised contact and rail leave is small.
TEST(ContactOnRailSideways, StepsNeedOneEvaluation) {
  const VehicleOnTrack v =
      on_leaning_springs(calm_ends(side_track(0.545, 60), 15), 20.0, 1e-4, true, constant_speed(20.0));
  SimulationSettings settings = equal_steps(0.1, 5e-5);
  settings.step.force_tolerance = 1e-3;
  Simulation s(v, kicked(v), settings);
  while (!s.finished()) s.advance();
  EXPECT_LT(static_cast<double>(s.counts().evaluations), 1.2 * static_cast<double>(s.counts().steps));
}

TEST(ContactOnRailSideways, GoesOnWithTheSameBits) {
  const SimulationSettings settings = equal_steps(0.1, 5e-5);
  const auto made = [] {
    return on_leaning_springs(calm_ends(side_track(0.545, 60), 15), 20.0, 1e-6, true, constant_speed(20.0));
  };
  const VehicleOnTrack first = made(), second = made();
  Simulation whole(first, kicked(first), settings);
  ByteWriter saved;
  for (int i = 0; !whole.finished(); ++i) {
    if (i == 900) whole.save(saved);
    whole.advance();
  }
  Simulation rest(second, kicked(second), settings);
  ByteReader reader(saved.bytes());
  rest.restore(reader);
  EXPECT_TRUE(reader.at_end());
  while (!rest.finished()) rest.advance();
  EXPECT_EQ(rest.state().q, whole.state().q);
  EXPECT_EQ(rest.energy().elastic, whole.energy().elastic);
}

}  // namespace
}  // namespace treadmark::vehicle
