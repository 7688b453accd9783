// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/contact_solver.hpp"

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/fastsim/fastsim.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"
#include "treadmark/solvers/kalker/normal/sub_patch_solver.hpp"
#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"

namespace treadmark::kalker {

struct ContactSolver::Workspace {
  NormalSolver normal;
  SubPatchSolver sub_patches;
  TangentialSolver tangential;
};

ContactSolver::ContactSolver() : workspace_(std::make_unique<Workspace>()) {}
ContactSolver::~ContactSolver() = default;
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;
ContactSolver& ContactSolver::operator=(ContactSolver&&) noexcept = default;

void ContactSolver::reset() {
  workspace_->normal.reset();
  workspace_->sub_patches.reset();
  workspace_->tangential.reset();
}

ContactSolution ContactSolver::solve_normal(const ContactProblem& problem) {
  ContactSolution solution;
  if (problem.sub_patches.count > 1)
    workspace_->sub_patches.solve(problem, solution);
  else
    workspace_->normal.solve(problem, solution);
  accumulate_totals(problem, solution);
  return solution;
}

void ContactSolver::solve_tangential(const ContactProblem& problem, ContactSolution& solution) {
  if (solution.pressure.size() != problem.grid.size())
    throw Error(ErrorKind::configuration, "the tangential problem needs the normal solution of the same grid", {},
                "call solve_normal first");
  if (problem.regime == Regime::frictionless) return;
  if (solution.status == Status::no_contact) {
    for (auto* field : {&solution.traction_x, &solution.traction_y, &solution.displacement_x, &solution.displacement_y,
                        &solution.slip_x, &solution.slip_y})
      field->assign(problem.grid.size(), 0.0);
    solution.friction.assign(problem.grid.size(), problem.friction.static_friction());
    solution.creepage = problem.creepage;
    return;
  }
  if (problem.tangential_model != TangentialModel::full)
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
