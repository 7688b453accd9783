// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "treadmark/analysis/measures/bands.hpp"
#include "treadmark/analysis/measures/roughness.hpp"
#include "treadmark/analysis/measures/round.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::measures {
namespace {

constexpr double kRadius = 0.46, kTau = 2.0 * std::numbers::pi;

struct Turn {
  std::vector<double> theta, radius;
};

template <class Shape>
Turn turn_of(std::size_t samples, Shape shape) {
  Turn turn;
  for (std::size_t i = 0; i < samples; ++i) {
    turn.theta.push_back(-std::numbers::pi + kTau * static_cast<double>(i) / static_cast<double>(samples));
    turn.radius.push_back(kRadius + shape(turn.theta.back()));
  }
  return turn;
}

/// A chord of this length about theta = centre: the exact circle and line.
double chord(double theta, double centre, double length) {
  const double half = std::asin(0.5 * length / kRadius), off = std::remainder(theta - centre, kTau);
  return std::fabs(off) < half ? kRadius * std::cos(half) / std::cos(off) - kRadius : 0.0;
}

TEST(RoundMeasures, LevelsOfPolygons) {
  // 20 lg(A/sqrt 2/1 um): 20 um is 23.01 dB, 5 um 10.97 dB; order 20 of R = 460 mm is 144.5 mm long.
  const Turn turn = turn_of(2048, [](double t) {
    return 25e-6 * std::cos(t - 0.3) + 20e-6 * std::cos(3 * t + 1.0) + 5e-6 * std::cos(20 * t - 2.0);
  });
  const RoundMeasures m = measure_round(turn.theta, turn.radius);
  EXPECT_NEAR(m.radius, kRadius, 1e-12);
  EXPECT_NEAR(m.eccentricity.value, 25e-6, 1e-12);
  ASSERT_EQ(m.orders.size(), 29U);
  EXPECT_EQ(m.orders[1].order, 3);
  EXPECT_NEAR(m.orders[1].amplitude, 20e-6, 1e-12);
  EXPECT_NEAR(m.orders[1].phase, 1.0, 1e-9);
  EXPECT_NEAR(m.orders[1].level, 23.01, 0.005);
  EXPECT_NEAR(m.orders[18].level, 10.97, 0.005);
  EXPECT_NEAR(m.orders[18].wavelength, 0.1445, 5e-5);
  for (const RoundOrder& o : m.orders)
    if (o.order != 3 && o.order != 20) {
      EXPECT_LT(o.amplitude, 1e-12);
    }
  EXPECT_TRUE(m.flats.empty());
  // orders 17 to 20 of this wheel are the band of 0.16 m
  for (const auto& band : m.bands)
    if (std::fabs(band.wavelength - 0.16) < 1e-9) {
      EXPECT_NEAR(band.level, 10.97, 0.005);
    }
}

TEST(RoundMeasures, RunoutIsPeakToPeak) {
  const Turn turn = turn_of(3600, [](double t) { return 25e-6 * std::cos(t); });
  const RoundMeasures m = measure_round(turn.theta, turn.radius);
  EXPECT_NEAR(m.runout.value, 50e-6, 1e-12);
  EXPECT_NEAR(level_of(m.eccentricity.value / std::numbers::sqrt2), 24.95, 0.005);
}

TEST(RoundMeasures, ChordFlats) {
  // d = L^2/(8 R) to second order: 0.109, 0.435, 0.979 mm
  for (const double length : {20e-3, 40e-3, 60e-3}) {
    const Turn turn =
        turn_of(4096, [&](double t) { return chord(t, 1.0, length) + 30e-6 * std::cos(3 * t) + 40e-6 * std::cos(t); });
    const RoundMeasures m = measure_round(turn.theta, turn.radius);
    ASSERT_EQ(m.flats.size(), 1U) << length;
    const RoundFlat& flat = m.flats.front();
    const double depth = kRadius - std::sqrt(kRadius * kRadius - 0.25 * length * length);
    EXPECT_NEAR(flat.depth.value, depth, 0.01 * depth);
    EXPECT_NEAR(flat.length.value, length, 1e-3);
    EXPECT_NEAR(flat.chord_length, length, 0.01 * length);
    EXPECT_NEAR(flat.theta, 1.0, 1e-3);
    // the flat does not speak into the orders
    EXPECT_NEAR(m.orders[1].amplitude, 30e-6, 1e-6);
    EXPECT_NEAR(m.eccentricity.value, 40e-6, 1e-6);
  }
}

TEST(RoundMeasures, FlatAndPolygonInNoiseWithinTheUncertainty) {
  int depth = 0, length = 0, order = 0;
  constexpr int kSeeds = 100;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 draw(static_cast<unsigned>(seed));
    std::normal_distribution<double> noise(0.0, 30e-6);
    const Turn turn =
        turn_of(2048, [&](double t) { return chord(t, 0.5, 50e-3) + 50e-6 * std::cos(3 * t) + noise(draw); });
    const RoundMeasures m = measure_round(turn.theta, turn.radius);
    ASSERT_GE(m.flats.size(), 1U) << seed;
    const double truth = kRadius - std::sqrt(kRadius * kRadius - 0.25 * 50e-3 * 50e-3);
    depth += std::fabs(m.flats[0].depth.value - truth) <= m.flats[0].depth.uncertainty ? 1 : 0;
    length += std::fabs(m.flats[0].length.value - 50e-3) <= m.flats[0].length.uncertainty ? 1 : 0;
    order += std::fabs(m.orders[1].amplitude - 50e-6) <= m.orders[1].uncertainty ? 1 : 0;
    EXPECT_LT(m.flats[0].depth.uncertainty, 0.1 * truth);
    EXPECT_LT(m.flats[0].length.uncertainty, 15e-3);
    EXPECT_LT(m.orders[1].uncertainty, 5e-6);
  }
  EXPECT_GE(depth, 90);
  EXPECT_GE(length, 90);
  EXPECT_GE(order, 90);
}

TEST(RoundMeasures, GapsDoNoHarm) {
  Turn turn = turn_of(2048, [](double t) { return 20e-6 * std::cos(7 * t); });
  for (std::size_t i = 300; i < 420; ++i) turn.radius[i] = kUnknown;
  const RoundMeasures m = measure_round(turn.theta, turn.radius);
  EXPECT_NEAR(m.gaps, 120.0 / 2048.0, 1e-12);
  EXPECT_NEAR(m.orders[5].amplitude, 20e-6, 1e-9);
  for (std::size_t i = 300; i < 1200; ++i) turn.radius[i] = kUnknown;
  EXPECT_THROW(measure_round(turn.theta, turn.radius), Error);
}

std::vector<double> heights_of(double length, double step, const std::function<double(double)>& shape) {
  std::vector<double> h;
  for (double x = 0.0; x < length; x += step) h.push_back(shape(x));
  return h;
}

double level_in(const RoughnessMeasures& m, double wavelength) {
  for (const RoughnessBand& band : m.bands)
    if (std::fabs(band.wavelength - wavelength) < 1e-6) return band.level;
  return kUnknown;
}

TEST(Roughness, SinesAreLevelsOfTheirBands) {
  constexpr double kStep = 1e-3;
  const auto sine = [](double a, double wavelength) {
    return [=](double x) { return a * std::sin(kTau * x / wavelength); };
  };
  const RoughnessMeasures one = measure_roughness(heights_of(12.0, kStep, sine(10e-6, 0.1)), kStep);
  EXPECT_NEAR(level_in(one, 0.1), 16.99, 0.2);
  EXPECT_LT(level_in(one, 0.063), 0.0);
  EXPECT_LT(level_in(one, 0.16), 0.0);
  // in one band powers add: the band of 0.1 m reaches from 0.0891 to 0.1122 m
  const RoughnessMeasures two = measure_roughness(
      heights_of(12.0, kStep, [&](double x) { return sine(10e-6, 0.095)(x) + sine(10e-6, 0.105)(x); }), kStep);
  EXPECT_NEAR(level_in(two, 0.1), 20.0, 0.2);
  EXPECT_NEAR(one.bands[13].limit, 4.9, 1e-9);  // ISO 3095:2013 at 0.1 m
  EXPECT_NEAR(one.bands[13].wavelength, 0.1, 1e-12);
  for (const WaveBand& w : one.waves)
    if (w.longest == 100e-3) {
      EXPECT_NEAR(w.peak_to_peak, 10e-6, 4e-6);
    }  // the end of the band halves it
}

const WaveBand& wave_up_to(const RoughnessMeasures& m, double longest) {
  return *ranges::find_if(m.waves, [&](const WaveBand& w) { return std::fabs(w.longest - longest) < 1e-9; });
}

/// A sine within a band keeps its size; a band is silent where the record is shorter than the filter and one wave more,
/// or has fewer than four samples a wave.
TEST(Roughness, WavesAreMeasuredOrLeftOut) {
  const auto record = [](double length, double step, double wavelength) {
    RoughnessGauge gauge;
    gauge.wheel_radius = 0.0, gauge.remove_spikes = false;
    return measure_roughness(
        heights_of(length, step, [=](double x) { return 20e-6 * std::sin(kTau * x / wavelength); }), step, gauge);
  };
  const WaveBand& band = wave_up_to(record(6.0, 1e-3, 0.18), 0.3);
  EXPECT_NEAR(band.rms, 20e-6 / std::numbers::sqrt2, 0.02 * band.rms);
  EXPECT_NEAR(band.peak_to_peak, 40e-6, 0.02 * 40e-6);
  // four times 300 mm are needed
  EXPECT_TRUE(std::isfinite(wave_up_to(record(1.21, 1e-3, 0.18), 0.3).rms));
  for (const double length : {1.19, 1.0, 0.85}) {
    EXPECT_TRUE(std::isnan(wave_up_to(record(length, 1e-3, 0.18), 0.3).rms)) << length;
    EXPECT_TRUE(std::isnan(wave_up_to(record(length, 1e-3, 0.18), 0.3).peak_to_peak)) << length;
  }
  EXPECT_TRUE(std::isfinite(wave_up_to(record(6.0, 2.49e-3, 0.02), 0.03).rms));
  EXPECT_TRUE(std::isnan(wave_up_to(record(6.0, 2.51e-3, 0.02), 0.03).rms));
}

/// White noise of a standard deviation spreads its power evenly up to half the sampling frequency: the floor is the
/// level that a record of nothing else has.
TEST(Roughness, FloorIsTheLevelOfNoiseAlone) {
  constexpr double kStep = 1e-3, kNoise = 2e-6;
  std::mt19937 draw(7);
  std::normal_distribution<double> noise(0.0, kNoise);
  RoughnessGauge gauge;
  gauge.wheel_radius = 0.0, gauge.remove_spikes = false, gauge.noise = kNoise;
  const RoughnessMeasures m =
      measure_roughness(heights_of(60.0, kStep, [&](double) { return noise(draw); }), kStep, gauge);
  int compared = 0;
  for (const RoughnessBand& band : m.bands) {
    if (std::isnan(band.floor) || band.wavelength > 0.051) continue;  // wider waves have fewer than 18 lines of 4 m
    ++compared;
    constexpr double kLine = 0.3, kChance = 0.4;  // a line more or less in 18 [dB]; 29 segments that overlap by half
    EXPECT_NEAR(band.level, band.floor, kLine + kChance) << band.wavelength;
    // of 18 lines of which the window binds each to its neighbours: 4.34 sqrt(1.9 / 18), and less of more lines
    EXPECT_GT(band.spread, 0.0);
    EXPECT_LT(band.spread, 2.2) << band.wavelength;
  }
  EXPECT_GE(compared, 12);
}

/// A sine that doubles in the middle of the record. Three segments overlap by half; the power of the middle one is the
/// mean of both by the symmetry of its window, so powers are as 1, 2.5 and 4.
TEST(Roughness, SpreadIsThatOfTheSegments) {
  RoughnessGauge gauge;
  gauge.wheel_radius = 0.0, gauge.remove_spikes = false;
  const RoughnessMeasures m = measure_roughness(
      heights_of(7.9999, 1e-3, [](double x) { return (x < 4.0 ? 10e-6 : 20e-6) * std::sin(kTau * x / 0.1); }), 1e-3,
      gauge);
  ASSERT_EQ(m.segments, 3);
  const auto band = ranges::find_if(m.bands, [](const auto& b) { return std::fabs(b.wavelength - 0.1) < 1e-9; });
  EXPECT_NEAR(band->level, 20.0 * std::log10(10.0 / std::numbers::sqrt2) + 10.0 * std::log10(2.5), 0.05);
  const double low = 10.0 * std::log10(0.4), high = 10.0 * std::log10(1.6);
  EXPECT_NEAR(band->spread, std::sqrt(0.5 * (low * low + high * high)), 0.05);
}

TEST(Roughness, PitsAreClosedAndSpikesGo) {
  constexpr double kStep = 0.5e-3;
  // a wheel of 375 mm spans a pit of 5 mm, however deep
  const auto pit = [](double x) { return std::fabs(x - 1.0) < 2.5e-3 ? -50e-6 : 0.0; };
  std::vector<double> h = heights_of(2.0, kStep, pit);
  const std::vector<double> closed = closed_pits(h, kStep, 0.375);
  // the chord's sagitta, 5 mm over a circle of 375 mm: 8.3 um at most
  EXPECT_GT(*std::min_element(closed.begin(), closed.end()), -8.4e-6);
  // what is wider than the wheel's reach stays: sqrt(8 R d) = 12.2 mm at 50 um
  const std::vector<double> wide = closed_pits(
      heights_of(2.0, kStep, [](double x) { return std::fabs(x - 1.0) < 20e-3 ? -50e-6 : 0.0; }), kStep, 0.375);
  EXPECT_NEAR(*std::min_element(wide.begin(), wide.end()), -50e-6, 1e-9);
  std::vector<double> spiked = heights_of(5.0, kStep, [](double x) { return 5e-6 * std::sin(kTau * x / 0.2); });
  const RoughnessMeasures clean = measure_roughness(spiked, kStep);
  for (const std::size_t i : {1000U, 5000U, 8003U}) spiked[i] += 8e-6;
  const RoughnessMeasures again = measure_roughness(spiked, kStep);
  EXPECT_EQ(again.spikes, 3U);
  EXPECT_NEAR(level_in(again, 0.2), level_in(clean, 0.2), 0.02);
}

}  // namespace
}  // namespace treadmark::measures
