// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

namespace treadmark {

/// Coefficient of friction as a function of the local slip velocity w [m/s]:
/// coulomb:      mu = kinetic (= static)
/// linear:       mu = kinetic + sum_i amplitude_i * max(0, 1 - w / (2 half_velocity_i))
/// rational:     mu = kinetic + amplitude_1/(1 + w/half_velocity_1) + amplitude_2/(1 + (w/half_velocity_2)^2)
/// exponential:  mu = kinetic + sum_i amplitude_i * exp(-ln2 w / half_velocity_i)
/// temperature:  mu = reference + change * (T - reference_temperature) / temperature_range, between the two
/// temperatures; T: surface of body 1
struct FrictionLaw {
  /// The formula, see above.
  enum class Kind { coulomb, linear, rational, exponential, temperature };
  Kind kind = Kind::coulomb;
  double kinetic = 0.3;                                 ///< at great slip velocities [-]
  double amplitude_1 = 0.0, amplitude_2 = 0.0;          ///< [-]
  double half_velocity_1 = 0.0, half_velocity_2 = 0.0;  ///< [m/s]
  double memory_distance = 1e-6;                        ///< [m]
  double memory_velocity = 0.01;                        ///< s0 [m/s]
  /// temperature: kinetic is the reference; [deg C], [-], [K]
  double reference_temperature = 0.0, temperature_change = 0.0, temperature_range = 1.0;

  /// Friction at vanishing slip; scales forces relative to the maximum.
  double static_friction() const { return kinetic + amplitude_1 + amplitude_2; }
  /// Stationary friction at slip velocity w >= 0 [m/s].
  double at(double slip_velocity) const;
  /// Kind::temperature: friction where the surface of body 1 has this temperature [deg C].
  double at_temperature(double temperature) const;
  friend bool operator==(const FrictionLaw&, const FrictionLaw&) = default;
};

/// The law between two others of the same kind, number by number. share: 0 = a, 1 = b.
FrictionLaw between(const FrictionLaw& a, const FrictionLaw& b, double share);

/// The law at a position between given ones, the first or last one beyond them; none given: otherwise.
FrictionLaw friction_at(std::span<const double> positions, std::span<const FrictionLaw> laws, double position,
                        const FrictionLaw& otherwise);

}  // namespace treadmark
