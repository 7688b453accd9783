// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/report.hpp"
#include "treadmark/solvers/vehicle/stability/eigenmodes.hpp"

namespace treadmark::vehicle {

/// Vehicle, track and contacts at a speed [m/s]. Contact elements may be the same at all speeds.
using VehicleAtSpeed = std::function<VehicleOnTrack(double speed)>;

struct StabilitySettings {
  std::vector<double> speeds;     ///< > 0, increasing [m/s]
  double speed_tolerance = 0.01;  ///< of the critical speed [m/s]
  /// Growth that counts as none: that of what rolls on at any speed, up to rounding [1/s].
  double neutral = 1e-4;
};

/// Motions about steady running at one speed.
struct ModesAtSpeed {
  double speed = 0.0;            ///< [m/s]
  Report report;                 ///< of the equilibrium; without one there are no modes
  double residual = 0.0;         ///< of the equilibrium, see Equilibrium
  std::vector<Eigenmode> modes;  ///< all of them
  std::vector<int> branch;       ///< of each mode: the same at another speed belongs to the same motion
  /// Indices into modes.
  std::optional<std::size_t> least_damped;    ///< of the vibrations
  std::optional<std::size_t> fastest_growth;  ///< of all that grow
};

/// Where steady running becomes unstable.
struct CriticalSpeed {
  double speed = 0.0, error = 0.0;  ///< the change lies no further away than the error [m/s]
  ModesAtSpeed beyond;              ///< at a speed that far beyond; its fastest growth is what becomes unstable
};

/// What the speeds say together.
enum class StabilityVerdict {
  stable,    ///< at all speeds
  critical,  ///< up to a critical speed
  unstable,  ///< at the lowest speed already
  unknown,   ///< steady running was not found at a speed before any that is unstable
};

struct StabilityResult {
  std::vector<ModesAtSpeed> at;  ///< by speed
  StabilityVerdict verdict = StabilityVerdict::unknown;
  std::optional<CriticalSpeed> critical;
};

/// Equilibrium, all eigenmodes and what grows, at one speed.
ModesAtSpeed modes_at_speed(const VehicleAtSpeed& vehicle, double speed, double neutral = StabilitySettings{}.neutral);

/// Eigenmodes of the vehicle linearised about steady running, speed by speed, followed from each speed to the next by
/// nearness of eigenvalues and shapes, and the lowest speed at which a motion begins to grow, by bisection between the
/// first two speeds that differ in that. What happens within an interval whose ends are both stable is not seen.
/// Linear: of motions so small that contact and springs are what they are in equilibrium. Errors: Error(configuration)
/// for speeds and tolerances that make no sense, Error(numerical) as all_eigenmodes. May be cancelled.
StabilityResult stability(const VehicleAtSpeed& vehicle, const StabilitySettings& settings);

}  // namespace treadmark::vehicle
