// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

namespace treadmark::bench {

/// What was compared, how far apart the two answers are and how far they may be.
struct SolverCheck {
  std::string what;
  double difference = 0.0, allowed = 0.0;
  bool passed() const { return difference <= allowed; }
};

/// Hertz' solution, Gauss-Seidel sweeps, a solution iterated much further, transient rolling that must stay where it
/// is, and forces that converge with the grid.
std::vector<SolverCheck> check_solvers();

}  // namespace treadmark::bench
