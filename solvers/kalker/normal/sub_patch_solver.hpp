// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"

namespace treadmark::kalker {

/// Normal problem of a patch with sub-patches: each one is solved with the displacement that the others cause in it,
/// scaled by the coupling factors, in turn until nothing changes. The parts lie apart, so that a few rounds suffice. A
/// prescribed force is that of all parts together, at one approach.
/// Not thread-safe; keeps coefficients and the last solution of every part.
class SubPatchSolver {
 public:
  SubPatchSolver();
  ~SubPatchSolver();
  SubPatchSolver(SubPatchSolver&&) noexcept;
  SubPatchSolver& operator=(SubPatchSolver&&) noexcept;

  /// Fills the solution as NormalSolver does. A part that does not touch stays without pressure.
  /// Errors: Error(configuration) for wrong sizes or factors outside 0 .. 1; those of NormalSolver.
  void solve(const ContactProblem& problem, ContactSolution& solution);
  void reset();
  /// What the next problem starts from, part by part, to be saved and restored.
  std::vector<NormalStart> start() const;
  void start_from(std::vector<NormalStart> start);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace treadmark::kalker
