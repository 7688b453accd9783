// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/analysis/damage/passed_patch.hpp"
#include "treadmark/model/damage/wear_law.hpp"

namespace treadmark::damage {

/// How fast the law removes depth, along the normal, below an element of the patch while it is there [m/s]. The law has
/// been checked. Thread-safe.
double depth_rate(const WearLaw& law, const PassedPatch& patch, const PassedElement& element);

/// Volume by distance rolled [m3/m] that a law, not Archard's, removes below a patch with this T gamma [N], area > 0
/// [m2] and rolling speed > 0 [m/s], as if its friction were even. Thread-safe.
double volume_by_distance(const WearLaw& law, double t_gamma, double area, double speed);

}  // namespace treadmark::damage
