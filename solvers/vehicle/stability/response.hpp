// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "treadmark/model/vehicle/irregularities.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"

namespace treadmark::vehicle {

/// What shakes a vehicle.
struct ResponseInput {
  /// An irregularity of the track; a force on a wheel where it touches; by how much wheel and rail are further apart
  /// there, as one of them is rough: below one wheel, or along a rail, where all wheels of its side pass it.
  enum class Kind { irregularity, lateral_force, vertical_force, wheel_roughness, rail_roughness };
  Kind kind = Kind::irregularity;
  Irregularity which = Irregularity::longitudinal_level;
  std::size_t wheel = 0;  ///< of a force or a roughness, in VehicleOnTrack::wheels; of a rail any one on it
};

/// Complex amplitudes per unit of an input, e^(i w t) of all: of an irregularity or roughness [1/m], whose own phase is
/// that below the leading wheelset, of one wheel that below it; of a force [1/N].
struct FrequencyResponse {
  Eigen::VectorXcd coordinate;                ///< of the system [m], [rad]
  std::vector<std::complex<double>> lateral;  ///< forces of the wheels on the rails, track axes [N]
  std::vector<std::complex<double>> vertical;
};

/// A vehicle that runs steadily on a straight, linearised about that: contacts by differences, friction as it sticks or
/// slides there. Immutable; safe to use from several threads.
class LinearVehicle {
 public:
  /// state: an equilibrium. base: of cross level, for the roll of a rail [m]. Errors: Error(numerical) where a contact
  /// has no solution there.
  LinearVehicle(const VehicleOnTrack& vehicle, const SystemState& state, double base);

  /// frequency > 0 [Hz]. One response an input.
  std::vector<FrequencyResponse> at(double frequency, std::span<const ResponseInput> inputs) const;

 private:
  struct Wheel {
    PairTangent tangent;  ///< also of rails that are at rest
    Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic> map;
    double ahead = 0.0;                       ///< of the leading wheelset, negative behind it [m]
    double contact_y = 0.0, contact_z = 0.0;  ///< where it touches against the wheelset's centre [m]
    bool left = false;
  };
  Eigen::VectorXcd shaken(const Wheel& wheel, const ResponseInput& input, double omega, Eigen::VectorXcd& rates) const;

  LinearSystem system_;
  Vector mass_;
  std::vector<Wheel> wheels_;
  double speed_ = 0.0, base_ = 1.5;
};

}  // namespace treadmark::vehicle
