// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/slip_friction.hpp"

#include <algorithm>

namespace treadmark::kalker {

namespace {

constexpr double kNoMemory = 1e-12;  ///< shorter memory distances [m] count as none

}  // namespace

std::vector<double> friction_of_slip(const Patch& patch, const FrictionLaw& law, std::span<const double> slip_speed,
                                     double time_step) {
  std::vector<double> mu(slip_speed.size());
  const bool rolling = patch.transport != Transport::none;
  for (std::size_t i = 0; i < mu.size(); ++i) {
    const double distance = time_step * std::max(slip_speed[i], law.memory_velocity);
    const double kept = law.memory_distance > kNoMemory ? law.memory_distance / (law.memory_distance + distance) : 0.0;
    const double before =
        rolling && patch.ahead[i] >= 0 ? mu[static_cast<std::size_t>(patch.ahead[i])] : law.static_friction();
    mu[i] = kept * before + (1.0 - kept) * law.at(slip_speed[i]);
  }
  return mu;
}

}  // namespace treadmark::kalker
