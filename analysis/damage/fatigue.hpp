// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/analysis/damage/passed_patch.hpp"
#include "treadmark/model/damage/fatigue.hpp"

namespace treadmark::damage {

/// Largest pressure over shear yield at which a line contact in full slip shakes down, by its coefficient of friction
/// >= 0: Johnson's map. Thread-safe.
double shakedown_limit(double friction);

/// What a passage with this T gamma [N] takes of a life, of settings with whole_life that have been checked.
/// Thread-safe.
double passage_damage(const FatigueSettings& settings, double t_gamma);

/// What the patch as a whole does to a body. The settings have been checked. Thread-safe.
ContactFatigue contact_fatigue(const FatigueSettings& settings, const PassedPatch& patch);

}  // namespace treadmark::damage
