// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/rail_on_seats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "beam_on_bed.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark::vehicle {
namespace {

using Complex = std::complex<double>;

double off(Complex value, Complex expected) { return std::abs(value / expected - 1.0); }

/// What reflections from the ends may change.
FlexibleTrack absorbing(FlexibleTrack track, int bays = 30, double absorption = 2000.0) {
  track.absorbing_bays = bays;
  track.absorption = absorption;
  return track;
}

TEST(BandedSymmetric, SolvesAsADenseMatrix) {
  Random random(3);
  constexpr int kSize = 23;
  for (const int band_width : {4, 6}) {
    BandedSymmetric<Complex> band(kSize, band_width);
    Eigen::MatrixXcd dense = Eigen::MatrixXcd::Zero(kSize, kSize);
    for (int i = 0; i < kSize; ++i)
      for (int j = std::max(0, i - band_width); j <= i; ++j) {
        const Complex value(random.uniform() - 0.5, random.uniform() + (i == j ? 6.0 : 0.0));
        band.add(j, i, value);
        dense(i, j) = dense(j, i) = value;
      }
    Eigen::VectorXcd x = Eigen::VectorXcd::Random(kSize);
    const Eigen::VectorXcd b = dense * x;
    EXPECT_LT((band.times(x) - b).norm(), 1e-13 * b.norm());
    EXPECT_LT(std::abs(band.form(x) - (x.transpose() * b).value()), 1e-12 * b.norm() * x.norm());
    Eigen::VectorXcd solved = b;
    ASSERT_TRUE(band.factorise());
    band.solve(solved);
    EXPECT_LT((solved - x).norm(), 1e-13 * x.norm());
  }
  EXPECT_THROW(BandedSymmetric<double>(kSize, 5), Error);
}

TEST(BeamElement, MovesRigidlyWithoutForceAndWithItsMass) {
  const RailBeam beam = zhai_track().rail;
  const double length = 0.37;
  const BeamElement element(beam, length);
  const BeamVector lift(1, 0, 1, 0), turn(0, 1, length, 1);
  EXPECT_LT((element.stiffness() * lift).norm(), 1e-6);
  EXPECT_LT((element.stiffness() * turn).norm(), 1e-6);
  EXPECT_NEAR(lift.dot(element.mass() * lift), beam.mass * length, 1e-10);
  EXPECT_NEAR(turn.dot(element.mass() * turn),
              beam.mass * length * length * length / 3.0 + beam.rotary_inertia * length, 1e-10);
  EXPECT_NEAR(element.deflection(0.3).dot(turn), 0.3 * length, 1e-14);
  EXPECT_NEAR(element.rotation(0.3).dot(turn), 1.0, 1e-14);
}

TEST(BeamElement, BendsAsACantilever) {
  const RailBeam beam = zhai_track().rail;
  const double l = 0.6;
  const Eigen::Matrix2d k = BeamElement(beam, l).stiffness().bottomRightCorner<2, 2>();
  const Eigen::Vector2d tip = k.inverse() * Eigen::Vector2d(1.0, 0.0);
  EXPECT_NEAR(tip[0] / (l * l * l / (3.0 * beam.bending_stiffness) + l / beam.shear_stiffness), 1.0, 1e-12);
  EXPECT_NEAR(tip[1] / (l * l / (2.0 * beam.bending_stiffness)), 1.0, 1e-12);
}

TEST(BeamElement, YieldsBetweenClampedEnds) {
  const RailBeam beam = zhai_track().rail;
  const double l = 0.6;
  const BeamElement element(beam, l);
  EXPECT_NEAR(
      element.own_compliance(0.5) / (l * l * l / (192.0 * beam.bending_stiffness) + l / (4.0 * beam.shear_stiffness)),
      1.0, 1e-12);
  EXPECT_EQ(element.own_compliance(0.0), 0.0);
  EXPECT_EQ(element.own_compliance(1.0), 0.0);
}

/// Two rigid seats and a rail that overhangs: the textbook's beam on two supports.
TEST(RailOnSeats, IsABeamOnTwoSupports) {
  FlexibleTrack track = zhai_track(0.9, 2);
  for (RailSeat& seat : track.seats) seat = {seat.x, 1e15, 0.0, 1.0, 1e15, 0.0};
  const RailBeam& beam = track.rail;
  const double l = 0.9;
  for (const int elements : {1, 2, 7}) {
    track.bay_elements = elements;
    const RailOnSeats rail(track);
    const double b = 0.3, x = 0.2;  // force at b; deflection at x < b
    const double bending = (l - b) * x * (l * l - (l - b) * (l - b) - x * x) / (6.0 * l * beam.bending_stiffness),
                 shear = (l - b) * x / (l * beam.shear_stiffness);
    const double places[] = {x, b};
    const std::vector<double> w = rail.deflection(b, places);
    const double under =
        b * b * (l - b) * (l - b) / (3.0 * l * beam.bending_stiffness) + b * (l - b) / (l * beam.shear_stiffness);
    EXPECT_NEAR(w[1] / under, 1.0, 1e-5) << elements;
    // Exact in elements without a force, which has an element of its own here.
    if (elements == 7) {
      EXPECT_NEAR(w[0] / (bending + shear), 1.0, 1e-5);
    }
  }
}

TEST(RailOnSeats, StaticDeflectionIsThatOfABeamOnABed) {
  const FlexibleTrack fine = zhai_track(0.05, 601);
  const RailOnSeats rail(fine);
  const double bed = bed_stiffness(fine.seats[0], 0.05, 0.0).real();
  // Deflection, and the shape of Euler's beam for one that hardly shears.
  EXPECT_NEAR(rail.receptance(15.0, 0.0).real() / infinite_beam(fine.rail, bed, 0.0).real(), 1.0, 1e-3);

  FlexibleTrack euler = fine;
  euler.rail.shear_stiffness *= 1e5;
  const double b = fine.rail.bending_stiffness, number = std::pow(bed / (4.0 * b), 0.25);
  const double most = 1.0 / (2.0 * std::sqrt(2.0) * std::pow(b, 0.25) * std::pow(bed, 0.75));
  const std::vector<double> places{15.0, 15.5, 16.0, 17.0, 18.5};
  const std::vector<double> w = RailOnSeats(euler).deflection(15.0, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double s = number * (places[i] - 15.0);
    EXPECT_NEAR(w[i] / most, std::exp(-s) * (std::cos(s) + std::sin(s)), 1e-3) << places[i];
  }
}

/// Points hold less than a bed: 0.7 % here.
TEST(RailOnSeats, StaticDeflectionOnRealSleepersIsNearThatOnABed) {
  const FlexibleTrack track = zhai_track();
  const RailOnSeats rail(track);
  const double expected = infinite_beam(track.rail, bed_stiffness(track.seats[0], 0.545, 0.0), 0.0).real();
  double mean = 0.0;
  constexpr int kPlaces = 16;
  for (int i = 0; i < kPlaces; ++i)
    mean += rail.receptance(rail.middle() + (i + 0.5) / kPlaces * rail.middle_bay(), 0.0).real() / kPlaces;
  EXPECT_GT(mean / expected, 1.0);
  EXPECT_LT(mean / expected, 1.01);
}

TEST(RailOnSeats, ReceptanceIsThatOfAnInfiniteBeamOnABed) {
  constexpr double kSpacing = 0.02;  // so small that points are a bed
  FlexibleTrack track = zhai_track(kSpacing, 1601);
  track.bay_elements = 2;
  const RailOnSeats rail(absorbing(track, 400));
  for (const double f : {10.0, 50.0, 100.0, 200.0, 300.0, 500.0, 700.0, 1000.0, 1500.0}) {
    const double w = 2.0 * kPi * f;
    const Complex expected = infinite_beam(track.rail, bed_stiffness(track.seats[0], kSpacing, w), w);
    EXPECT_LT(off(rail.receptance(track.seats[800].x, f), expected), 2e-3) << f << " Hz";
  }
}

/// At sleepers and between them, with the resonance between sleepers, spacings that differ, and without sleepers'
/// weight.
TEST(RailOnSeats, ReceptanceIsThatOfAnInfiniteRailOnItsSeats) {
  FlexibleTrack even = zhai_track(), uneven = zhai_track(0.6, 100);
  for (std::size_t i = 0; i < uneven.seats.size(); ++i) {
    uneven.seats[i].x += 0.08 * std::sin(2.1 * static_cast<double>(i));
    uneven.seats[i].pad_damping = 30e3;
    uneven.seats[i].bed_stiffness *= i % 7 == 3 ? 0.0 : 1.0;
  }
  even.bay_elements = uneven.bay_elements = 32;
  for (const FlexibleTrack& track : {even, uneven}) {
    const RailOnSeats rail(absorbing(track, 20));
    for (const double f : {10.0, 40.0, 100.0, 200.0, 300.0, 500.0, 700.0, 1000.0, 1200.0, 1500.0})
      for (const double part : {-0.5, -0.22, 0.0, 0.31}) {
        const double x = rail.middle() + part * rail.middle_bay();
        EXPECT_LT(off(rail.receptance(x, f), rail_on_points(track, x, 2.0 * kPi * f)), 0.01) << f << " Hz, " << part;
      }
  }
}

/// A loss factor that grows with frequency is a complex stiffness of the beam.
TEST(RailOnSeats, InnerDampingIsALossFactor) {
  FlexibleTrack track = zhai_track(0.02, 1601);
  track.bay_elements = 2;
  track.rail.damping_time = 20e-6;
  const RailOnSeats rail(absorbing(track, 400));
  FlexibleTrack undamped = track;
  undamped.rail.damping_time = 0.0;
  const RailOnSeats hard(absorbing(undamped, 400));
  for (const double f : {300.0, 1000.0}) {
    const double w = 2.0 * kPi * f;
    const Complex expected =
        infinite_beam(track.rail, bed_stiffness(track.seats[0], 0.02, w), w, 0.0, Complex(1.0, w * 20e-6));
    EXPECT_LT(off(rail.receptance(track.seats[800].x, f), expected), 2e-3) << f;
    EXPECT_GT(off(hard.receptance(track.seats[800].x, f), expected), 5e-3) << f;
  }
}

/// Errors of the elements fall with the square of their length.
TEST(RailOnSeats, ElementsConverge) {
  const auto error = [](int elements) {
    FlexibleTrack track = absorbing(zhai_track());
    track.bay_elements = elements;
    const RailOnSeats rail(track);
    double most = 0.0;
    for (const double f : {300.0, 900.0, 1500.0})
      most =
          std::max(most, off(rail.receptance(rail.middle(), f), rail_on_points(track, rail.middle(), 2.0 * kPi * f)));
    return most;
  };
  const double coarse = error(4), usual = error(8), fine = error(16);
  EXPECT_NEAR(std::log2(coarse / usual), 2.0, 0.3);
  EXPECT_NEAR(std::log2(usual / fine), 2.0, 0.3);
  EXPECT_LT(fine, 5e-3);
}

/// Pads that hardly damp let waves run to the ends: absorbed there they do not come back.
TEST(RailOnSeats, EndsAbsorbWavesOfATrackThatHardlyDamps) {
  FlexibleTrack track = zhai_track(0.6, 121);
  for (RailSeat& seat : track.seats) seat.pad_damping = 5e3;
  const auto worst = [&](const FlexibleTrack& other, const FlexibleTrack& reference) {
    double most = 0.0;
    const RailOnSeats a(other), b(reference);
    for (double f = 500.0; f < 1500.0; f += 13.7)
      if (std::abs(f / pinned_pinned_frequency(track.rail, 0.6) - 1.0) > 0.1)
        most = std::max(most, off(a.receptance(a.middle(), f), b.receptance(b.middle(), f)));
    return most;
  };
  FlexibleTrack endless = zhai_track(0.6, 1201);
  for (RailSeat& seat : endless.seats) seat.pad_damping = 5e3;
  endless = absorbing(endless, 400, 2000.0);
  EXPECT_GT(worst(track, endless), 0.1);
  EXPECT_LT(worst(absorbing(track), endless), 0.01);
}

TEST(PinnedPinned, IsThatOfEulersBeamWhereShearAndRotationDoNotMatter) {
  RailBeam beam = zhai_track().rail;
  beam.shear_stiffness *= 1e6;
  beam.rotary_inertia = 0.0;
  const double l = 0.6;
  EXPECT_NEAR(pinned_pinned_frequency(beam, l) / (kPi / (2.0 * l * l) * std::sqrt(beam.bending_stiffness / beam.mass)),
              1.0, 1e-6);
}

/// Sleepers are nodes of the resonance, so pads and their damping do not move it.
TEST(PinnedPinned, IsWhereTheReceptanceBetweenSleepersPeaks) {
  for (const double spacing : {0.545, 0.6, 0.7}) {
    FlexibleTrack track = zhai_track(spacing, 121);
    for (RailSeat& seat : track.seats) seat.pad_damping = 10e3;
    const RailOnSeats rail(absorbing(track));
    const double expected = pinned_pinned_frequency(track.rail, spacing);
    double peak = 0.0, at = 0.0;
    for (double f = 0.7 * expected; f < 1.3 * expected; f += 1e-3 * expected) {
      const double between = std::abs(rail.receptance(rail.middle(), f));
      if (between > peak) peak = between, at = f;
    }
    EXPECT_NEAR(at / expected, 1.0, 0.01) << spacing;
    const double over = std::abs(rail.receptance(rail.middle() + 0.5 * spacing, at));
    EXPECT_GT(peak, 3.0 * over) << spacing;
  }
}

/// The receptance has the sign of what damps, at places, spacings and sleepers of any kind.
TEST(RailOnSeats, NeverGivesEnergy) {
  Random random(11);
  FlexibleTrack track = zhai_track(0.6, 40);
  double x = 0.0;
  for (RailSeat& seat : track.seats) {
    seat.x = x;
    x += 0.4 + 0.5 * random.uniform();
    seat.pad_stiffness *= 0.3 + 2.0 * random.uniform();
    seat.bed_stiffness *= random.uniform() < 0.2 ? 0.0 : 1.0;
  }
  const RailOnSeats rail(absorbing(track, 8));
  for (int i = 0; i < 200; ++i) {
    const double at = rail.begin() + random.uniform() * (rail.end() - rail.begin()),
                 f = 1.0 + 2000.0 * random.uniform();
    EXPECT_LT(rail.receptance(at, f).imag(), 0.0) << at << " m, " << f << " Hz";
  }
  EXPECT_GT(rail.deflection(rail.middle(), std::vector<double>{rail.middle()})[0], 0.0);
}

TEST(RailOnSeats, RefusesWhatMakesNoSense) {
  const auto refused = [](auto change) {
    FlexibleTrack track = zhai_track(0.6, 10);
    change(track);
    try {
      const RailOnSeats rail(track);
    } catch (const Error& error) {
      return error.kind() == ErrorKind::configuration;
    }
    return false;
  };
  EXPECT_FALSE(refused([](FlexibleTrack&) {}));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.seats[3].x = t.seats[2].x; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.seats.resize(1); }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.rail.shear_stiffness = 0.0; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.seats[5].sleeper_mass = -1.0; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.absorbing_bays = 6; }));
  EXPECT_TRUE(refused([](FlexibleTrack& t) { t.bay_elements = 0; }));
  EXPECT_THROW(RailOnSeats(zhai_track()).place(-1.0), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
