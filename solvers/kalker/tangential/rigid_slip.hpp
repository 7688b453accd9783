// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/tangential/patch.hpp"

namespace treadmark::kalker {

/// Distance over which the bodies would slip in a step if they were rigid [m], per element of the patch. Rolling: a step of
/// one element, with the spin centre displaced by spin_offset_factor of it (the mean of a step is meant, not its end).
/// Without rolling the creepages are the shift itself.
Field2 rigid_slip(const Patch& patch, const Creepage& creepage, double spin_offset_factor);

}  // namespace treadmark::kalker
