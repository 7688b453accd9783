// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>

#include "treadmark/solvers/kalker/tangential/patch_solver.hpp"

namespace treadmark::kalker {

/// How a search for the creepages of prescribed forces ended.
struct CreepageSearch {
  Creepage creepage;
  Status status = Status::ok;
  std::string message;
};

/// Creepages by which the prescribed forces of the problem arise; the others stay as given. solver: of the patch, left
/// in the solution. estimate: of the creepages, from a similar problem.
CreepageSearch search_creepage(const ContactProblem& problem, PatchSolver& solver,
                               const std::optional<Creepage>& estimate);

}  // namespace treadmark::kalker
