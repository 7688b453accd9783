// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/virtual_penetration.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/normal/analyn.hpp"
#include "treadmark/solvers/kalker/normal/half_space_displacement.hpp"
#include "treadmark/solvers/kalker/normal/interpenetration.hpp"
#include "treadmark/solvers/kalker/normal/kpec.hpp"

namespace treadmark::kalker {

namespace {

void check_penetration_problem(const ContactProblem& problem) {
  const auto refuse = [&](const std::string& message, const std::string& advice) {
    const char* name = problem.normal_model == NormalModel::kpec ? "KPEC: " : "ANALYN: ";
    throw Error(ErrorKind::configuration, name + message, {}, advice);
  };
  const Grid2& grid = problem.grid;
  if (problem.force_prescribed)
    refuse("the force cannot be prescribed", "prescribe the approach, or use the full model");
  if (grid.nx < 3 || grid.ny < 3)
    refuse("the grid has " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " elements",
           "curvatures need three or more in both directions");
  if (problem.gap.size() != grid.size())
    refuse("the gap has " + std::to_string(problem.gap.size()) + " values for " + std::to_string(grid.size()) +
               " elements",
           "give one per element");
  for (const double h : problem.gap)
    if (std::isinf(h) && h < 0.0) refuse("the gap is not finite", "mark elements without contact by NaN");
}

}  // namespace

void solve_virtual_penetration(const ContactProblem& problem, NormalOperatorCache& operators,
                               ContactSolution& solution) {
  check_penetration_problem(problem);
  const Grid2& grid = problem.grid;
  const Interpenetration overlap(grid, problem.gap, problem.approach);
  solution.approach = problem.approach;
  const CombinedMaterial material = combine(problem.material);
  const bool kpec = problem.normal_model == NormalModel::kpec, quirks = problem.settings.reference_quirks;
  if (!overlap.box().empty())
    solution.pressure =
        kpec ? kpec_distribution(overlap, material, quirks) : analyn_pressure(overlap, material, quirks);
  const bool any = std::any_of(solution.pressure.begin(), solution.pressure.end(), [](double p) { return p > 0.0; });
  if (!any) {
    solution.status = solution.normal.status = Status::no_contact;
    return;
  }
  half_space_displacement(operators, problem, overlap.box(), solution.pressure, solution.displacement_n);
  if (!kpec) return;
  const int iy = overlap.deepest_row();
  const double scale = overlap.depth() / solution.displacement_n[grid.index(overlap.deepest_column(iy), iy)];
  for (double& p : solution.pressure) p *= scale;
  for (double& u : solution.displacement_n) u *= scale;
}

}  // namespace treadmark::kalker
