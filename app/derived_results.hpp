// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::app {

/// Stresses below the surface that a case asks for, into the patch's result.
void add_derived(const io::BasicCase& input, const kalker::ContactProblem& problem, const kalker::ContactSolution& solution,
                 io::PatchResult& result);

/// What the head of a .mat file says of a basic case.
io::MatFileHead mat_head(const io::BasicCase& input, int case_number);

}  // namespace treadmark::app
