// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/solvers/kalker/normal/element_box.hpp"
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

namespace treadmark::kalker {

/// Normal displacement of the problem's bodies, sheet included, [m] inside a box of elements by the pressures [Pa]
/// inside that box; elements outside the box are left alone. Fields have the grid's size.
void half_space_displacement(NormalOperatorCache& operators, const ContactProblem& problem, const ElementBox& box,
                             std::span<const double> pressure, std::span<double> displacement);

}  // namespace treadmark::kalker
