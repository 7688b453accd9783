// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "treadmark/solvers/vehicle/line_effects.hpp"

namespace treadmark::vehicle {

/// A force element and what it connects.
struct WheelOnRail {
  int wheelset = 0;  ///< from 0, leading one first
  wheelrail::Side side = wheelrail::Side::right;
  std::string name;  ///< "ws1_right"
  std::shared_ptr<ContactElement> element;
  Vec3 rail_marker = Vec3::Zero();  ///< profile origin of the rail at rest, track axes of the wheelset [m]
};

/// Displacements from the reference configuration and their rates, which a system has at one time.
struct SystemState {
  double time = 0.0;  ///< [s]
  Vector q, v;
};

/// Vehicle, track and contact elements. In the reference configuration every wheelset stands at x = speed * time with
/// pitch pitch_at_start - speed * time / R; on a line as far as that has travelled.
struct VehicleOnTrack {
  Multibody system;
  std::vector<WheelOnRail> wheels;
  double speed = 0.0;                  ///< V, at time 0 [m/s]; > 0
  std::vector<double> pitch_at_start;  ///< of each wheelset [rad]
  /// Of each wheel (see pair_map), from the coordinates of its vehicle.
  std::vector<Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic>> maps;
  std::shared_ptr<const LineEffects> line;  ///< null: straight and even, at constant speed

  /// Completes the maps. Errors: Error(configuration) for wheels of wheelsets that are not there, two elements at one
  /// place, a wheel without element, or a speed that is not positive.
  void connect();

  /// Index of a wheel's vehicle in Multibody::vehicles; wheel: index in wheels.
  int vehicle_of(std::size_t wheel) const {
    return system.wheelsets[static_cast<std::size_t>(wheels[wheel].wheelset)].vehicle;
  }
  /// Its coordinates.
  const Multibody::Range& range(std::size_t wheel) const {
    return system.vehicles[static_cast<std::size_t>(vehicle_of(wheel))];
  }
  /// What a wheel's pair coordinates are, or their rates.
  PairVector on_pair(std::size_t wheel, const Vector& coordinates) const {
    return maps[wheel] * part_of(coordinates, range(wheel));
  }
  /// Adds a generalised force on a wheel's pair coordinates.
  void add_force(std::size_t wheel, const PairVector& force, Vector& sum) const {
    part_of(sum, range(wheel)).noalias() += maps[wheel].transpose() * force;
  }

  /// How a wheelset moves over a rail in a state; wheel: index in wheels.
  PairMotion motion(std::size_t wheel, const SystemState& state) const;
  /// Since time 0.
  Travel travel(double time) const { return line ? line->travel(time) : Travel{speed * time, speed, 0.0}; }
  /// Of all masses together [m/s].
  double mean_speed(const SystemState& state) const;
  /// Rates of a wheel's pair coordinates that the travel of the reference configuration makes.
  PairVector travelling(std::size_t wheel, const SystemState& state) const;
  /// What the line does at a time; none without one.
  std::optional<LineState> line_state(double time) const {
    return line ? std::optional(line->state(time)) : std::nullopt;
  }
  /// Generalised forces that are not linear in the state: bump stops, and wheelsets that turn faster than at the start.
  /// at_line: at the same time.
  Vector other_forces(const SystemState& state, const std::optional<LineState>& at_line) const;
  /// Force elements in a state that they have come to from the reference configuration, along straight ways.
  ElementResponse resting_elements(const SystemState& state, const std::optional<LineState>& at_line) const;
  /// Nominal radius of a wheel [m].
  double radius(std::size_t wheel) const;
  /// Tangent of a wheel's reaction at a motion.
  PairTangent tangent(std::size_t wheel, const ContactReaction& reaction, const PairMotion& motion) const;

 private:
  PairMotion motion_on_line(std::size_t wheel, const SystemState& state) const;
};

}  // namespace treadmark::vehicle
