// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

namespace {

double at(const std::vector<double>& field, std::size_t i) { return i < field.size() ? field[i] : 0.0; }

/// Assumed pressures have no displacement field that belongs to them. Simplified theory has that of its elastic layer.
bool has_elastic_energy(const ContactProblem& problem) {
  const NormalModel normal = problem.normal_model;
  return normal != NormalModel::elliptic && normal != NormalModel::parabolic &&
         normal != NormalModel::semi_double_elliptic;
}

}  // namespace

void accumulate_totals(const ContactProblem& problem, ContactSolution& solution) {
  const Grid2& grid = problem.grid;
  double fn = 0.0, fx = 0.0, ft = 0.0, fy = 0.0, mx = 0.0, my = 0.0, mn = 0.0, energy = 0.0, power = 0.0;
  solution.max_pressure = 0.0;
  solution.elements_adhesion = solution.elements_slip = 0;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      if (i >= solution.state.size() || solution.state[i] == ElementState::exterior) continue;
      ++(solution.state[i] == ElementState::adhesion ? solution.elements_adhesion : solution.elements_slip);
      const double x = grid.x(ix), y = grid.y(iy);
      const double pn = solution.pressure[i], px = at(solution.traction_x, i), py = at(solution.traction_y, i);
      fn += pn;
      fx += px;
      fy += py;
      ft += std::hypot(px, py);
      mx += pn * y;
      my -= pn * x;
      mn += py * x - px * y;
      energy += pn * at(solution.displacement_n, i) + px * at(solution.displacement_x, i) +
                py * at(solution.displacement_y, i);
      // what is left of slip in adhesion is rounding
      if (solution.state[i] != ElementState::adhesion)
        power += px * at(solution.slip_x, i) + py * at(solution.slip_y, i);
      solution.max_pressure = std::max(solution.max_pressure, pn);
    }
  solution.elements_contact = solution.elements_adhesion + solution.elements_slip;

  const double area = grid.cell_area();
  solution.force_n = fn * area;
  solution.force_x = fx * area;
  solution.force_y = fy * area;
  solution.moment_x = mx * area;
  solution.moment_y = my * area;
  solution.moment_n = mn * area;
  solution.elastic_energy = has_elastic_energy(problem) ? 0.5 * energy * area : 0.0;
  const bool rolling = problem.regime == Regime::steady || problem.regime == Regime::transient;
  // with a plastic layer the tangential solver has counted its shear too
  if (solution.yield_stress.empty())
    solution.frictional_power = power * area * (rolling ? problem.rolling.velocity : 1.0);

  // Components below the accuracy of the tractions are zero; the lever is that of the contact's own size.
  const double negligible = 0.5 * problem.settings.eps * ft * area, lever = std::sqrt(solution.elements_contact * area);
  for (double* force : {&solution.force_x, &solution.force_y})
    if (std::abs(*force) < negligible) *force = 0.0;
  if (std::abs(solution.moment_n) < negligible * lever) solution.moment_n = 0.0;
}

}  // namespace treadmark::kalker
