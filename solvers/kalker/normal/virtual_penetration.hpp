// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

namespace treadmark::kalker {

/// Approximate pressures for any gap at a prescribed approach by problem.normal_model kpec or analyn, without
/// iterations. In: pressure and displacement_n of the grid's size, all 0. Out: these, approach, and Status::no_contact
/// if nothing overlaps. The displacement is that of the half-space by the pressure, in the box of elements that
/// overlap; with kpec it equals the depth at the deepest element. Errors: Error(configuration) for a prescribed force,
/// less than 3 x 3 elements, a gap of another size or not finite.
void solve_virtual_penetration(const ContactProblem& problem, NormalOperatorCache& operators,
                               ContactSolution& solution);

}  // namespace treadmark::kalker
