// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace treadmark::measures {

/// What passengers feel, after EN 12299: its indices from accelerations and rates of roll of a point of the car body.
/// Numbers of both formulas are those that the literature quotes, from memory; none was verified against the text of
/// the standard. Everything is a pure function and thread-safe.

/// Root mean squares of whole windows of so many samples (> 0), one behind the other from the first sample on.
std::vector<double> window_rms(std::span<const double> values, std::size_t samples);

/// Means over so many samples (> 0, even), half of them before each sample; NaN where the window leaves the signal.
std::vector<double> centred_means(std::span<const double> values, std::size_t samples);

/// Mean comfort N_MV by the 95 % percentiles of weighted accelerations over 5 s, W_d along and across, W_b upwards
/// [m/s2].
double mean_comfort(double longitudinal, double lateral, double vertical);

/// Largest magnitudes on a curve transition, of means over 1 s.
struct TransitionMotion {
  double acceleration = 0.0;  ///< lateral [m/s2]
  double jerk = 0.0;          ///< lateral [m/s3]
  double roll_rate = 0.0;     ///< [rad/s]
};

/// P_CT = 100 (max(acceleration A + jerk B - C, 0) + (D roll_rate)^E) %: passengers who find it uncomfortable, in a
/// row each whether they stand or sit (Harborough 1986).
struct TransitionDiscomfort {
  const char* quantity;  ///< of assessed_quantities
  double by_acceleration, by_jerk, threshold, by_roll, power;

  double percentage(const TransitionMotion& motion) const;
};
std::span<const TransitionDiscomfort> transition_discomforts();

}  // namespace treadmark::measures
