// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/sub_patch_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"

namespace treadmark::kalker {
namespace {

void check_sub_patches(const ContactProblem& problem) {
  const SubPatches& s = problem.sub_patches;
  const auto n = static_cast<std::size_t>(s.count);
  using Model = NormalModel;
  const Model model = problem.normal_model;
  if (model != Model::full && model != Model::kpec && model != Model::analyn)
    throw Error(ErrorKind::configuration, "sub-patches need pressures that follow from the gap", {},
                "use the full normal problem, KPEC or ANALYN");
  if (s.part.size() != problem.grid.size() || s.coupling.size() != n * n)
    throw Error(ErrorKind::configuration, "sub-patches need a part for every element and a factor for every pair");
  for (const double f : s.coupling)
    if (!(f >= 0.0 && f <= 1.0)) throw Error(ErrorKind::configuration, "a coupling factor is outside 0 to 1");
}

}  // namespace

struct SubPatchSolver::Workspace {
  NormalOperatorCache operators;
  std::vector<NormalSolver> solvers;
  NormalSolver whole;  ///< of all parts as one patch, under a prescribed force

  void solve_at(const ContactProblem& problem, ContactSolution& solution);
  void solve_under(const ContactProblem& problem, ContactSolution& solution);
};

SubPatchSolver::SubPatchSolver() : workspace_(std::make_unique<Workspace>()) {}
SubPatchSolver::~SubPatchSolver() = default;
SubPatchSolver::SubPatchSolver(SubPatchSolver&&) noexcept = default;
SubPatchSolver& SubPatchSolver::operator=(SubPatchSolver&&) noexcept = default;

std::vector<NormalStart> SubPatchSolver::start() const {
  std::vector<NormalStart> out;
  for (const NormalSolver& solver : workspace_->solvers) out.push_back(solver.start());
  return out;
}

void SubPatchSolver::start_from(std::vector<NormalStart> start) {
  workspace_->solvers.resize(start.size());
  for (std::size_t k = 0; k < start.size(); ++k) workspace_->solvers[k].start_from(std::move(start[k]));
}

void SubPatchSolver::reset() {
  for (NormalSolver& solver : workspace_->solvers) solver.reset();
}

void SubPatchSolver::solve(const ContactProblem& problem, ContactSolution& solution) {
  check_sub_patches(problem);
  if (problem.settings.conventions == Conventions::contact && problem.normal_model != NormalModel::full) {
    ContactProblem whole = problem;
    whole.sub_patches = {};
    if (workspace_->solvers.empty()) workspace_->solvers.emplace_back();
    return workspace_->solvers.front().solve(whole, solution);
  }
  if (problem.force_prescribed)
    workspace_->solve_under(problem, solution);
  else
    workspace_->solve_at(problem, solution);
}

/// By secants of force^(2/3), about linear in the approach, inside a bracket: parts that feel less of each other than
/// one patch are stiffer than it.
void SubPatchSolver::Workspace::solve_under(const ContactProblem& problem, ContactSolution& solution) {
  ContactProblem given = problem;
  given.sub_patches = {};
  whole.solve(given, solution);
  if (solution.status != Status::ok) return;
  given.sub_patches = problem.sub_patches;
  given.force_prescribed = false;
  const double wanted = std::cbrt(problem.normal_force * problem.normal_force);
  double low = std::numeric_limits<double>::infinity(), low_miss = -wanted, high = solution.approach, high_miss = 0.0;
  for (const double h : problem.gap)
    if (h < low) low = h;
  const double touching = low;
  bool closed = false;
  int side = 0;
  given.approach = high;
  constexpr int kMost = 60;
  for (int i = 0; i < kMost; ++i) {
    check_cancelled();
    solve_at(given, solution);
    const double miss = std::cbrt(solution.force_n * solution.force_n) - wanted;
    if (std::abs(solution.force_n - problem.normal_force) <= problem.settings.eps * problem.normal_force ||
        (solution.status != Status::ok && solution.status != Status::no_contact))
      return;
    // An end that stays counts half (Illinois; Dowell & Jarratt 1971).
    if (miss > 0.0) {
      if (side > 0) low_miss *= 0.5;
      high = given.approach, high_miss = miss, side = 1, closed = true;
    } else {
      if (side < 0) high_miss *= 0.5;
      low = given.approach, low_miss = miss, side = -1;
    }
    given.approach = closed ? low - low_miss * (high - low) / (high_miss - low_miss)
                            : touching + (given.approach - touching) * wanted / (miss + wanted) * 1.001;
  }
  solution.status = solution.normal.status = Status::not_converged;
  solution.normal.message = "no approach of the sub-patches gives the prescribed normal force";
}

void SubPatchSolver::Workspace::solve_at(const ContactProblem& problem, ContactSolution& solution) {
  const Grid2& grid = problem.grid;
  const SubPatches& sub = problem.sub_patches;
  const auto count = static_cast<std::size_t>(sub.count);
  const std::size_t n = grid.size();
  while (solvers.size() < count) solvers.emplace_back();
  const NormalOperator op = operators.get(grid.nx, grid.ny, 0, problem);

  // Displacement by each part alone, everywhere.
  std::vector<ContactSolution> parts(count);
  std::vector<std::vector<double>> caused(count, std::vector<double>(n, 0.0));
  std::vector<double> gap(n);
  double largest = 0.0, change = 0.0;
  int rounds = 0;
  const int max_rounds = std::max(2, problem.settings.max_outer);
  do {
    change = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        gap[i] = sub.part[i] == k + 1 ? problem.gap[i] : std::numeric_limits<double>::quiet_NaN();
        for (std::size_t j = 0; j < count; ++j)
          if (j != k) gap[i] += sub.coupling[k * count + j] * caused[j][i];
      }
      ContactProblem part = problem;
      part.sub_patches = {};
      part.gap = gap;
      const std::vector<double> before = std::move(parts[k].pressure);
      solvers[k].solve(part, parts[k]);
      if (parts[k].status == Status::no_contact) parts[k].pressure.assign(n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        largest = std::max(largest, parts[k].pressure[i]);
        change = std::max(change, std::abs(parts[k].pressure[i] - (before.empty() ? 0.0 : before[i])));
      }
      op.displacement(parts[k].pressure, caused[k]);
    }
    ++rounds;
  } while (change > problem.settings.eps * largest && rounds < max_rounds);

  solution = ContactSolution();
  solution.pressure.assign(n, 0.0);
  solution.displacement_n.assign(n, 0.0);
  solution.state.assign(n, ElementState::exterior);
  solution.approach = problem.approach;
  const bool full_influence = problem.settings.conventions == Conventions::contact;
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t own = sub.part[i] > 0 ? sub.part[i] - 1u : 0u;
    for (std::size_t k = 0; k < count; ++k) {
      const double felt = sub.part[i] > 0 && !full_influence ? sub.coupling[own * count + k] : 1.0;
      solution.displacement_n[i] += felt * caused[k][i];
      solution.pressure[i] += parts[k].pressure[i];
    }
    if (!(solution.pressure[i] > 0.0)) continue;
    solution.state[i] = ElementState::adhesion;
    ++solution.elements_contact;
    sum += solution.pressure[i];
    solution.max_pressure = std::max(solution.max_pressure, solution.pressure[i]);
  }
  solution.elements_adhesion = solution.elements_contact;
  solution.force_n = sum * grid.cell_area();
  solution.normal.iterations = rounds;
  solution.normal.residual = largest > 0.0 ? change / largest : 0.0;
  if (solution.elements_contact == 0) {
    solution.status = solution.normal.status = Status::no_contact;
    return;
  }
  const bool parts_converged = std::none_of(parts.begin(), parts.end(),
                                            [](const ContactSolution& s) { return s.status == Status::not_converged; });
  if (!parts_converged || change > problem.settings.eps * largest) {
    solution.status = solution.normal.status = Status::not_converged;
    solution.normal.message = "the sub-patches of a contact did not converge with each other";
  }
}

}  // namespace treadmark::kalker
