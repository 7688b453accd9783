// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::app {

/// The result file's view of the solution of a wheel-rail case, with the stresses below the surface that the case asks
/// for.
io::CaseResult to_result(const io::WheelRailCase& input, const wheelrail::PairSolution& solution);

}  // namespace treadmark::app
