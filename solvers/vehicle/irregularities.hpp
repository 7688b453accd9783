// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/model/vehicle/irregularities.hpp"
#include "treadmark/solvers/vehicle/limited_spline.hpp"

namespace treadmark::vehicle {

/// One wave of irregularities made from a spectrum: amplitude * cos(2 pi (distance * frequency + phase)).
struct Sinusoid {
  double frequency = 0.0;  ///< [1/m]
  double amplitude = 0.0;  ///< [m]
  double phase = 0.0;      ///< [turns]
};

/// The waves of one function, those of length `longest` first (Shinozuka and Jan 1972): equal ratios of wavenumbers
/// divide the band into bins; each has one wave with all the variance of its bin, at a random wavenumber of it and in a
/// random phase. The four functions of a seed are independent. Random numbers and waves use additions, products,
/// quotients and roots only, so that a seed means the same track wherever arithmetic is that of IEEE 754 without fused
/// operations (but for tables of densities, which need a logarithm).
std::vector<Sinusoid> sinusoids_of(const SpectralIrregularities& spectral, Irregularity which);

/// Their sum [m].
double sum_of(const std::vector<Sinusoid>& sinusoids, double distance);

/// Offsets of the rails from their nominal places: along y (right) and z (down) of the path frame, with derivatives by
/// the distance [m], [-], [1/m].
struct RailOffsets {
  Along left_y, left_z, right_y, right_z;
};

/// The irregularities of a line as smooth functions: splines through measured points, or through samples of the waves
/// of a spectrum (twenty to the shortest of them; errors below 2e-4 of its amplitude). They grow from zero over the
/// wind-up length, by 10u^3 - 15u^4 + 6u^5, and are zero before it. Immutable; safe to use from several threads.
class Irregularities {
 public:
  /// end: distance up to which spectra are realised; tables have their own end [m]. Errors: those of check(spec);
  /// Error(configuration) for spectra over more than ten million samples, or 1e10 waves times samples.
  Irregularities(const IrregularitySpec& spec, double end);

  /// One function of the track [m].
  Along function(Irregularity which, double distance) const;
  /// What all four mean for the rails.
  RailOffsets at(double distance) const;

  /// Last distance with data [m]; behind it everything stays as it is there.
  double last() const { return last_; }
  /// Points of measured functions at which the spline is limited (LimitedSpline).
  int limited() const;

 private:
  IrregularitySpec spec_;  ///< without its table
  std::array<std::optional<LimitedSpline>, kIrregularities> splines_;
  double last_ = 0.0;
};

}  // namespace treadmark::vehicle
