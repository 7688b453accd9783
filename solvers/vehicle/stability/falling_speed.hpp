// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/model/vehicle/driving.hpp"

namespace treadmark::vehicle {

/// A run in which the speed is held after a disturbance and then falls until the vehicle sways no more (cf. EN 14363;
/// Polach 2006).
struct FallSettings {
  double from = 0.0, to = 0.0;  ///< speeds [m/s]; from > to > 0
  double hold = 0.0;            ///< distance at the first speed, disturbance included; longer than three windows [m]
  double deceleration = 0.0;    ///< [m/s2]; > 0
  double window = 100.0;        ///< over which sway is averaged [m]
  double amplitude = 1e-4;      ///< of wheelsets, below which they do not sway [m]
};

/// Errors: Error(configuration) for settings that make no sense.
SpeedProfile profile_of(const FallSettings& settings);

/// Lateral motion of wheelsets, or forces on them, during a run.
struct SwayHistory {
  std::vector<double> distance, speed;    ///< of each instant; distance increases [m], [m/s]
  std::vector<std::vector<double>> sway;  ///< a list of all instants for each wheelset [m] or [N]
};

/// Sway over one window.
struct SwayAt {
  double distance = 0.0, speed = 0.0;  ///< in the middle of the window [m], [m/s]
  double rms = 0.0;                    ///< about the mean, of the wheelset that sways most [m] or [N]
};

/// A quarter of the window apart, from the first whole one on. Between instants, signals are straight lines.
std::vector<SwayAt> running_sway(const SwayHistory& history, double window);

/// Speed below which the sway stays below a limit up to the end of the run [m/s]; nothing where it is never above it
/// (never_above) or still is at the end.
struct LastAbove {
  bool never_above = false, at_end = false;
  double speed = 0.0;  ///< where neither
};
LastAbove last_above(const std::vector<SwayAt>& sway, double limit);

/// What a run says.
enum class FallVerdict {
  died,     ///< the limit cycle died on the way
  none,     ///< there was none at the first speed: sway died away, or did so when the speed began to fall
  lasting,  ///< it goes on at the last speed
};
struct FallResult {
  FallVerdict verdict = FallVerdict::none;
  double speed = 0.0;            ///< where it died [m/s]
  std::vector<SwayAt> sway;      ///< of the whole run
  double first_amplitude = 0.0;  ///< before the speed begins to fall [m]
};

/// Amplitudes are those of sines: sqrt(2) of the root mean square.
FallResult judge_fall(const SwayHistory& history, const FallSettings& settings);

/// Where a limit cycle dies in a fall that is endlessly slow, from two falls. It outlives its speed by what grows with
/// the deceleration: with its root where it shrinks to nothing, with its power 2/3 where it breaks down at once
/// (Berglund and Gentz 2006). A fall four times as slow is therefore about as far from there as it is from the other,
/// or nearer; half of that distance more stands for what these laws leave out.
struct SlowFall {
  double low = 0.0, high = 0.0;  ///< [m/s]
};
/// fast, slow: where it died at a deceleration and at a quarter of it [m/s].
SlowFall slowest_fall(double fast, double slow);

}  // namespace treadmark::vehicle
