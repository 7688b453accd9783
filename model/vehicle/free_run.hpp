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
  std::span<const BodyForce> forces;    ///< those along x count, and moments about axles
  double gravity = 9.81;                ///< [m/s2]
  double start = 0.0;                   ///< place of its x = 0 on the line at time 0 [m]
};

/// All masses as one that turns its wheels: mass [kg], with I/R^2 of wheelsets that are free in pitch.
double running_mass(const VehicleModel& train);
/// Momentum that torques on axles (over nominal radii), moments on them and forces from outside along x give between
/// two times, exactly [N s].
double impulse(const DrivenTrain& train, double from, double to);
/// Times at which these have a point, increasing [s].
std::vector<double> points_in_time(const DrivenTrain& train);

/// Speeds until a distance has been travelled, of all masses as one: their momentum, gradients below every body,
/// resistance. Momentum of what acts and work of gradients are exact however fast they change; between the points of
/// the profile, which are at most 0.1 s apart and where torques and forces have theirs, speeds are straight lines.
/// Errors: Error(configuration) where the train comes to rest before, or the profile has more than a million points.
SpeedProfile free_speed(const FreeRun& run, const DrivenTrain& train, double speed, double distance);

/// Whether a speed is not the one that was asked for: by more than a hundredth, and by more than 1 cm/s [m/s].
bool is_another_speed(double speed, double wanted);

}  // namespace treadmark
