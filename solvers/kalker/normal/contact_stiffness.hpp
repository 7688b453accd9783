// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

namespace treadmark::kalker {

/// Pressures that press the contact area down by one length: A q = 1 where inside is 1, q = 0 elsewhere [Pa/m]. By
/// conjugate gradients to a relative accuracy eps. Fields of the operator's box.
AlignedVector<double> pressure_of_unit_approach(const NormalOperator& op, const AlignedVector<double>& inside,
                                                double eps);

}  // namespace treadmark::kalker
