// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/slip_friction.hpp"

#include <algorithm>

namespace treadmark::kalker {

namespace {

constexpr double kNoMemory = 1e-12;  ///< shorter memory distances [m] count as none

}  // namespace

bool FrictionOfPatch::constant() const {
  const auto depends = [](const FrictionLaw& law) { return law.kind != FrictionLaw::Kind::coulomb; };
  return rows.empty() ? !depends(*all) : std::none_of(rows.begin(), rows.end(), depends);
}

FrictionOfPatch friction_of(const ContactProblem& problem) { return {&problem.friction, problem.friction_of_row}; }

std::vector<double> friction_of_slip(const Patch& patch, const FrictionOfPatch& laws,
                                     std::span<const double> slip_speed, double time_step,
                                     std::span<const double> before, std::span<const double> temperature) {
  std::vector<double> mu(slip_speed.size());
  const bool steady = patch.transport != Transport::none;
  for (std::size_t i = 0; i < mu.size(); ++i) {
    const FrictionLaw& law = laws.at(patch, i);
    if (law.kind == FrictionLaw::Kind::coulomb) {
      mu[i] = law.kinetic;
      continue;
    }
    const double distance = time_step * std::max(slip_speed[i], law.memory_velocity);
    const double kept = law.memory_distance > kNoMemory ? law.memory_distance / (law.memory_distance + distance) : 0.0;
    double last = law.static_friction();
    if (!before.empty())
      last = before[i];
    else if (steady && patch.ahead[i] >= 0)
      last = mu[static_cast<std::size_t>(patch.ahead[i])];
    const bool warm = law.kind == FrictionLaw::Kind::temperature && !temperature.empty();
    mu[i] = kept * last + (1.0 - kept) * (warm ? law.at_temperature(temperature[i]) : law.at(slip_speed[i]));
  }
  return mu;
}

}  // namespace treadmark::kalker
