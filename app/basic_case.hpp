// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// Solves one patch of given geometry. Lack of contact or of convergence is a status of the result.
/// Errors: Error(configuration) for inconsistent input.
io::CaseResult solve_basic_case(const io::BasicCase& input);

}  // namespace treadmark::app
