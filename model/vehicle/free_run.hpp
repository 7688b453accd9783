// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/model/vehicle/driving.hpp"

namespace treadmark {

/// A run whose speed follows from what acts along the track.
struct FreeRun {
  double resistance = 0.0;    ///< of the whole train against its running [N]
  double by_speed = 0.0;      ///< the same times the speed [N s/m]
  double by_square = 0.0;     ///< times its square [N s2/m2]
  std::vector<double> place;  ///< along the line, increasing [m]; empty: level
  /// Rise over length at them, positive where it climbs; linear between, constant beyond.
  std::vector<double> gradient;
};

/// Rise over length at a place of the line [m].
double gradient_at(const FreeRun& run, double place);
/// At a speed [m/s]: [N].
double resistance_at(const FreeRun& run, double speed);

/// A train and what drives and brakes it.
struct DrivenTrain {
  const VehicleModel& train;            ///< or a single vehicle
  std::span<const AxleTorque> torques;  ///< of wheelsets that are there
  std::span<const BodyForce> forces;    ///< those along x count
  double gravity = 9.81;                ///< [m/s2]
  double start = 0.0;                   ///< place of its x = 0 on the line at time 0 [m]
};

/// Speeds until a distance has been travelled, of all masses as one, turning wheelsets included: torques on axles over
/// nominal radii, forces from outside along x, gradients below every body, resistance. Errors: Error(configuration)
/// where the train comes to rest before.
SpeedProfile free_speed(const FreeRun& run, const DrivenTrain& train, double speed, double distance);

}  // namespace treadmark
