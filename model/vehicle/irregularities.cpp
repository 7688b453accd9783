// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/irregularities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/line.hpp"

namespace treadmark {

namespace {

double square(double x) { return x * x; }

double given_density(const IrregularitySpectrum& s, double k) {
  const double poles = (square(k) + square(s.omega_r)) * (square(k) + square(s.omega_c)),
               whole = s.amplitude * square(s.omega_c) / poles;
  if (s.form == IrregularitySpectrum::Form::two_poles) return whole;
  if (s.form == IrregularitySpectrum::Form::three_poles) return whole * square(k) / (square(k) + square(s.omega_s));
  const std::size_t i = piece_at(s.wavenumber, k) + 1;
  const double slope = std::log(s.density[i] / s.density[i - 1]) / std::log(s.wavenumber[i] / s.wavenumber[i - 1]);
  return s.density[i] * std::pow(k / s.wavenumber[i], slope);
}

/// Gauss-Legendre on pieces of a fourth of an octave; their ends do not depend on a library's functions.
double integral(const IrregularitySpectrum& s, double low, double high) {
  constexpr double kRatio = 1.189207115002721;
  constexpr double kNodes[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                               0.9739065285171717};
  constexpr double kWeights[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159821, 0.1494513491505806,
                                 0.0666713443086881};
  double sum = 0.0;
  for (double from = low; from < high; from *= kRatio) {
    const double to = std::min(high, from * kRatio), half = 0.5 * (to - from), middle = 0.5 * (to + from);
    for (std::size_t i = 0; i < std::size(kNodes); ++i)
      sum += half * kWeights[i] * (density(s, middle - half * kNodes[i]) + density(s, middle + half * kNodes[i]));
  }
  return sum;
}

[[noreturn]] void refuse(const SourcePosition& where, std::string message, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), where, std::move(advice));
}

bool positive(double x) { return x > 0.0 && std::isfinite(x); }
bool not_negative(double x) { return x >= 0.0 && std::isfinite(x); }

void check_spectrum(const IrregularitySpectrum& s, const SpectralIrregularities& all) {
  if (s.form != IrregularitySpectrum::Form::table) {
    if (!not_negative(s.amplitude)) refuse(s.where, "the amplitude of a spectrum must not be negative");
    if (!positive(s.omega_c)) refuse(s.where, "omega_c of a spectrum must be positive");
    if (!not_negative(s.omega_r) || !not_negative(s.omega_s))
      refuse(s.where, "omega_r and omega_s of a spectrum must not be negative");
    return;
  }
  if (s.wavenumber.size() < 2 || s.wavenumber.size() != s.density.size())
    refuse(s.where,
           fmt::format("a spectrum has {} wavenumbers and {} densities", s.wavenumber.size(), s.density.size()),
           "give as many of one as of the other, at least two");
  for (std::size_t i = 0; i < s.wavenumber.size(); ++i) {
    if (!positive(s.density[i])) refuse(s.where, "the densities of a spectrum must be positive");
    if (!positive(s.wavenumber[i]) || (i > 0 && !(s.wavenumber[i] > s.wavenumber[i - 1])))
      refuse(s.where, "the wavenumbers of a spectrum must be positive and increase");
  }
  constexpr double kTurn = 2.0 * kPi, kSame = 1e-6;  // digits that a table may have
  if (s.wavenumber.front() > kTurn / all.longest * (1.0 + kSame) ||
      s.wavenumber.back() < kTurn / all.shortest * (1.0 - kSame))
    refuse(s.where, fmt::format("the spectrum has wavelengths of {:.6g} to {:.6g} m, {:.6g} to {:.6g} m are asked for",
                                kTurn / s.wavenumber.back(), kTurn / s.wavenumber.front(), all.shortest, all.longest));
}

void check_table(const IrregularityTable& t, const SourcePosition& where) {
  const auto wrong = [&](std::string message) { throw Error(ErrorKind::input_data, std::move(message), where); };
  constexpr std::size_t kLeast = 4;
  if (t.distance.size() < kLeast)
    wrong(fmt::format("irregularities at {} places, at least 4 are needed", t.distance.size()));
  for (std::size_t i = 0; i < t.distance.size(); ++i)
    if (!std::isfinite(t.distance[i]) || (i > 0 && !(t.distance[i] > t.distance[i - 1])))
      wrong("the distances of the irregularities must increase");
  for (const std::vector<double>& values : t.values) {
    if (!values.empty() && values.size() != t.distance.size())
      wrong(fmt::format("{} irregularities at {} places", values.size(), t.distance.size()));
    for (const double value : values)
      if (!(std::abs(value) <= kLargestIrregularity))
        wrong(fmt::format("an irregularity of {:.6g} mm, more than {:g} mm", value * kMilli,
                          kLargestIrregularity * kMilli));
  }
}

}  // namespace

double density(const IrregularitySpectrum& spectrum, double wavenumber) {
  return (spectrum.two_sided ? 2.0 : 1.0) * given_density(spectrum, wavenumber);
}

double variance(const IrregularitySpectrum& spectrum, double shortest, double longest) {
  return integral(spectrum, 2.0 * kPi / longest, 2.0 * kPi / shortest);
}

void check(const IrregularitySpec& spec) {
  if (!not_negative(spec.wind_up)) refuse(spec.where, "the wind-up length of irregularities must not be negative");
  if (!std::isfinite(spec.begin) || !std::isfinite(spec.offset))
    refuse(spec.where, "a place of irregularities is not finite");
  for (const double factor : spec.factor)
    if (!std::isfinite(factor)) refuse(spec.where, "a factor of irregularities is not finite");
  if (spec.table) return check_table(*spec.table, spec.where);
  const SpectralIrregularities& s = spec.spectral;
  if (!positive(s.shortest) || !positive(s.longest) || !(s.shortest < s.longest))
    refuse(spec.where, fmt::format("irregularities with wavelengths of {:.6g} to {:.6g} m", s.shortest, s.longest),
           "give a shortest wavelength and a longer one");
  constexpr double kWidest = 1e5;
  if (s.longest > kWidest * s.shortest) refuse(spec.where, "the wavelengths of irregularities differ by more than 1e5");
  if (s.sinusoids_per_third_octave < 1 || s.sinusoids_per_third_octave > 1000)
    refuse(spec.where, "sinusoids per third octave must be 1 to 1000");
  for (const auto& spectrum : s.spectra)
    if (spectrum) check_spectrum(*spectrum, s);
}

}  // namespace treadmark
