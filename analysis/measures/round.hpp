// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/analysis/measures/section.hpp"

namespace treadmark::measures {

/// How one revolution is looked at.
struct RoundGauge {
  int orders = 30;                  ///< greatest order of the spectrum
  double flat_threshold = 0.05e-3;  ///< depth from which a dip is a flat [m]
  double longest_flat = 0.25;       ///< arc that no flat exceeds [m]
  double scatter = 0.0;             ///< of single samples before something smoothed them; 0: as they are [m]
};

/// One order of out-of-roundness: dr = sum over n of A_n cos(n theta + phi_n).
struct RoundOrder {
  int order = 0;
  double amplitude = 0.0, phase = 0.0;  ///< [m], [rad]
  double uncertainty = kUnknown;        ///< of the amplitude, as Measure [m]
  double level = 0.0;                   ///< of the order's root mean square re 1 um [dB]
  double wavelength = 0.0;              ///< along the circumference [m]
};

/// A dip of the radius.
struct RoundFlat {
  double theta = 0.0;           ///< of its deepest point [rad]
  Measure length;               ///< along the circumference, out to where the round wheel begins [m]
  Measure depth;                ///< [m]
  double chord_length = 0.0;    ///< of a fresh flat of this depth: sqrt(8 R d) [m]
  double rounded_length = 0.0;  ///< of a flat of this depth with rounded ends: sqrt(16 R d) [m]
};

/// What the radius over one revolution says.
struct RoundMeasures {
  double radius = 0.0;             ///< mean of the part without flats [m]
  Measure runout;                  ///< greatest less least radius
  Measure eccentricity;            ///< amplitude of order 1
  std::vector<RoundOrder> orders;  ///< from 2, of the part without flats
  struct Band {
    double wavelength = 0.0;  ///< nominal middle [m]
    double level = kUnknown;  ///< of the orders in the band [dB re 1 um]; NaN: there are none
  };
  std::vector<Band> bands;       ///< those within the orders
  std::vector<RoundFlat> flats;  ///< deepest first
  double scatter = 0.0;          ///< standard deviation that the orders leave of the part without flats [m]
  double gaps = 0.0;             ///< part of the revolution without data
};

/// theta: of the samples [rad], increasing within one revolution, NaN radii are gaps. Least squares over the samples
/// that are there, so gaps and flats do no harm to the orders. Thread-safe. Errors: Error(input_data) for fewer samples
/// than four times the orders, or gaps of more than a third.
RoundMeasures measure_round(std::span<const double> theta, std::span<const double> radius,
                            const RoundGauge& gauge = {});

}  // namespace treadmark::measures
