// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measures {
namespace {

constexpr double kPiHere = std::numbers::pi;

/// "1, 1.25, 1.6 ..." of whole powers of 10^(1/10).
double nominal_frequency(int index) {
  constexpr double kNominal[] = {1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0};
  const int decade = to_whole<int>(std::floor(index / 10.0));
  return kNominal[index - 10 * decade] * std::pow(10.0, decade);
}

}  // namespace

void fourier_transform(std::vector<std::complex<double>>& values) {
  const std::size_t n = values.size();
  if (!std::has_single_bit(n)) throw Error(ErrorKind::configuration, "a transform needs a power of two");
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t length = 2; length <= n; length <<= 1)
    for (std::size_t k = 0; k < length / 2; ++k) {
      const std::complex<double> turn =
          std::polar(1.0, -2.0 * kPiHere * static_cast<double>(k) / static_cast<double>(length));
      for (std::size_t begin = k; begin < n; begin += length) {
        const std::complex<double> even = values[begin], odd = turn * values[begin + length / 2];
        values[begin] = even + odd;
        values[begin + length / 2] = even - odd;
      }
    }
}

PowerSpectrum power_spectrum(const EvenSignal& signal, double highest, std::size_t segment) {
  constexpr std::size_t kFewest = 16, kShort = 64;
  const std::size_t count = signal.values.size();
  if (count < kFewest) throw Error(ErrorKind::input_data, "the signal has too few samples for a spectrum");
  if (segment == 0) segment = count / 4 >= kShort ? count / 4 : count;
  segment = std::bit_floor(std::clamp(segment, kFewest, count));
  std::vector<double> window(segment);
  double power = 0.0;
  for (std::size_t i = 0; i < segment; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * kPiHere * (static_cast<double>(i) + 0.5) / static_cast<double>(segment));
    power += window[i] * window[i];
  }
  PowerSpectrum out;
  out.line = 1.0 / (signal.step * static_cast<double>(segment));
  out.highest = std::min(highest, 0.5 / signal.step);
  out.density.assign(segment / 2 + 1, 0.0);
  std::vector<std::complex<double>> transform(segment);
  for (std::size_t begin = 0; begin + segment <= count; begin += segment / 2) {
    double mean = 0.0;
    for (std::size_t i = 0; i < segment; ++i) mean += signal.values[begin + i] / static_cast<double>(segment);
    for (std::size_t i = 0; i < segment; ++i) transform[i] = window[i] * (signal.values[begin + i] - mean);
    fourier_transform(transform);
    for (std::size_t k = 0; k < out.density.size(); ++k) out.density[k] += std::norm(transform[k]);
    ++out.segments;
  }
  for (std::size_t k = 0; k < out.density.size(); ++k) {
    const double x = kPiHere * static_cast<double>(k) / static_cast<double>(segment);  // pi f step
    const double lost = k == 0 ? 1.0 : std::sin(x) / x;
    const double sides = k == 0 || 2 * k == segment ? 1.0 : 2.0;
    out.density[k] *= sides * signal.step / (power * out.segments) / (lost * lost);
  }
  return out;
}

std::vector<FrequencyBand> third_octave_bands(const PowerSpectrum& spectrum) {
  constexpr double kHalf = 0.05, kFewestLines = 3.0;  // decades
  const double last = spectrum.line * static_cast<double>(spectrum.density.size() - 1);
  const double highest = std::min(spectrum.highest, last);
  std::vector<FrequencyBand> bands;
  for (int index = to_whole<int>(std::floor(10.0 * std::log10(spectrum.line)));; ++index) {
    FrequencyBand band{nominal_frequency(index), std::pow(10.0, 0.1 * index - kHalf),
                       std::pow(10.0, 0.1 * index + kHalf), 0.0};
    if (band.high > highest) break;
    if (band.high - band.low < kFewestLines * spectrum.line) continue;
    double square = 0.0;
    const auto first = std::max<std::size_t>(1, to_whole<std::size_t>(band.low / spectrum.line));
    const auto end = std::min(spectrum.density.size(), to_whole<std::size_t>(band.high / spectrum.line) + 2);
    for (std::size_t k = first; k < end; ++k) {
      // each line stands for half a line to both sides
      const double middle = spectrum.line * static_cast<double>(k), half = 0.5 * spectrum.line;
      const double width = std::min(band.high, middle + half) - std::max(band.low, middle - half);
      if (width > 0.0) square += spectrum.density[k] * width;
    }
    band.rms = std::sqrt(square);
    bands.push_back(band);
  }
  return bands;
}

}  // namespace treadmark::measures
