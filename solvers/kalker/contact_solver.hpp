// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

/// Solves one-patch contact problems: normal problem first, then the tangential one (Kalker 1990).
/// Keeps influence coefficients, FFT plans and the last solution, so that a sequence of similar problems is solved fast:
/// the last solution is the start value whenever the grid indices line up. Not thread-safe; use one per thread.
class ContactSolver {
 public:
  ContactSolver();
  ~ContactSolver();
  ContactSolver(ContactSolver&&) noexcept;
  ContactSolver& operator=(ContactSolver&&) noexcept;

  /// Normal problem only: tractions, creepage and slip of the solution stay empty.
  /// Errors: Error(configuration) for inconsistent input. A problem without contact gives Status::no_contact.
  ContactSolution solve_normal(const ContactProblem& problem);

  /// Adds the tangential solution of the problem's regime to a normal solution of the same problem.
  void solve_tangential(const ContactProblem& problem, ContactSolution& solution);

  /// Both.
  ContactSolution solve(const ContactProblem& problem);

  /// Forgets the last solution (not the coefficients).
  void reset();

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace treadmark::kalker
