// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/solvers/kalker/contact_gradient.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/history/contact_history.hpp"

namespace treadmark::kalker {

/// Solves one-patch contact problems: normal and tangential problem (Kalker 1990), one after the other, or in turns
/// until they agree where each acts on the other (dissimilar bodies; Panagiotopoulos 1975). Keeps influence
/// coefficients, FFT plans and the last solution, so that a sequence of similar problems is solved fast: the last
/// solution is the start value whenever the grid indices line up. Keeps the history of shifts and transient rolling.
/// Not thread-safe; use one per thread.
class ContactSolver {
 public:
  ContactSolver();
  ~ContactSolver();
  ContactSolver(ContactSolver&&) noexcept;
  ContactSolver& operator=(ContactSolver&&) noexcept;

  /// Normal problem only: tractions, creepage and slip of the solution stay empty. Does not touch the history.
  /// Errors: Error(configuration) for inconsistent input. A problem without contact gives Status::no_contact.
  ContactSolution solve_normal(const ContactProblem& problem);

  /// Adds the tangential solution of the problem's regime to a normal solution of the same problem; problem.history
  /// says from which instant it goes on. What comes out is the last instant from then on. For dissimilar bodies the
  /// normal solution changes too. Errors: Error(configuration), also for a grid that does not line up with that of the
  /// previous instant.
  void solve_tangential(const ContactProblem& problem, ContactSolution& solution);

  /// Both. Every solution keeps the invariants of solvers/kalker/invariants.hpp, or has Status::failed and a message
  /// that names the one it breaks. Errors: Error(configuration) also for magnitudes beyond model/magnitudes.hpp.
  ContactSolution solve(const ContactProblem& problem);

  /// Derivatives of a number of a solution of this problem by the gap, the prescribed force or approach and the
  /// creepages, by one linear system of pressures (README.md of normal/), and one of tractions where the number depends
  /// on them. The history stays as it is. Errors: Error(configuration) where pressures are approximate or depend on
  /// tractions, where tractions are approximate, their layer yields, their friction depends on anything or their force
  /// is prescribed, and as NormalSolver::gradient_by_gap.
  Gradient gradient(const ContactProblem& problem, const ContactSolution& solution, Quantity quantity);

  /// Forgets the last solution and the history (not the coefficients).
  void reset();

  /// Everything on which the following solutions depend, to the last bit: opaque, cheap to copy, independent of the
  /// solver.
  class State;
  /// The state after the last solution.
  std::shared_ptr<const State> save() const;
  /// Goes on from a state of save(), to the same bits.
  void restore(const std::shared_ptr<const State>& state);

  /// The last instant.
  const ContactHistory& history() const;
  /// Goes on from an instant that was computed elsewhere.
  void continue_from(ContactHistory instant);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace treadmark::kalker
