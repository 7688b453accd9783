// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>

#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::bench {

/// The wheel of `treadmark bench`, with its flat or round, on an undamaged rail, solved once.
struct SolvedCase {
  wheelrail::Geometry geometry;
  wheelrail::Problem problem;
  wheelrail::PairSolution solution;
};

/// With the flat. backend: of the wheel.
const SolvedCase& solved_case(std::string_view backend);

/// Both bodies as formulas, on elements of 0.5 mm.
const SolvedCase& solved_case_of_half_a_millimetre(bool flat);

/// Normal or whole problem of its patch.
kalker::ContactProblem patch_problem(const SolvedCase& solved);

}  // namespace treadmark::bench
