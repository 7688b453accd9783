// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace treadmark {

double FrictionLaw::at(double w) const {
  const auto ratio = [w](double half_velocity) { return half_velocity > 0.0 ? w / half_velocity : 0.0; };
  const double r1 = ratio(half_velocity_1), r2 = ratio(half_velocity_2);
  switch (kind) {
    case Kind::temperature:  // by the caller, who knows the temperature
    case Kind::coulomb:
      return kinetic;
    case Kind::linear:
      return kinetic + amplitude_1 * std::max(0.0, 1.0 - 0.5 * r1) + amplitude_2 * std::max(0.0, 1.0 - 0.5 * r2);
    case Kind::rational:
      return kinetic + amplitude_1 / (1.0 + r1) + amplitude_2 / (1.0 + r2 * r2);
    case Kind::exponential:
      return kinetic + amplitude_1 * std::exp(-std::numbers::ln2 * r1) + amplitude_2 * std::exp(-std::numbers::ln2 * r2);
  }
  return kinetic;
}

double FrictionLaw::at_temperature(double temperature) const {
  const double share = temperature_range > 0.0 ? (temperature - reference_temperature) / temperature_range
                                               : temperature > reference_temperature ? 1.0 : 0.0;
  return kinetic + temperature_change * std::clamp(share, 0.0, 1.0);
}

}  // namespace treadmark
