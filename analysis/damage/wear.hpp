// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/analysis/damage/passed_patch.hpp"
#include "treadmark/model/damage/wear_law.hpp"

namespace treadmark::damage {

/// How fast the law removes depth, along the normal, below an element of the patch while it is there [m/s]. The law has
/// been checked. Thread-safe.
double depth_rate(const WearLaw& law, const PassedPatch& patch, const PassedElement& element);

}  // namespace treadmark::damage
