// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/solvers/vehicle/vehicle_on_track.hpp"

namespace treadmark::vehicle {

/// A damped vibration of the linearised system.
struct Eigenmode {
  double frequency = 0.0;                      ///< of the damped vibration [Hz]
  double damping_ratio = 0.0;                  ///< share of critical damping; negative: the vibration grows
  Eigen::VectorXcd shape;                      ///< of the coordinates, largest displacement 1
  std::vector<std::pair<int, double>> shares;  ///< (coordinate, share of the kinetic energy), largest first
};

/// Vibrations about a state of steady running, contacts linearised by differences at this speed, by frequency.
/// Motions without vibration are left out. Errors: Error(numerical) if the eigenvalues do not converge.
std::vector<Eigenmode> eigenmodes(const VehicleOnTrack& vehicle, const SystemState& state);

/// "car.z 83 %, bogie1.z 8 %": coordinates with most of the kinetic energy.
std::string describe(const Eigenmode& mode, const Multibody& system, std::size_t most = 4);

}  // namespace treadmark::vehicle
