// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/irregularities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::vehicle {

namespace {

/// cos(2 pi x). Not std::cos, whose last digit differs between libraries.
double cos_of_turns(double x) {
  const double fraction = x - std::floor(x);
  const double quarters = std::floor(4.0 * fraction + 0.5);
  const double a = 2.0 * kPi * (fraction - 0.25 * quarters), q = a * a;  // |a| <= pi/4
  const auto series = [q](double factor, int last) {                     // 1 - q/(n(n-1)) (1 - ...), by Horner
    double sum = 1.0;
    for (int n = last; n > 1; n -= 2) sum = 1.0 - q / (n * (n - 1.0)) * sum;
    return factor * sum;
  };
  switch (to_whole<int>(quarters) % 4) {
    case 0:
      return series(1.0, 18);
    case 1:
      return -series(a, 19);
    case 2:
      return -series(1.0, 18);
    default:
      return series(a, 19);
  }
}

double power(double x, int n) {
  double product = 1.0;
  for (int bit = 1 << 20; bit > 0; bit >>= 1) {
    product *= product;
    if ((n & bit) != 0) product *= x;
  }
  return product;
}

/// The n-th root of a number > 1 by Newton's method from above.
double root(double number, int n) {
  double x = 1.0 + (number - 1.0) / n;
  for (int k = 0; k < 200; ++k) {
    const double raised = power(x, n - 1), next = x - (raised * x - number) / (n * raised);
    if (!(next < x)) break;
    x = next;
  }
  return x;
}

/// 0 to 1 with two continuous derivatives by u.
Along wound_up(double u) {
  if (u <= 0.0) return {};
  if (u >= 1.0) return {1.0, 0.0, 0.0};
  return {u * u * u * (10.0 + u * (6.0 * u - 15.0)), 30.0 * u * u * (1.0 - u) * (1.0 - u),
          60.0 * u * (1.0 - u) * (1.0 - 2.0 * u)};
}

Along times(double factor, const Along& a) { return {factor * a.value, factor * a.first, factor * a.second}; }
Along plus(const Along& a, const Along& b) { return {a.value + b.value, a.first + b.first, a.second + b.second}; }

/// Samples of the waves of all functions that have a spectrum.
std::vector<double> places_of(const SpectralIrregularities& spectral, double begin, double end) {
  constexpr double kSamplesOfWave = 20.0, kMost = 1e7;
  const double spacing = spectral.shortest / kSamplesOfWave,
               count = std::ceil(std::max(end - begin, 0.0) / spacing) + 4.0;
  if (!(count <= kMost))
    throw Error(
        ErrorKind::configuration,
        fmt::format("irregularities from {:.6g} to {:.6g} m with waves down to {:.6g} m need more than {:g} samples",
                    begin, end, spectral.shortest, kMost),
        {}, "shorten the line, or give a longer shortest_wavelength_m");
  std::vector<double> places(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = begin + spacing * static_cast<double>(i);
  return places;
}

std::vector<double> samples_of(const std::vector<Sinusoid>& waves, const std::vector<double>& places) {
  constexpr std::size_t kBlock = 256;
  std::vector<double> samples(places.size());
  parallel_for((places.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    const std::size_t stop = std::min(places.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < stop; ++i) samples[i] = sum_of(waves, places[i]);
  });
  return samples;
}

}  // namespace

std::vector<Sinusoid> sinusoids_of(const SpectralIrregularities& spectral, Irregularity which) {
  const auto index = static_cast<std::size_t>(which);
  const std::optional<IrregularitySpectrum>& spectrum = spectral.spectra.at(index);
  if (!spectrum) return {};
  constexpr double kThirdOctave = 1.2599210498948732;
  const double range = spectral.longest / spectral.shortest;
  int thirds = 1;
  for (double reached = kThirdOctave; reached < range; reached *= kThirdOctave) ++thirds;
  const int bins = thirds * spectral.sinusoids_per_third_octave;
  const double ratio = root(range, bins);
  // A stream of its own for each function, so that one can be changed without the others.
  Random random(Random(spectral.seed + index * 0x9e3779b97f4a7c15u).bits());
  std::vector<Sinusoid> waves;
  for (int i = 0; i < bins; ++i) {
    const double longest = spectral.longest / power(ratio, i), shortest = longest / ratio;
    const double from = 1.0 / longest, to = 1.0 / shortest;
    Sinusoid wave;
    wave.frequency = from + (to - from) * random.uniform();
    wave.phase = random.uniform();
    wave.amplitude = std::sqrt(2.0 * variance(*spectrum, shortest, longest));
    waves.push_back(wave);
  }
  return waves;
}

double sum_of(const std::vector<Sinusoid>& sinusoids, double distance) {
  double sum = 0.0;
  for (const Sinusoid& wave : sinusoids) sum += wave.amplitude * cos_of_turns(distance * wave.frequency + wave.phase);
  return sum;
}

Irregularities::Irregularities(const IrregularitySpec& spec, double end) : spec_(spec) {
  check(spec);
  spec_.table.reset();
  if (spec.table) {
    std::vector<double> places = spec.table->distance;
    for (double& place : places) place += spec.offset;
    for (std::size_t i = 0; i < splines_.size(); ++i)
      if (!spec.table->values[i].empty()) splines_[i].emplace(places, spec.table->values[i]);
    last_ = places.back();
    return;
  }
  const std::vector<double> places = places_of(spec.spectral, spec.begin, end);
  constexpr double kMostTerms = 1e10;  // a minute or two
  for (std::size_t i = 0; i < splines_.size(); ++i)
    if (spec.spectral.spectra[i]) {
      const std::vector<Sinusoid> waves = sinusoids_of(spec.spectral, static_cast<Irregularity>(i));
      if (static_cast<double>(waves.size()) * static_cast<double>(places.size()) > kMostTerms)
        throw Error(ErrorKind::configuration,
                    fmt::format("irregularities of {} sinusoids at {} places", waves.size(), places.size()), spec.where,
                    "shorten the line, or give fewer sinusoids_per_third_octave or a longer shortest_wavelength_m");
      splines_[i].emplace(places, samples_of(waves, places));
    }
  last_ = places.back();
}

Along Irregularities::function(Irregularity which, double distance) const {
  const auto index = static_cast<std::size_t>(which);
  const std::optional<LimitedSpline>& spline = splines_.at(index);
  const double along = distance - spec_.begin;
  if (!spline || along < 0.0) return {};
  const Along whole = times(spec_.factor.at(index), spline->at(distance));
  if (along >= spec_.wind_up) return whole;
  const double per_length = 1.0 / spec_.wind_up;
  Along part = wound_up(along * per_length);
  part.first *= per_length;
  part.second *= per_length * per_length;
  return {part.value * whole.value, part.value * whole.first + part.first * whole.value,
          part.value * whole.second + 2.0 * part.first * whole.first + part.second * whole.value};
}

RailOffsets Irregularities::at(double distance) const {
  const Along level = function(Irregularity::longitudinal_level, distance),
              cross = function(Irregularity::cross_level, distance),
              alignment = function(Irregularity::alignment, distance), gauge = function(Irregularity::gauge, distance);
  return {plus(alignment, times(-0.5, gauge)), plus(level, times(-0.5, cross)), plus(alignment, times(0.5, gauge)),
          plus(level, times(0.5, cross))};
}

int Irregularities::limited() const {
  int sum = 0;
  for (const auto& spline : splines_)
    if (spline) sum += spline->limited();
  return sum;
}

}  // namespace treadmark::vehicle
