// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/signal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>

#include "treadmark/analysis/measures/spectrum.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::measures {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

std::vector<double> sampled(std::size_t count, double step, const std::function<double(double)>& f) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(f(step * static_cast<double>(i)));
  return out;
}

/// Amplitude of the sine of this frequency in the middle half.
double amplitude(const std::vector<double>& v, double step, double frequency) {
  std::complex<double> sum = 0.0;
  const double periods = std::floor(0.5 * static_cast<double>(v.size()) * step * frequency);
  const auto count = static_cast<std::size_t>(std::lround(periods / (frequency * step)));
  const std::size_t begin = (v.size() - count) / 2;
  for (std::size_t i = begin; i < begin + count; ++i)
    sum += v[i] * std::polar(1.0, -kTurn * frequency * step * static_cast<double>(i));
  return 2.0 * std::abs(sum) / static_cast<double>(count);
}

TEST(EvenSamples, AreTheMeansOfAPolylineAtUnequalSteps) {
  const std::vector<double> at{0.0, 0.1, 0.35, 0.4, 1.0}, values{0.0, 1.0, -1.0, 3.0, 3.0};
  const EvenSignal even = even_samples(at, values, 0.25);
  ASSERT_EQ(even.values.size(), 5u);
  EXPECT_DOUBLE_EQ(even.end(), 1.0);
  // by hand: 0.125 to 0.375, from 0.8 down to -1 and up to 1
  EXPECT_NEAR(even.values[1], (0.225 * 0.5 * (0.8 - 1.0) + 0.025 * 0.5 * (-1.0 + 1.0)) / 0.25, 1e-14);
  EXPECT_DOUBLE_EQ(even.values[4], 3.0);
  double sum = 0.0;  // windows that fill the signal keep its integral
  const EvenSignal windows = sliding_means(at, values, 0.0, 1.0, 0.2, 0.2);
  ASSERT_EQ(windows.values.size(), 5u);
  for (const double v : windows.values) sum += 0.2 * v;
  EXPECT_NEAR(sum, 0.05 + 0.0 + 0.05 + 1.8, 1e-14);
}

TEST(EvenSamples, StepsInTheSignalAndItsTimeAreTaken) {
  const std::vector<double> at{0.0, 0.5, 0.5, 1.0}, values{1.0, 1.0, 4.0, 4.0};
  const EvenSignal even = even_samples(at, values, 0.25);
  EXPECT_DOUBLE_EQ(even.values[1], 1.0);
  EXPECT_DOUBLE_EQ(even.values[2], 2.5);
  EXPECT_DOUBLE_EQ(even.values[3], 4.0);
  EXPECT_THROW(even_samples(std::vector<double>{0.0}, std::vector<double>{1.0}, 0.1), Error);
  EXPECT_THROW(even_samples(std::vector<double>{0.0, 1.0, 0.5}, std::vector<double>{1.0, 1.0, 1.0}, 0.1), Error);
  EXPECT_THROW(even_samples(at, values, 0.0), Error);
  EXPECT_THROW(even_samples(at, values, 1e-9), Error);
}

/// What is above half the sampling frequency does not come back as something slow.
TEST(EvenSamples, KeepFastWavesOut) {
  const std::vector<double> at = sampled(200'001, 1e-5, [](double t) { return t; });
  const std::vector<double> fast = sampled(at.size(), 1e-5, [](double t) { return std::sin(kTurn * 1005.0 * t); });
  const EvenSignal even = even_samples(at, fast, 1e-3);
  EXPECT_LT(amplitude(even.values, 1e-3, 5.0), 0.006);  // |sinc(1.005)|
  EXPECT_GT(std::fabs(fast[25]), 0.9);
}

TEST(SlidingMeans, OfASineAreItsMeanOverTheWindow) {
  const std::vector<double> at = sampled(40'001, 1e-3, [](double x) { return x; });
  const std::vector<double> wave = sampled(at.size(), 1e-3, [](double x) { return std::sin(kTurn * x / 5.0); });
  const EvenSignal means = sliding_means(at, wave, 3.0, 33.0, 2.0, 0.5);
  ASSERT_EQ(means.values.size(), 57u);
  EXPECT_DOUBLE_EQ(means.begin, 4.0);
  const double gain = std::sin(kTurn / 5.0) / (kTurn / 5.0);
  for (std::size_t i = 0; i < means.values.size(); ++i)
    EXPECT_NEAR(means.values[i], gain * std::sin(kTurn * (4.0 + 0.5 * static_cast<double>(i)) / 5.0), 1e-6);
  EXPECT_TRUE(sliding_means(at, wave, 3.0, 4.9, 2.0, 0.5).values.empty());
}

TEST(Filters, SinesComeOutAsTheFormulaSays) {
  constexpr double kStep = 1e-3;
  for (const double f : {2.0, 10.0, 20.0, 40.0, 80.0}) {
    const std::vector<double> wave = sampled(20'000, kStep, [f](double t) { return std::sin(kTurn * f * t); });
    // tan(pi f step) in place of pi f step is what the bilinear transformation changes
    const auto seen = [&](double corner) {
      return f * std::tan(0.5 * kTurn * f * kStep) / (0.5 * kTurn * f * kStep) /
             (std::tan(0.5 * kTurn * corner * kStep) / (0.5 * kTurn * corner * kStep));
    };
    EXPECT_NEAR(amplitude(low_passed(wave, kStep, 20.0), kStep, f), low_pass_magnitude(seen(20.0), 20.0), 2e-4) << f;
    EXPECT_NEAR(amplitude(low_passed(wave, kStep, 20.0), kStep, f), low_pass_magnitude(f, 20.0), 3e-3) << f;
    EXPECT_NEAR(amplitude(high_passed(wave, kStep, 20.0), kStep, f), high_pass_magnitude(f, 20.0), 3e-3) << f;
  }
  EXPECT_NEAR(20.0 * std::log10(low_pass_magnitude(20.0, 20.0)), -3.0103, 1e-4);
  EXPECT_NEAR(20.0 * std::log10(high_pass_magnitude(20.0, 20.0)), -3.0103, 1e-4);
  EXPECT_NEAR(20.0 * std::log10(low_pass_magnitude(3200.0, 20.0) / low_pass_magnitude(1600.0, 20.0)), -24.08, 0.01);
}

TEST(Filters, HaveNoDelayAndKeepConstants) {
  std::vector<double> pulse(2001, 5.0);
  pulse[1000] = 6.0;
  const std::vector<double> out = low_passed(pulse, 1e-3, 20.0);
  EXPECT_EQ(ranges::max_element(out) - out.begin(), 1000);
  for (std::size_t i = 1; i < 1000; ++i) EXPECT_NEAR(out[1000 - i], out[1000 + i], 1e-9);
  EXPECT_NEAR(out.front(), 5.0, 1e-12);
  EXPECT_NEAR(high_passed(std::vector<double>(500, 5.0), 1e-3, 0.4).back(), 0.0, 1e-9);
  EXPECT_NEAR(low_passed(std::vector<double>{3.0}, 1e-3, 20.0).at(0), 3.0, 1e-12);
}

TEST(Weightings, HaveTheValuesOfTheStandardsTables) {
  // ISO 2631-1:1997, table 3, Wd at the true middles of one-third octaves
  const std::pair<int, double> rows[] = {{-3, 0.853}, {0, 1.011}, {3, 0.890}, {6, 0.512}, {9, 0.253}, {12, 0.125}};
  for (const auto& [n, expected] : rows)
    EXPECT_NEAR(weighting_magnitude(Weighting::d, std::pow(10.0, 0.1 * n)) / expected, 1.0, 0.015) << n;
  // the gain of Wb brings its highest place to about one
  double highest = 0.0, where = 0.0;
  for (double f = 1.0; f < 30.0; f += 0.01)
    if (const double m = weighting_magnitude(Weighting::b, f); m > highest) highest = m, where = f;
  EXPECT_NEAR(highest, 1.0, 0.06);
  EXPECT_GT(where, 5.0);
  EXPECT_LT(where, 16.0);
  for (const Weighting weighting : {Weighting::b, Weighting::d})
    for (const double f : {0.3, 1.0, 3.0, 8.0, 20.0}) {
      const auto sections = weighting_sections(weighting, 1e-3);
      EXPECT_NEAR(magnitude(sections, f, 1e-3) / weighting_magnitude(weighting, f), 1.0, 0.01) << f;
      const std::vector<double> wave = sampled(40'000, 1e-3, [f](double t) { return std::sin(kTurn * f * t); });
      EXPECT_NEAR(amplitude(filtered(wave, sections), 1e-3, f) / magnitude(sections, f, 1e-3), 1.0, 2e-3) << f;
    }
}

TEST(Percentiles, AreThoseOfSortedSamples) {
  std::vector<double> ramp = sampled(1001, 1.0, [](double i) { return i; });
  ranges::shuffle(ramp, std::mt19937(7));
  EXPECT_DOUBLE_EQ(percentile(ramp, 0.5), 500.0);
  EXPECT_NEAR(percentile(ramp, 0.9985), 998.5, 1e-9);
  EXPECT_DOUBLE_EQ(percentile(ramp, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(percentile(ramp, 1.0), 1000.0);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(FourierTransform, IsTheSumItStandsFor) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<std::complex<double>> values(32);
  for (auto& v : values) v = {uniform(random), uniform(random)};
  std::vector<std::complex<double>> transform = values;
  fourier_transform(transform);
  for (std::size_t k = 0; k < 32; ++k) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < 32; ++i) sum += values[i] * std::polar(1.0, -kTurn * static_cast<double>(i * k) / 32.0);
    EXPECT_LT(std::abs(sum - transform[k]), 1e-13);
  }
  std::vector<std::complex<double>> odd(12);
  EXPECT_THROW(fourier_transform(odd), Error);
}

double power_of(const PowerSpectrum& s) {
  double sum = 0.0;
  for (const double d : s.density) sum += d * s.line;
  return sum;
}

/// Parseval: what a window hides at one end of a segment the overlap shows.
TEST(PowerSpectra, HoldThePowerOfTheSignal) {
  EvenSignal wave{0.0, 1e-3, sampled(65'536, 1e-3, [](double t) { return 3.0 + 2.0 * std::sin(kTurn * 50.0 * t); })};
  const PowerSpectrum s = power_spectrum(wave, 500.0);
  EXPECT_EQ(s.segments, 7);
  const double lost = std::sin(0.05 * std::numbers::pi) / (0.05 * std::numbers::pi);  // of means over a step
  EXPECT_NEAR(power_of(s) * lost * lost, 2.0, 1e-3);
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, 1.5);
  EvenSignal noise{0.0, 1e-3, {}};
  for (int i = 0; i < 65'536; ++i) noise.values.push_back(normal(random));
  const PowerSpectrum n = power_spectrum(noise, 500.0, 512);
  for (const double f : {10.0, 100.0, 200.0}) {
    // white noise: its variance over half the sampling frequency everywhere, about within the scatter of 255 segments
    double mean = 0.0;
    const auto k = static_cast<std::size_t>(f / n.line);
    for (std::size_t i = k; i < k + 8; ++i) mean += n.density[i] / 8.0;
    const double x = std::numbers::pi * (f + 3.5 * n.line) * 1e-3, kept = std::sin(x) / x;
    EXPECT_NEAR(mean * kept * kept / (1.5 * 1.5 / 500.0), 1.0, 0.08) << f;
  }
}

TEST(ThirdOctaves, ASineIsInItsBandAndWhiteNoiseRisesByADecibel) {
  EvenSignal wave{0.0, 1e-3, sampled(65'536, 1e-3, [](double t) { return std::sin(kTurn * 31.0 * t); })};
  const std::vector<FrequencyBand> bands = third_octave_bands(power_spectrum(wave, 120.0));
  ASSERT_FALSE(bands.empty());
  EXPECT_LE(bands.back().high, 120.0);
  EXPECT_DOUBLE_EQ(bands.back().nominal, 100.0);
  for (const FrequencyBand& band : bands) {
    if (band.nominal == 31.5) {
      EXPECT_NEAR(band.rms, std::sqrt(0.5), 0.01);
      EXPECT_NEAR(band.low, 28.184, 1e-3);
      EXPECT_NEAR(band.high, 35.481, 1e-3);
    } else {
      EXPECT_LT(band.rms, 0.02) << band.nominal;
    }
  }
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  EvenSignal noise{0.0, 1e-4, {}};
  for (int i = 0; i < 1 << 18; ++i) noise.values.push_back(normal(random));
  const std::vector<FrequencyBand> rising = third_octave_bands(power_spectrum(noise, 700.0));
  // ten bands: a decade of width, 10 dB of power
  double slope = 0.0;
  for (std::size_t i = 10; i < rising.size(); ++i)
    slope += 20.0 * std::log10(rising[i].rms / rising[i - 10].rms) / static_cast<double>(rising.size() - 10);
  ASSERT_GT(rising.size(), 14u);
  EXPECT_NEAR(slope, 10.0, 0.4);
}

}  // namespace
}  // namespace treadmark::measures
