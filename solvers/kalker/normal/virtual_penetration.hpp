// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/normal/interpenetration.hpp"
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

namespace treadmark::kalker {

/// Approximate pressures for any gap at a prescribed approach by problem.normal_model kpec or analyn, without
/// iterations. In: pressure and displacement_n of the grid's size, all 0. Out: these, approach, and Status::no_contact
/// if nothing overlaps. The displacement is that of the half-space by the pressure, in the box of elements that
/// overlap; with kpec it equals the overlap in the mean over what overlaps by more than half the depth, in
/// Conventions::contact at the deepest element. Errors: Error(configuration) for a prescribed force, less than 3 x 3
/// elements, a gap of another size or not finite.
void solve_virtual_penetration(const ContactProblem& problem, NormalOperatorCache& operators,
                               ContactSolution& solution);

/// Contact area of KPEC, after Kik & Piotrowski (1996): the interpenetration is cut at a level that varies across the
/// rows such that an elliptic contact comes out as Hertz' ellipse. In each run of elements of a row the distribution is
/// a half ellipse as high as the run is half long. Returned: that distribution [m], of the grid's size, to be scaled by
/// the half-space's displacement. There must be contact. Continuous in the gap as long as runs do not join or part;
/// in Conventions::contact it is not, and ends of rows that lie further out than the ellipse reaches run on.
std::vector<double> kpec_distribution(const Interpenetration& overlap, const CombinedMaterial& material,
                                      Conventions conventions);

}  // namespace treadmark::kalker
