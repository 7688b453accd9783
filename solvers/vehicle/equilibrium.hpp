// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/report.hpp"
#include "treadmark/solvers/vehicle/vehicle_on_track.hpp"

namespace treadmark::vehicle {

/// When forces count as balanced.
struct EquilibriumSettings {
  double tolerance = 1e-6;   ///< of every force over the largest wheelset load
  double acceptable = 1e-4;  ///< where forces jump with the elements in contact and let no state come nearer
  double doubtful = 1e-3;    ///< the same, with a message in the report
  int max_iterations = 60;   ///< of Newton's method
};

/// What to do where there is no equilibrium on straight track.
inline constexpr const char* kNoEquilibriumAdvice =
    "check the loads, the gauge and where the wheels stand at the start; smooth profiles that were measured "
    "(shape.smoothing_wavelength_mm)";

/// Steady running as it was found, or why not.
struct Equilibrium {
  Report report;
  SystemState state;                       ///< v: rates of pitch of wheelsets that roll freely
  std::vector<ContactReaction> reactions;  ///< of the wheels
  double residual = 0.0;                   ///< largest force that is not balanced, over the largest wheelset load
  int iterations = 0;                      ///< of Newton's method
};

/// Steady running at constant speed: positions of all bodies and pitch rates of the wheelsets for which all forces,
/// contact included, are in balance. Tried in turn: (1) Newton's method, contact linearised by differences, steps
/// halved until the imbalance falls; (2) slopes over wide differences, for rough wheels, whose forces jump with the
/// elements; (3) on curved lines, the same from where the vehicle is after some running in; (4) the same from wheelsets
/// that turn on the spot until no moment acts on them, for wheels that touch far from their nominal circle.
/// Vehicles that are free along the track (Multibody::free_along) are in balance but for an acceleration that all their
/// masses share: of what the wheels take, and of torques and forces that the speed of the line does not follow.
/// A state that is only doubtful has status ok and a message. Leaves the elements as they were.
/// easy: the same vehicle with contacts that cost less, whose balance is found first and led on to that of the others;
/// null: none.
Equilibrium find_equilibrium(const VehicleOnTrack& vehicle, const EquilibriumSettings& settings = {},
                             const VehicleOnTrack* easy = nullptr);

/// Forces of everything, linear about a state: -K d(coordinates) - C d(rates).
struct LinearSystem {
  Matrix stiffness, damping;  ///< K, C
};
/// coarseness: see linearised.
LinearSystem linearised_system(const VehicleOnTrack& vehicle, const SystemState& state, double coarseness = 1.0);

/// -d(generalised force of a wheel)/d(pair coordinates) and /d(their rates) by central differences about a motion: some
/// 1e-6 m and rad (heights 5e-8 m, roll 7e-8 rad) wide, times coarseness. Of coordinates that nothing in the system
/// moves only with all.
PairTangent linearised(const VehicleOnTrack& vehicle, std::size_t wheel, const SystemState& state,
                       double coarseness = 1.0, bool all = false);

}  // namespace treadmark::vehicle
