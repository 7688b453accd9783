// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

namespace treadmark::kalker {

/// Pressures of the elliptic, parabolic and semi-double-elliptic models from problem.hertz, about the origin of the
/// grid's axes. In: pressure and displacement_n of the grid's size, all 0. Out: these, approach, and Status::no_contact
/// if no element's centre lies in the contact. The displacement of an elliptic or parabolic pressure is that of the
/// undeformed contact area, of a semi-double-elliptic one that of the half-space. Errors: Error(configuration) without
/// a Hertz ellipse, or without both semi-axes along y for the last model.
void assume_pressure(const ContactProblem& problem, NormalOperatorCache& operators, ContactSolution& solution);

}  // namespace treadmark::kalker
