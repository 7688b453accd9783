// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/contact_solver.hpp"

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/fastsim/fastsim.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"
#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"

namespace treadmark::kalker {

struct ContactSolver::Workspace {
  NormalSolver normal;
  TangentialSolver tangential;
};

ContactSolver::ContactSolver() : workspace_(std::make_unique<Workspace>()) {}
ContactSolver::~ContactSolver() = default;
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;
ContactSolver& ContactSolver::operator=(ContactSolver&&) noexcept = default;

void ContactSolver::reset() {
  workspace_->normal.reset();
  workspace_->tangential.reset();
}

ContactSolution ContactSolver::solve_normal(const ContactProblem& problem) {
  ContactSolution solution;
  workspace_->normal.solve(problem, solution);
  accumulate_totals(problem, solution);
  return solution;
}

void ContactSolver::solve_tangential(const ContactProblem& problem, ContactSolution& solution) {
  if (solution.pressure.size() != problem.grid.size())
    throw Error(ErrorKind::configuration, "the tangential problem needs the normal solution of the same grid", {},
                "call solve_normal first");
  if (problem.regime == Regime::frictionless || solution.status == Status::no_contact) return;
  if (problem.tangential_model == TangentialModel::fastsim)
    solve_fastsim(problem, solution);
  else
    workspace_->tangential.solve(problem, solution);
  solution.status = solution.normal.status != Status::ok ? solution.normal.status : solution.tangential.status;
  accumulate_totals(problem, solution);
}

ContactSolution ContactSolver::solve(const ContactProblem& problem) {
  ContactSolution solution = solve_normal(problem);
  solve_tangential(problem, solution);
  return solution;
}

}  // namespace treadmark::kalker
