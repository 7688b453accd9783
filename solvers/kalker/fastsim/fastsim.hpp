// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/history/contact_history.hpp"

namespace treadmark::kalker {

/// Rolling by simplified theory: steady, with a step of dx and in the direction 0 or pi, or a step of transient rolling
/// in any direction (FASTSIM only). Friction depends on the one slip velocity V sqrt(xi^2 + eta^2). Slope reduction
/// after Spiryagin et al. (2013). By problem.tangential_model:
/// - fastsim: FASTSIM (Kalker 1982), three flexibilities from the linear theory, blended with a single one for large
///   creepage;
/// - fastsim_one_flexibility: FASTSIM with fastsim.flexibility in both directions and for spin;
/// - fastrip: FaStrip (Sichani, Enblom & Berg 2016): tractions of strip theory where it finds adhesion, the directions
///   of FASTSIM elsewhere (strip_theory.hpp); slope reduction turns these directions, sizes are those of strip theory.
/// Thread-safe: no state is kept.
///
/// previous: what transient rolling goes on from, on the problem's grid; empty: the bodies come together from rest. The
/// elastic layer keeps the displacements that it had; of an instant by another theory it takes over the tractions.
///
/// In: problem.grid, material, friction, creepage or relative forces, rolling, fastsim, hertz (its semi-axes replace
/// those of an ellipse equivalent to the contact area in the flexibilities); solution.pressure. Out: traction_x/y,
/// displacement_x/y (of the simplified theory), slip_x/y, friction, state, creepage, rolling_step and the report
/// `tangential`. Prescribed forces are found by Newton iterations on the creepage to settings.eps times the friction
/// bound; a force that friction cannot transmit gives Status::not_converged. Errors: Error(configuration) for
/// regimes and directions of rolling other than these, sizes that do not fit, a flexibility that is not positive.
void solve_fastsim(const ContactProblem& problem, ContactSolution& solution, const ContactHistory& previous = {});

}  // namespace treadmark::kalker
