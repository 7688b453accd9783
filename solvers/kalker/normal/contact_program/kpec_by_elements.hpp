// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/solvers/kalker/normal/interpenetration.hpp"

namespace treadmark::kalker {

/// What KPEC takes from whole rows and elements in Conventions::contact: it jumps when another element is the deepest.

/// What Hertz' ellipse is found from: rows that overlap beyond a level [m], and the row of the deepest element.
Outline outline_of_elements(const Interpenetration& overlap, double level);
/// Factor on displacements [m] that makes them the overlap at the deepest element.
double scale_at_deepest(const Interpenetration& overlap, std::span<const double> displacement);

}  // namespace treadmark::kalker
