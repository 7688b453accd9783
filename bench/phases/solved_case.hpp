// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>

#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::bench {

/// The wheel with a flat of `treadmark bench` on an undamaged rail, solved once.
struct SolvedCase {
  wheelrail::Geometry geometry;
  wheelrail::Problem problem;
  wheelrail::PairSolution solution;
};

/// backend: of the wheel.
const SolvedCase& solved_case(std::string_view backend);

/// Normal or whole problem of its patch.
kalker::ContactProblem patch_problem(const SolvedCase& solved);

}  // namespace treadmark::bench
