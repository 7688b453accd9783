// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/contact/friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/core/line.hpp"

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
      return kinetic + amplitude_1 * std::exp(-std::numbers::ln2 * r1) +
             amplitude_2 * std::exp(-std::numbers::ln2 * r2);
  }
  return kinetic;
}

double FrictionLaw::at_temperature(double temperature) const {
  const double share = temperature_range > 0.0               ? (temperature - reference_temperature) / temperature_range
                       : temperature > reference_temperature ? 1.0
                                                             : 0.0;
  return kinetic + temperature_change * std::clamp(share, 0.0, 1.0);
}

FrictionLaw between(const FrictionLaw& a, const FrictionLaw& b, double share) {
  FrictionLaw out = a;
  for (double FrictionLaw::*number :
       {&FrictionLaw::kinetic, &FrictionLaw::amplitude_1, &FrictionLaw::amplitude_2, &FrictionLaw::half_velocity_1,
        &FrictionLaw::half_velocity_2, &FrictionLaw::memory_distance, &FrictionLaw::memory_velocity,
        &FrictionLaw::reference_temperature, &FrictionLaw::temperature_change, &FrictionLaw::temperature_range})
    out.*number = (1.0 - share) * a.*number + share * b.*number;
  return out;
}

FrictionLaw friction_at(std::span<const double> positions, std::span<const FrictionLaw> laws, double position,
                        const FrictionLaw& otherwise) {
  if (positions.empty()) return otherwise;
  if (position <= positions.front()) return laws.front();
  if (position >= positions.back()) return laws.back();
  const std::size_t k = piece_at(positions, position);
  return between(laws[k], laws[k + 1], (position - positions[k]) / (positions[k + 1] - positions[k]));
}

}  // namespace treadmark
