// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"
#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"

namespace treadmark::kalker::testing {

/// A problem with the pressures that go with it.
struct Case {
  ContactProblem problem;
  ContactSolution solution;

  ContactSolution& solve(TangentialSolver& solver) {
    solver.solve(problem, solution);
    return solution;
  }
  ContactSolution& solve() {
    TangentialSolver solver;
    return solve(solver);
  }
};

/// Hertz pressures at the element centres (exact, not solved on the grid).
inline Case hertz_case(const HertzShape& shape, const Grid2& grid) {
  Case c;
  c.problem.grid = grid;
  c.problem.regime = Regime::steady;
  c.solution.pressure.resize(grid.size());
  c.solution.state.assign(grid.size(), ElementState::exterior);
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double p = hertz_pressure(shape, grid.x(ix), grid.y(iy));
      if (!(p > 0.0)) continue;
      c.solution.pressure[grid.index(ix, iy)] = p;
      c.solution.state[grid.index(ix, iy)] = ElementState::adhesion;
    }
  return c;
}

/// A wheel-like ellipse, semi-axes 6.5 and 5 mm under 100 kN, n elements along it.
inline Case wheel_case(int n) {
  const HertzShape shape = hertz_from_semi_axes(6.5e-3, 5e-3, {true, 1e5}, combine(Material{}));
  const double scale = static_cast<double>(n + 4) / n;
  const int ny = static_cast<int>(std::lround(n * 5.0 / 6.5));
  Grid2 grid = hertz_grid(shape, n + 4, ny + 4, scale);
  return hertz_case(shape, grid);
}

struct Totals {
  double x = 0.0, y = 0.0, n = 0.0;  ///< forces [N]
  double power = 0.0;                ///< [W]; shift: work [J]
  double energy = 0.0;               ///< of tangential tractions [J]
  double moment = 0.0;               ///< about the normal [N m]
  int contact = 0, adhesion = 0, slip = 0;
};

inline Totals totals(const Case& c) {
  const ContactSolution& s = c.solution;
  const Grid2& g = c.problem.grid;
  const bool rolling = c.problem.regime == Regime::steady;
  Totals t;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const std::size_t i = g.index(ix, iy);
      t.x += s.traction_x[i] * g.cell_area();
      t.y += s.traction_y[i] * g.cell_area();
      t.n += s.pressure[i] * g.cell_area();
      t.moment += (s.traction_y[i] * g.x(ix) - s.traction_x[i] * g.y(iy)) * g.cell_area();
      t.power += (s.traction_x[i] * s.slip_x[i] + s.traction_y[i] * s.slip_y[i]) * g.cell_area() *
                 (rolling ? c.problem.rolling.velocity : 1.0);
      t.energy += 0.5 * (s.traction_x[i] * s.displacement_x[i] + s.traction_y[i] * s.displacement_y[i]) * g.cell_area();
      t.contact += s.state[i] != ElementState::exterior;
      t.adhesion += s.state[i] == ElementState::adhesion;
      t.slip += s.state[i] == ElementState::slip;
    }
  return t;
}

/// Forces relative to static friction times the normal force.
inline double relative(const Case& c, double force) {
  return force / (c.problem.friction.static_friction() * totals(c).n);
}

/// Largest difference of two fields.
inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double d = 0.0;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

inline double largest(const std::vector<double>& a) {
  double d = 0.0;
  for (const double v : a) d = std::max(d, std::abs(v));
  return d;
}

}  // namespace treadmark::kalker::testing
