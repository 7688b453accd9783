// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark {

/// Deviations of the rails from the line, by the names of EN 13848-1, as functions of the distance along the track.
/// Signs are those of the path frame (y right, z down; docs/layout.md): with left and right rail l and r
enum class Irregularity : int {
  longitudinal_level,  ///< (z_l + z_r)/2: positive where both rails lie low
  cross_level,         ///< z_r - z_l: positive where the right rail lies lower, as cant
  alignment,           ///< (y_l + y_r)/2: positive where both rails lie to the right
  gauge,               ///< y_r - y_l beyond the gauge of the line: positive where the track is wide
};
/// Number of them.
inline constexpr int kIrregularities = 4;
/// "longitudinal_level" and so on, in the order of Irregularity.
inline constexpr std::array<std::string_view, kIrregularities> kIrregularityNames{"longitudinal_level", "cross_level",
                                                                                  "alignment", "gauge"};

/// Measured irregularities.
struct IrregularityTable {
  std::vector<double> distance;                             ///< increasing [m]
  std::array<std::vector<double>, kIrregularities> values;  ///< at these distances [m]; empty: none
};

/// A one-sided power spectral density S over the wavenumber k [rad/m]: the variance of wavelengths between two limits
/// is the integral of S between their wavenumbers [m2].
struct IrregularitySpectrum {
  /// How it is given.
  enum class Form {
    two_poles,    ///< S = A c^2 / ((k^2 + r^2)(k^2 + c^2))
    three_poles,  ///< S = A c^2 k^2 / ((k^2 + r^2)(k^2 + c^2)(k^2 + s^2))
    table,        ///< a straight line between logarithms
  };
  Form form = Form::two_poles;
  double amplitude = 0.0;                              ///< A [m rad]; >= 0
  double omega_c = 0.0, omega_r = 0.0, omega_s = 0.0;  ///< [rad/m]; c > 0, others >= 0
  std::vector<double> wavenumber;                      ///< of a table, increasing [rad/m]
  std::vector<double> density;                         ///< at them [m2/(rad/m)]; > 0
  bool two_sided = false;  ///< what is given also holds for negative wavenumbers, so that S is twice that
  SourcePosition where;
};

/// Irregularities that are made from spectra.
struct SpectralIrregularities {
  std::array<std::optional<IrregularitySpectrum>, kIrregularities> spectra;
  double shortest = 3.0, longest = 70.0;  ///< wavelengths that occur [m]; 0 < shortest < longest
  std::uint64_t seed = 1;                 ///< another number, another track of the same spectra
  int sinusoids_per_third_octave = 30;    ///< 1 to 1000
};

/// All of a line.
struct IrregularitySpec {
  std::optional<IrregularityTable> table;  ///< or else
  SpectralIrregularities spectral;
  double offset = 0.0;                 ///< added to the distances of the table [m]
  double begin = 0.0, wind_up = 20.0;  ///< they grow from zero at the first place over this length [m]; >= 0
  std::array<double, kIrregularities> factor{1.0, 1.0, 1.0, 1.0};  ///< on each function
  SourcePosition where;
};

inline constexpr double kLargestIrregularity = 0.5;  ///< more is another unit, or no track [m]

/// S at a wavenumber > 0 [m2/(rad/m)].
double density(const IrregularitySpectrum& spectrum, double wavenumber);
/// Integral of S over the wavelengths between two limits [m2].
double variance(const IrregularitySpectrum& spectrum, double shortest, double longest);

/// Errors: Error(configuration) for spectra and numbers that make no sense; for a table Error(input_data) where it has
/// less than four rows, distances that do not increase, or a number that is not finite or larger than
/// kLargestIrregularity.
void check(const IrregularitySpec& spec);

}  // namespace treadmark
