// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/irregularities.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstring>
#include <functional>
#include <numeric>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::vehicle {
namespace {

using Form = IrregularitySpectrum::Form;

IrregularitySpectrum poles(Form form) {
  IrregularitySpectrum s;
  s.form = form;
  s.amplitude = 4e-7;
  s.omega_c = 0.8246;
  s.omega_r = 0.0206;
  s.omega_s = 0.438;
  return s;
}

/// All four functions, of different forms.
IrregularitySpec made(std::uint64_t seed = 1) {
  IrregularitySpec spec;
  spec.spectral.spectra = {poles(Form::two_poles), poles(Form::three_poles), poles(Form::two_poles), std::nullopt};
  spec.spectral.shortest = 2.0;
  spec.spectral.longest = 100.0;
  spec.spectral.seed = seed;
  return spec;
}

TEST(IrregularitySpectra, VarianceIsTheIntegral) {
  // Closed form of two poles: A c^2/(c^2 - r^2) (atan(k/r)/r - atan(k/c)/c).
  const IrregularitySpectrum s = poles(Form::two_poles);
  const double c = s.omega_c, r = s.omega_r;
  const auto whole = [&](double k) {
    return s.amplitude * c * c / (c * c - r * r) * (std::atan(k / r) / r - std::atan(k / c) / c);
  };
  for (const auto& [shortest, longest] : {std::pair{3.0, 25.0}, {25.0, 70.0}, {70.0, 200.0}, {0.5, 400.0}})
    EXPECT_NEAR(variance(s, shortest, longest) / (whole(2 * kPi / shortest) - whole(2 * kPi / longest)), 1.0, 1e-12);

  // A table of a power law; straight lines between logarithms meet it exactly.
  IrregularitySpectrum table;
  table.form = Form::table;
  table.wavenumber = {0.05, 0.2, 1.0, 4.0};
  for (const double k : table.wavenumber) table.density.push_back(1e-7 * std::pow(k, -3.0));
  const double low = 2 * kPi / 100.0, high = 2 * kPi / 2.0;
  EXPECT_NEAR(variance(table, 2.0, 100.0), 1e-7 * 0.5 * (1 / (low * low) - 1 / (high * high)), 1e-18);

  IrregularitySpectrum twice = s;
  twice.two_sided = true;
  EXPECT_EQ(density(twice, 0.3), 2.0 * density(s, 0.3));
  // The third pole takes away what is much longer than its wave, and nothing of what is much shorter.
  const IrregularitySpectrum three = poles(Form::three_poles);
  EXPECT_NEAR(density(three, 100.0) / density(s, 100.0), 1.0, 1e-4);
  EXPECT_NEAR(density(three, 0.004) / density(s, 0.004), std::pow(0.004 / 0.438, 2), 1e-7);
}

constexpr double kSpacing = 0.5;  // [m]
constexpr std::size_t kSamples = 1 << 16;

/// A long realisation of a function of made(), without splines; made once.
const std::vector<double>& realised(Irregularity which) {
  static std::array<std::vector<double>, kIrregularities> all;
  std::vector<double>& samples = all.at(static_cast<std::size_t>(which));
  if (!samples.empty()) return samples;
  const std::vector<Sinusoid> waves = sinusoids_of(made().spectral, which);
  samples.resize(kSamples);
  parallel_for(kSamples, [&](std::size_t i) { samples[i] = sum_of(waves, kSpacing * static_cast<double>(i)); });
  return samples;
}

/// One-sided power spectral density over the wavenumber at 2 pi j / (kSegment * kSpacing), by Welch's (1967) method:
/// Hann windows of segments that overlap by half, each transformed by its definition.
constexpr std::size_t kSegment = 1024;
std::vector<double> welch(const std::vector<double>& samples) {
  std::vector<double> psd(kSegment / 2), window(kSegment);
  double power = 0.0;
  for (std::size_t i = 0; i < kSegment; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * kPi * static_cast<double>(i) / kSegment);
    power += window[i] * window[i];
  }
  std::vector<std::complex<double>> turn(kSegment);
  for (std::size_t i = 0; i < kSegment; ++i) turn[i] = std::polar(1.0, -2.0 * kPi * static_cast<double>(i) / kSegment);
  const std::size_t segments = samples.size() / (kSegment / 2) - 1;
  parallel_for(psd.size(), [&](std::size_t j) {
    for (std::size_t s = 0; s < segments; ++s) {
      std::complex<double> sum = 0.0;
      for (std::size_t i = 0; i < kSegment; ++i)
        sum += window[i] * samples[s * kSegment / 2 + i] * turn[(i * j) % kSegment];
      psd[j] += std::norm(sum) * 2.0 * kSpacing / power / (2.0 * kPi) / static_cast<double>(segments);
    }
  });
  return psd;
}

TEST(Irregularities, ARealisationHasTheSpectrumAskedFor) {
  // The mean density of thirds of octaves. Their ends cut lines of the transform: one of three at 40 m, where 5 % are
  // allowed; one of thirty at 4 m.
  for (const Irregularity which : {Irregularity::longitudinal_level, Irregularity::cross_level}) {
    const IrregularitySpec spec = made();
    const std::vector<double> psd = welch(realised(which));
    const IrregularitySpectrum& asked = *spec.spectral.spectra[static_cast<std::size_t>(which)];
    const double line = 2.0 * kPi / (kSegment * kSpacing);
    for (double longest = 50.0; longest > 4.0; longest /= std::cbrt(2.0)) {
      const double low = 2.0 * kPi / longest, high = low * std::cbrt(2.0);
      // Lines whose cells [j - 1/2, j + 1/2] the band covers, wholly or in part.
      double sum = 0.0;
      for (std::size_t j = 1; j < psd.size(); ++j) {
        const double k = static_cast<double>(j) * line;
        sum += psd[j] * std::max(0.0, std::min(high, k + line / 2) - std::max(low, k - line / 2));
      }
      EXPECT_NEAR(sum / variance(asked, 2.0 * kPi / high, longest), 1.0, 0.05) << longest;
    }
  }
}

/// Standard deviation of what a linear-phase filter (windowed sinc, Blackman's window) leaves of a band.
double deviation_in_band(const std::vector<double>& samples, double shortest, double longest) {
  constexpr int kHalf = 4000;  // 2 km: transitions a thousandth of a wave per metre wide
  std::vector<double> filter(kHalf + 1);
  for (int i = 0; i <= kHalf; ++i) {
    const double x = kSpacing * i, u = kPi * i / kHalf;
    const double window = 0.42 + 0.5 * std::cos(u) + 0.08 * std::cos(2.0 * u);
    filter[static_cast<std::size_t>(i)] =
        window * kSpacing *
        (i == 0 ? 2.0 / shortest - 2.0 / longest
                : (std::sin(2.0 * kPi * x / shortest) - std::sin(2.0 * kPi * x / longest)) / (kPi * x));
  }
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = kHalf; i + kHalf < samples.size(); i += 37) {
    double sum = filter[0] * samples[i];
    for (std::size_t k = 1; k <= kHalf; ++k) sum += filter[k] * (samples[i - k] + samples[i + k]);
    squares += sum * sum;
    ++count;
  }
  return std::sqrt(squares / count);
}

TEST(Irregularities, StandardDeviationsInBandsAreThoseOfTheIntegral) {
  // D1: 3 to 25 m, D2: 25 to 70 m. One wave in the width of a transition of the filter: 2 % of the deviation.
  const IrregularitySpec spec = made();
  for (const Irregularity which : {Irregularity::longitudinal_level, Irregularity::cross_level}) {
    const std::vector<double>& samples = realised(which);
    const IrregularitySpectrum& asked = *spec.spectral.spectra[static_cast<std::size_t>(which)];
    for (const auto& [shortest, longest] : {std::pair{3.0, 25.0}, {25.0, 70.0}}) {
      const double expected = std::sqrt(variance(asked, shortest, longest));
      EXPECT_NEAR(deviation_in_band(samples, shortest, longest) / expected, 1.0, 0.02) << shortest;
    }
    const double whole = std::sqrt(std::inner_product(samples.begin(), samples.end(), samples.begin(), 0.0) / kSamples);
    EXPECT_NEAR(whole / std::sqrt(variance(asked, 2.0, 100.0)), 1.0, 0.02);
  }
}

TEST(Irregularities, WavesAreThoseOfTheLibrarysCosine) {
  const std::vector<Sinusoid> waves = sinusoids_of(made().spectral, Irregularity::alignment);
  ASSERT_EQ(waves.size(), 17u * 30u);
  double total = 0.0;
  for (const Sinusoid& w : waves) total += 0.5 * w.amplitude * w.amplitude;
  EXPECT_NEAR(total / variance(poles(Form::two_poles), 2.0, 100.0), 1.0, 1e-10);
  for (const double s : {0.0, 3.7, 812.3, -55.0}) {
    double sum = 0.0;
    for (const Sinusoid& w : waves) sum += w.amplitude * std::cos(2.0 * kPi * (s * w.frequency + w.phase));
    EXPECT_NEAR(sum_of(waves, s), sum, 1e-14);
  }
  for (std::size_t i = 1; i < waves.size(); ++i) EXPECT_GT(waves[i].frequency, waves[i - 1].frequency);
  EXPECT_GE(waves.front().frequency, 1.0 / 100.0);
  EXPECT_LE(waves.back().frequency, 0.5 * (1.0 + 1e-9));
}

std::vector<double> numbers_along(const Irregularities& line) {
  std::vector<double> numbers;
  for (double s = -5.0; s < 300.0; s += 0.37) {
    const RailOffsets at = line.at(s);
    for (const Along& a : {at.left_y, at.left_z, at.right_y, at.right_z})
      numbers.insert(numbers.end(), {a.value, a.first, a.second});
  }
  return numbers;
}

TEST(Irregularities, ASeedIsOneTrackToTheBit) {
  const auto track = [](std::uint64_t seed, int threads) {
    const ThreadLimit limit(threads);
    return numbers_along(Irregularities(made(seed), 300.0));
  };
  const std::vector<double> one = track(7, 1), four = track(7, 4), other = track(8, 4);
  ASSERT_EQ(one.size(), four.size());
  EXPECT_EQ(std::memcmp(one.data(), four.data(), one.size() * sizeof(double)), 0);
  EXPECT_NE(one, other);
  // What the seed 1 means anywhere; fused products and sums may move the last digits.
  const std::vector<Sinusoid> waves = sinusoids_of(made().spectral, Irregularity::longitudinal_level);
  EXPECT_DOUBLE_EQ(waves[0].frequency, 0.010028351064053927);
  EXPECT_DOUBLE_EQ(waves[0].phase, 0.94356423086485441);
  EXPECT_NEAR(sum_of(waves, 100.0), -0.0026431984052425949, 1e-15);
}

TEST(Irregularities, FunctionsAreIndependent) {
  // Level and alignment have the same spectrum; of 33 km a few hundred independent waves of 100 m.
  const std::vector<double>&level = realised(Irregularity::longitudinal_level),
        &other = realised(Irregularity::alignment);
  const double both = std::inner_product(level.begin(), level.end(), other.begin(), 0.0),
               own = std::inner_product(level.begin(), level.end(), level.begin(), 0.0);
  EXPECT_LT(std::abs(both / own), 0.05);
  // Leaving one out does not change the others.
  IrregularitySpec spec = made();
  const std::vector<Sinusoid> before = sinusoids_of(spec.spectral, Irregularity::alignment);
  spec.spectral.spectra[0].reset();
  EXPECT_EQ(sinusoids_of(spec.spectral, Irregularity::alignment)[5].phase, before[5].phase);
}

TEST(Irregularities, SamplesFollowTheWaves) {
  const IrregularitySpec spec = made(3);
  const Irregularities line(spec, 400.0);
  const std::vector<Sinusoid> waves = sinusoids_of(spec.spectral, Irregularity::longitudinal_level);
  double worst = 0.0, largest = 0.0;
  for (double s = 25.0; s < 400.0; s += 0.013) {
    worst = std::max(worst, std::abs(line.function(Irregularity::longitudinal_level, s).value - sum_of(waves, s)));
    largest = std::max(largest, std::abs(sum_of(waves, s)));
  }
  EXPECT_LT(worst, 2e-4 * largest);
  EXPECT_GE(line.last(), 400.0);
}

/// Every function a straight line of its own.
IrregularitySpec straight_lines() {
  IrregularitySpec spec;
  spec.table.emplace();
  spec.table->distance = {0.0, 10.0, 40.0, 60.0, 100.0};
  for (std::size_t f = 0; f < 4; ++f)
    for (const double s : spec.table->distance)
      spec.table->values[f].push_back(1e-3 * (1.0 + static_cast<double>(f)) + 1e-5 * s);
  spec.wind_up = 20.0;
  return spec;
}

TEST(Irregularities, RailsFollowFromTheFourFunctions) {
  const Irregularities line(straight_lines(), 0.0);
  const RailOffsets at = line.at(50.0);
  const double slope = 1e-5, rise = 50.0 * slope, level = 1e-3 + rise, cross = 2e-3 + rise, alignment = 3e-3 + rise,
               gauge = 4e-3 + rise;
  EXPECT_NEAR(at.left_z.value, level - cross / 2, 1e-15);
  EXPECT_NEAR(at.right_z.value, level + cross / 2, 1e-15);
  EXPECT_NEAR(at.left_y.value, alignment - gauge / 2, 1e-15);
  EXPECT_NEAR(at.right_y.value, alignment + gauge / 2, 1e-15);
  EXPECT_NEAR(at.right_y.first, 1.5 * slope, 1e-15);
  EXPECT_EQ(line.last(), 100.0);
  EXPECT_EQ(line.limited(), 0);
  IrregularitySpec changed = straight_lines();
  changed.factor = {-1.0, 2.0, 1.0, 0.0};
  changed.offset = 30.0;
  const RailOffsets other = Irregularities(changed, 0.0).at(80.0);
  EXPECT_NEAR(other.right_z.value, -level + cross, 1e-15);
  EXPECT_NEAR(other.right_y.value, alignment, 1e-15);
}

TEST(Irregularities, GrowSmoothlyFromZero) {
  IrregularitySpec spec = straight_lines();
  spec.begin = 5.0;
  const Irregularities line(spec, 0.0);
  const auto level = [&](double s) { return line.function(Irregularity::longitudinal_level, s); };
  EXPECT_EQ(level(4.999).value, 0.0);
  for (const double s : {5.0, 25.0}) {  // both ends of the wind-up
    EXPECT_NEAR(level(s + 1e-7).value, level(s - 1e-7).value, 1e-10);
    EXPECT_NEAR(level(s + 1e-7).first, level(s - 1e-7).first, 1e-10);
    EXPECT_NEAR(level(s + 1e-7).second, level(s - 1e-7).second, 1e-10);
  }
  EXPECT_NEAR(level(15.0).value, 0.5 * (1e-3 + 1e-5 * 15.0), 1e-15);
  const double h = 1e-3;
  for (double s = 6.0; s < 24.5; s += 0.9) {
    EXPECT_NEAR((level(s + h).value - level(s - h).value) / (2 * h), level(s).first, 1e-10);
    EXPECT_NEAR((level(s + h).first - level(s - h).first) / (2 * h), level(s).second, 1e-10);
  }
}

TEST(Irregularities, NonsenseIsRefused) {
  const auto message = [](const std::function<void(IrregularitySpec&)>& change, bool table = false) -> std::string {
    IrregularitySpec spec = table ? straight_lines() : made();
    change(spec);
    try {
      const Irregularities line(spec, 100.0);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  using ::testing::HasSubstr;
  using Spec = IrregularitySpec;
  EXPECT_THAT(message([](Spec& s) { s.spectral.shortest = 200.0; }), HasSubstr("wavelengths of 200 to 100 m"));
  EXPECT_THAT(message([](Spec& s) { s.spectral.shortest = 0.0; }), HasSubstr("wavelengths of 0 to"));
  EXPECT_THAT(message([](Spec& s) { s.spectral.longest = kInfinity; }), HasSubstr("wavelengths"));
  EXPECT_THAT(message([](Spec& s) { s.spectral.spectra[0]->amplitude = -1.0; }), HasSubstr("amplitude"));
  EXPECT_THAT(message([](Spec& s) { s.spectral.spectra[0]->omega_c = 0.0; }), HasSubstr("omega_c"));
  EXPECT_THAT(message([](Spec& s) { s.spectral.sinusoids_per_third_octave = 0; }), HasSubstr("1 to 1000"));
  EXPECT_THAT(message([](Spec& s) { s.wind_up = -1.0; }), HasSubstr("wind-up"));
  EXPECT_THAT(message([](Spec& s) { s.factor[1] = kNaN; }), HasSubstr("factor"));
  EXPECT_THAT(message([](Spec& s) {
                s.spectral.shortest = 1e-4;
                s.spectral.longest = 1.0;
              }),
              HasSubstr("more than 1e+07 samples"));
  EXPECT_THAT(message([](Spec& s) {
                s.spectral.shortest = 1e-3;
                s.spectral.sinusoids_per_third_octave = 1000;
              }),
              HasSubstr("sinusoids at 2000004 places"));
  const auto with_table = [](std::vector<double> k, std::vector<double> d) {
    return [k, d](Spec& s) {
      s.spectral.spectra[0]->form = Form::table;
      s.spectral.spectra[0]->wavenumber = k;
      s.spectral.spectra[0]->density = d;
    };
  };
  EXPECT_THAT(message(with_table({0.01, 4.0}, {1.0})), HasSubstr("2 wavenumbers and 1 densities"));
  EXPECT_THAT(message(with_table({4.0, 0.01}, {1.0, 1.0})), HasSubstr("increase"));
  EXPECT_THAT(message(with_table({0.01, 4.0}, {1.0, 0.0})), HasSubstr("must be positive"));
  EXPECT_THAT(message(with_table({0.1, 4.0}, {1.0, 1.0})), HasSubstr("2 to 100 m are asked for"));
  EXPECT_THAT(message([](Spec& s) { s.table->distance[1] = 0.0; }, true), HasSubstr("must increase"));
  EXPECT_THAT(message([](Spec& s) { s.table->values[1].pop_back(); }, true), HasSubstr("4 irregularities at 5 places"));
  EXPECT_THAT(message([](Spec& s) { s.table->values[1][2] = 2.0; }, true), HasSubstr("2000 mm, more than 500 mm"));
  EXPECT_THAT(message([](Spec& s) { s.table->values[1][2] = kNaN; }, true), HasSubstr("an irregularity of nan"));
}

}  // namespace
}  // namespace treadmark::vehicle
