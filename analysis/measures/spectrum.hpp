// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "treadmark/analysis/measures/signal.hpp"

namespace treadmark::measures {

/// Discrete Fourier transform in place, sum of x_k exp(-2 pi i j k / n); n: a power of two (Cooley and Tukey 1965).
/// Errors: Error(configuration) for other sizes. Thread-safe.
void fourier_transform(std::vector<std::complex<double>>& values);

/// A power spectral density over frequency, one-sided: its integral is the mean square about the mean.
struct PowerSpectrum {
  double line = 0.0;            ///< between frequencies 0, line, ... [Hz]
  std::vector<double> density;  ///< [unit^2/Hz]
  int segments = 0;             ///< over which it is the mean
  double highest = 0.0;         ///< up to here the samples are dense enough [Hz]
};

/// By Welch's method (1967): segments of a power of two with half overlap under Hann's window, each without its mean.
/// segment: samples, 0: the largest power of two of at most a quarter of the signal, or the whole where that is shorter
/// than 64. What means over a step (even_samples) have lost is given back. highest: as in the result. Errors:
/// Error(input_data) for fewer than 16 samples. Thread-safe.
PowerSpectrum power_spectrum(const EvenSignal& signal, double highest, std::size_t segment = 0);

/// A one-third octave.
struct FrequencyBand {
  double nominal = 0.0;          ///< [Hz], as it is called: 31.5
  double low = 0.0, high = 0.0;  ///< [Hz], of exact middles 10^(n/10) with ratios of 10^(1/10) (IEC 61260, base ten)
  double rms = 0.0;              ///< [unit]
};

/// Bands that lie within the spectrum, three lines wide at least. Thread-safe.
std::vector<FrequencyBand> third_octave_bands(const PowerSpectrum& spectrum);

}  // namespace treadmark::measures
