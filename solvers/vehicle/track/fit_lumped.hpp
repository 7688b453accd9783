// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "treadmark/core/report.hpp"

namespace treadmark::vehicle {

/// A mass and what it rests on: the next layer, or the ground below the last one.
struct LumpedLayer {
  double mass = 0.0;       ///< [kg]
  double stiffness = 0.0;  ///< below it [N/m]
  double damping = 0.0;    ///< below it [N s/m]
};

/// Motion of the uppermost mass under a force of 1 N at it, frequency [Hz] [m/N].
std::complex<double> receptance(std::span<const LumpedLayer> layers, double frequency);

/// How far a receptance is from another one, by the logarithm of their quotient, to which magnitude and phase [rad]
/// contribute: 0.1 is a tenth, or a tenth of a radian.
struct ReceptanceError {
  double rms = 0.0;
  double worst = 0.0;            ///< largest magnitude of it
  double worst_frequency = 0.0;  ///< where [Hz]
};
ReceptanceError receptance_error(std::span<const LumpedLayer> layers, std::span<const double> frequency,
                                 std::span<const std::complex<double>> receptance);

/// Layers whose receptance is the nearest one, from the top.
struct LumpedFit {
  std::vector<LumpedLayer> layers;
  ReceptanceError error;
  Report report;  ///< not_converged: the best that was found
};

inline constexpr int kMostLumpedLayers = 3;

/// Least squares of the logarithm, every frequency counting the same, by the method of Levenberg (1944) and Marquardt
/// (1963) from a fixed set of starts; the numbers stay positive. frequency: positive, increasing [Hz]; receptance at
/// them [m/N], not zero. layers: 1 ... kMostLumpedLayers. Errors: Error(configuration) for fewer frequencies than
/// numbers to find.
LumpedFit fit_lumped(std::span<const double> frequency, std::span<const std::complex<double>> receptance, int layers);

}  // namespace treadmark::vehicle
