// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/solvers/solver_checks.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "treadmark/bench/solvers/solver_cases.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/kalker/tangential/friction_sweeps.hpp"

namespace treadmark::bench {
namespace {

using Force = std::array<double, 2>;

constexpr int kCheckedGrid = 70;
constexpr double kFourDigits = 1e-4;

Force force(const kalker::ContactSolution& s) { return {s.force_x, s.force_y}; }
double distance(const Force& a, const Force& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }
double relative(const Force& a, const Force& b) { return distance(a, b) / std::hypot(b[0], b[1]); }

kalker::ContactSolution solve(const kalker::ContactProblem& problem) {
  kalker::ContactSolution s = kalker::ContactSolver().solve(problem);
  // A solver that gave up agrees with nothing.
  if (s.status != Status::ok || s.tangential.status != Status::ok) s.force_x = std::numeric_limits<double>::quiet_NaN();
  return s;
}

/// Sweeps from zero tractions. Rigid slip is written out here, from Kalker 1990: W = dq (xi - phi y, eta + phi x).
Force force_by_sweeps(const HertzCase& c, const kalker::ContactSolution& normal) {
  const kalker::ContactProblem& p = c.problem;
  RollingMatrix matrix(p, normal);
  const std::size_t n = matrix.patch.cell.size();
  kalker::FrictionProblem problem;
  problem.matrix = &matrix.product;
  problem.rigid_slip.resize(2 * n);
  problem.bound.resize(n);
  const double dq = p.grid.dx, offset = p.rolling.spin_offset_factor * dq;
  for (std::size_t i = 0; i < n; ++i) {
    problem.bound[i] = p.friction.kinetic * normal.pressure[matrix.patch.grid_index(static_cast<int>(i))];
    problem.rigid_slip[i] = dq * (p.creepage.xi - p.creepage.phi * p.grid.y(matrix.patch.row[i]));
    problem.rigid_slip[n + i] = dq * (p.creepage.eta + p.creepage.phi * (p.grid.x(matrix.patch.column[i]) + offset));
  }
  kalker::Field2 traction(2 * n);
  kalker::FrictionSweeps(matrix.product).run(problem, traction, 1e-7, 400);
  const auto middle = traction.begin() + static_cast<std::ptrdiff_t>(n);
  const double area = p.grid.cell_area();
  return {area * std::accumulate(traction.begin(), middle, 0.0), area * std::accumulate(middle, traction.end(), 0.0)};
}

Force force_after_a_transient_step(const HertzCase& c) {
  kalker::ContactSolver solver;
  solver.solve(c.problem);
  kalker::ContactProblem next = c.problem;
  next.regime = kalker::Regime::transient;
  next.history = kalker::HistoryUse::keep_going;
  return force(solver.solve(next));
}

void check_one_grid(const CreepageRegime& regime, std::vector<SolverCheck>& out) {
  HertzCase c(kCheckedGrid, regime.creepage);
  const kalker::ContactSolution s = solve(c.problem);
  const Force f = force(s);
  out.push_back(
      {"forces, " + regime.name + ": Newton's method and sweeps", relative(f, force_by_sweeps(c, s)), kFourDigits});
  out.push_back({"forces, " + regime.name + ": steady and after a step of transient rolling",
                 relative(f, force_after_a_transient_step(c)), kFourDigits});
  c.problem.settings.eps = 1e-8;
  out.push_back({"forces, " + regime.name + ": eps 1e-5 and 1e-8", relative(f, force(solve(c.problem))), kFourDigits});
}

void check_pressure(std::vector<SolverCheck>& out) {
  const HertzCase c(kCheckedGrid, {});
  const kalker::ContactSolution s = kalker::ContactSolver().solve_normal(c.problem);
  const double hertz = kalker::hertz_max_pressure(c.shape);
  out.push_back({"greatest pressure and Hertz", std::abs(s.max_pressure / hertz - 1.0), 2e-3});
  out.push_back({"approach and Hertz", std::abs(s.approach / c.shape.approach - 1.0), 1e-3});
}

/// The difference between a grid and one of half its element size falls each time: by a half where the error is of
/// first order. Differences of the coarsest grids must merely fall: 35 elements are too few to show the order (0.91 at
/// small creepage).
void check_convergence(const CreepageRegime& regime, std::vector<SolverCheck>& out) {
  std::vector<Force> forces;
  for (const int n : {35, 70, 140, 280}) forces.push_back(force(solve(HertzCase(n, regime.creepage).problem)));
  for (std::size_t k = 2; k < forces.size(); ++k)
    out.push_back({"forces, " + regime.name + ": change by halving elements " + std::to_string(k) + " over that before",
                   distance(forces[k], forces[k - 1]) / distance(forces[k - 1], forces[k - 2]),
                   k + 1 < forces.size() ? 1.0 : 0.8});
}

}  // namespace

std::vector<SolverCheck> check_solvers() {
  std::vector<SolverCheck> out;
  check_pressure(out);
  for (const CreepageRegime& regime : creepage_regimes()) check_one_grid(regime, out);
  for (const CreepageRegime& regime : creepage_regimes()) check_convergence(regime, out);
  return out;
}

}  // namespace treadmark::bench
