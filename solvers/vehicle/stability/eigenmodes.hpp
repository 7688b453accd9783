// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "treadmark/solvers/vehicle/vehicle_on_track.hpp"

namespace treadmark::vehicle {

/// A damped vibration of the linearised system, or a motion that decays or grows without one.
struct Eigenmode {
  std::complex<double> value;                  ///< eigenvalue, imaginary part >= 0 [1/s]
  double frequency = 0.0;                      ///< of the damped vibration [Hz]; 0: none
  double damping_ratio = 0.0;                  ///< share of critical damping; negative: the motion grows
  Eigen::VectorXcd shape;                      ///< of the coordinates, largest displacement 1
  std::vector<std::pair<int, double>> shares;  ///< (coordinate, share of the kinetic energy), largest first
};

/// Vibrations about a state of steady running, contacts linearised by differences at this speed, by frequency.
/// Motions without vibration are left out. Errors: Error(numerical) if the eigenvalues do not converge.
std::vector<Eigenmode> eigenmodes(const VehicleOnTrack& vehicle, const SystemState& state);

/// The same with the motions without vibration; of every conjugate pair the eigenvalue above the real axis. Angles on
/// which no force depends, as the pitch of round wheels, have no eigenvalue.
std::vector<Eigenmode> all_eigenmodes(const VehicleOnTrack& vehicle, const SystemState& state);

/// "car.z 83 %, bogie1.z 8 %": coordinates with most of the kinetic energy.
std::string describe(const Eigenmode& mode, const Multibody& system, std::size_t most = 4);

}  // namespace treadmark::vehicle
