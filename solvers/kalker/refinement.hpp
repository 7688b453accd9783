// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/pose.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"

namespace treadmark::kalker {

/// By how much a solution would still change with ever smaller elements: estimates, relative, not negative.
struct Refinement {
  double pressure = 0.0;  ///< the largest one
  double area = 0.0;      ///< of contact
  /// The normal force, where the approach is what is given, or the tangential force over the friction bound, whichever
  /// changes more.
  double force = 0.0;
  /// How the largest pressure grows with smaller elements: as their size to the power of minus this, seen between
  /// these elements and those three times as large. About 0 of smooth bodies, 1/2 at edges; 0 where it was not seen.
  double peak_exponent = 0.0;
  Vec2 peak = Vec2::Zero();  ///< where the largest pressure is, in the axes of the grid [m]
};

/// Solves the problem once more on every third element of its grid, in both directions, and takes half of the
/// difference: what is left of an error that is proportional to the size of elements (Richardson 1911). Pressures and
/// normal forces of smooth bodies converge faster, so that theirs is an upper bound. The number of elements across
/// tells as well, and alone where thirds of them are too few, of the tractions of transient rolling and shifts, and
/// with tables of coefficients. load_given: the approach of the problem is that of a given force. coarse: a solver for
/// it, which keeps nothing from one call to the next but coefficients. A solution with contact.
Refinement estimate_refinement(const ContactProblem& problem, const ContactSolution& solution, bool load_given,
                               ContactSolver& coarse);

}  // namespace treadmark::kalker
