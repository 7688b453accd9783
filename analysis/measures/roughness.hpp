// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/analysis/measures/section.hpp"

namespace treadmark::measures {

/// How a line along a rail is looked at (EN 15610).
struct RoughnessGauge {
  double segment = 4.0;         ///< longest segment of the spectrum [m]; shorter records are one segment
  double wheel_radius = 0.375;  ///< of the wheel that pits are closed by [m]; 0: as measured
  bool remove_spikes = true;    ///< narrow upward points
  double noise = 0.0;           ///< standard deviation of the samples [m], for the noise floor
};

/// A one-third octave of the roughness.
struct RoughnessBand {
  double wavelength = 0.0;   ///< nominal middle [m]
  double level = kUnknown;   ///< [dB re 1 um]; NaN: a segment has fewer than 8 waves, or is too coarse for the band
  double spread = kUnknown;  ///< standard deviation of the level over the segments [dB]; NaN: one segment
  double limit = kUnknown;   ///< [dB]; NaN: none
  double floor = kUnknown;   ///< level of the samples' noise in the band [dB]; NaN: none
};

/// Waves left by reprofiling, or corrugation.
struct WaveBand {
  double shortest = 0.0, longest = 0.0;  ///< wavelengths [m]
  double rms = kUnknown;                 ///< of the whole record [m]; NaN: the record is too short or too coarse
  double peak_to_peak = kUnknown;        ///< largest within a moving window of three longest wavelengths [m]
};

struct RoughnessMeasures {
  std::vector<RoughnessBand> bands;
  std::vector<WaveBand> waves;      ///< 10-30, 30-100, 100-300 and 300-1000 mm
  double length = 0.0, step = 0.0;  ///< of the record [m]
  int segments = 0;
  std::size_t spikes = 0;  ///< samples that were taken for spikes
};

/// Spectrum of heights, upwards positive [m], at even steps along the rail. limits: one for each of third_octaves(), or
/// empty for ISO 3095:2013. Thread-safe. Errors: Error(input_data) for fewer than 64 samples or gaps (NaN).
RoughnessMeasures measure_roughness(std::span<const double> height, double step, const RoughnessGauge& gauge = {},
                                    std::span<const double> limits = {});

/// Heights with pits closed: the lowest that a wheel of this radius rolling over leaves [m].
std::vector<double> closed_pits(std::span<const double> height, double step, double wheel_radius);

}  // namespace treadmark::measures
