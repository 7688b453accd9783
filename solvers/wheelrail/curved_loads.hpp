// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/detection/curved_reference.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

/// Resultant on the rail of local tractions on a reference surface, in contact axes, moment about the contact
/// reference. Sums of the local components as they are stay in the contact solution. Without tractions (normal problem)
/// those of the pressures. Errors: Error(configuration) for rows that do not belong to the grid.
Wrench resultant_on(const detection::ReferenceRows& reference, const Grid2& grid,
                    const kalker::ContactSolution& contact);

/// Settings with the inclinations of the rows, if they ask for angle-corrected coefficients; others as given.
kalker::InfluenceSettings influence_on(const detection::ReferenceRows& reference, const Grid2& grid,
                                       kalker::InfluenceSettings given);

/// Law of friction of each row by the inclination of the reference surface in the track frame; empty where friction
/// does not vary.
std::vector<FrictionLaw> friction_on(const detection::ReferenceRows& reference, double contact_angle,
                                     const Problem& problem);

}  // namespace treadmark::wheelrail
