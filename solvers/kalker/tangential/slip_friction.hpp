// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/friction.hpp"
#include "treadmark/solvers/kalker/tangential/patch.hpp"

namespace treadmark::kalker {

/// Coefficient of friction of every element from the slip speeds [m/s], with memory: on its way through the contact a
/// particle starts with static friction, and forgets it over the memory distance that it slides, at least at the memory
/// velocity (Vollebregt 2014). time_step is the time an element's length takes [s]; without rolling, of the shift.
std::vector<double> friction_of_slip(const Patch& patch, const FrictionLaw& law, std::span<const double> slip_speed,
                                     double time_step);

}  // namespace treadmark::kalker
