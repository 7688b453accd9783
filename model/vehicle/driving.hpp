// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark {

/// How fast a vehicle runs: straight lines between points, constant behind the last one.
struct SpeedProfile {
  std::vector<double> time;   ///< from 0, increasing [s]
  std::vector<double> speed;  ///< at these times [m/s]; > 0
};

/// The same speed at all times [m/s].
inline SpeedProfile constant_speed(double speed) { return {{0.0}, {speed}}; }

/// How far and how fast at one time.
struct Travel {
  double distance = 0.0;      ///< since time 0 [m]
  double speed = 0.0;         ///< [m/s]
  double acceleration = 0.0;  ///< [m/s2]; at a point of the profile the one after it
};

/// time >= 0 [s].
Travel travel_at(const SpeedProfile& profile, double time);
/// When a distance >= 0 has been travelled [s].
double time_at(const SpeedProfile& profile, double distance);
/// [m/s]
double highest_speed(const SpeedProfile& profile);

/// A motor or brake on an axle.
struct AxleTorque {
  int wheelset = 0;            ///< from 0, the leading one
  std::vector<double> time;    ///< increasing [s]
  std::vector<double> torque;  ///< at these times, positive in traction [N m]; linear between, constant beyond
  std::string reaction;        ///< name of the body that holds the motor, or kGround
  SourcePosition where;
};

/// [N m]
double torque_at(const AxleTorque& torque, double time);

}  // namespace treadmark
