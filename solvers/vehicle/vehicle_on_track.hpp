// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "treadmark/solvers/vehicle/multibody.hpp"

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
/// pitch pitch_at_start - speed * time / R.
struct VehicleOnTrack {
  Multibody system;
  std::vector<WheelOnRail> wheels;
  double speed = 0.0;                                                         ///< V [m/s]; > 0
  std::vector<double> pitch_at_start;                                         ///< of each wheelset [rad]
  std::vector<Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic>> maps;  ///< of each wheel; see pair_map

  /// Completes the maps. Errors: Error(configuration) for wheels of wheelsets that are not there, two elements at one
  /// place, a wheel without element, or a speed that is not positive.
  void connect();

  /// How a wheelset moves over a rail in a state; wheel: index in wheels.
  PairMotion motion(std::size_t wheel, const SystemState& state) const;
  /// Nominal radius of a wheel [m].
  double radius(std::size_t wheel) const;
  /// Tangent of a wheel's reaction at a motion.
  PairTangent tangent(std::size_t wheel, const ContactReaction& reaction, const PairMotion& motion) const;
};

}  // namespace treadmark::vehicle
