// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

/// What holds for the solution of every patch, whatever the problem. A solution that breaks one of them is wrong.
enum class Invariant {
  finite,            ///< every number of the solution
  pressure,          ///< nowhere negative, and zero outside contact
  penetration,       ///< none where there is no pressure, over all elements (solved pressures; others do not ask)
  normal_force,      ///< a prescribed one is that of the pressures (solved pressures; assumed ones may miss it)
  traction_bound,    ///< no traction exceeds friction, nor does the force (not of the linear theory)
  sliding,           ///< tractions of slipping elements are as large as friction (not of a plastic layer)
  tangential_force,  ///< prescribed ones are those of the tractions (not with friction by row)
  dissipation,       ///< friction takes more energy than it gives
};

/// "finite", "pressure", ...: as in messages.
std::string_view to_string(Invariant invariant);

/// An invariant that a solution breaks.
struct Violation {
  Invariant invariant = Invariant::finite;
  double amount = 0.0;  ///< how much, in the measure of the text
  std::string text;     ///< what was found, with numbers
};

/// The first invariant that a solution breaks by more than this, eps being settings.eps: penetration, 10 eps + 1e-6 of
/// the greatest one of the rigid bodies; tractions above their bound, 10 eps of the greatest bound; slipping elements
/// below it, 100 eps + 1e-6 of the sum of their bounds; prescribed normal force, 100 eps + 1e-3, tangential ones, 10
/// eps + 1e-6 of friction; energy, that of a relative slip of eps, at least 1e-6. The limits leave room over what the
/// solvers reach. Of a solution without Status::ok only numbers that are not finite count, without contact nothing.
/// One pass over the elements. Thread-safe.
std::optional<Violation> broken_invariant(const ContactProblem& problem, const ContactSolution& solution);

/// Gives a solution that breaks an invariant Status::failed, in itself and in the report of its last solver, with a
/// message that names the invariant.
void require_invariants(const ContactProblem& problem, ContactSolution& solution);

}  // namespace treadmark::kalker
