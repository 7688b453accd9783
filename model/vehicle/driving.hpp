// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark {

/// How fast a vehicle runs: straight lines between points, constant behind the last one.
struct SpeedProfile {
  std::vector<double> time;   ///< from 0, increasing [s]
  std::vector<double> speed;  ///< at these times [m/s]; > 0
  /// Travelled until then [m]; empty: not known. Of profiles with many points, to find places fast.
  std::vector<double> distance = {};
};

/// The same speed at all times [m/s].
inline SpeedProfile constant_speed(double speed) { return {{0.0}, {speed}, {}}; }

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

/// A force from outside on a point of a body of the vehicle, or on the centres of mass of rails of one side, which run
/// along with the wheelsets above them.
struct BodyForce {
  std::string body;                ///< empty: on rails
  std::optional<int> wheelset;     ///< of rails: below which one, from 0; none: below all
  std::optional<bool> left;        ///< of rails
  std::optional<Vec3> point;       ///< of the vehicle at rest [m]; none: the centre of mass
  Freedom direction = Freedom::y;  ///< a moment about a rotation's axis
  std::vector<double> time;        ///< increasing [s]
  std::vector<double> force;       ///< at these times [N], [N m]; linear between, constant beyond
  SourcePosition where;
};
/// [N], [N m]
double force_at(const BodyForce& force, double time);

/// The ground end of a spring that is moved.
struct SpringMotion {
  std::string spring;
  Freedom direction = Freedom::y;
  std::vector<double> time;          ///< increasing, two at least [s]
  std::vector<double> displacement;  ///< at these times [m], [rad]; a smooth curve between, at rest beyond
  SourcePosition where;
};

/// Rails below wheels that are moved.
struct RailShift {
  std::optional<int> wheelset;       ///< from 0; none: all
  std::optional<bool> left;          ///< none: both rails
  Freedom direction = Freedom::z;    ///< y or z
  std::vector<double> time;          ///< increasing, two at least [s]
  std::vector<double> displacement;  ///< at these times [m]; a smooth curve between, at rest beyond
  SourcePosition where;
};

/// Twist of the track below a vehicle that is not turned by it as a whole: cross level over distance, between bogies
/// and within each of them, which grows, changes to the other sign and fades.
struct TwistTest {
  double vehicle = 0.0;         ///< over the distance between the middles of the bogies [m/m]
  double bogie = 0.0;           ///< over the wheelbase of each bogie [m/m]
  int wheelsets_per_bogie = 2;  ///< 1: single axles
  double period = 0.0;          ///< of all of it [s]
};
/// The rails that make it, a left and a right one below each wheelset. places: of the wheelsets along the vehicle, a
/// whole number of bogies [m].
std::vector<RailShift> twist_shifts(const TwistTest& test, std::span<const double> places);

}  // namespace treadmark
