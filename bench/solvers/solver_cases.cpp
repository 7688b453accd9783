// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/solvers/solver_cases.hpp"

#include <cmath>

#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/kalker/tangential/patch_solver.hpp"

namespace treadmark::bench {

const std::vector<CreepageRegime>& creepage_regimes() {
  static const std::vector<CreepageRegime> regimes{{"small", {-1.2e-4, -0.8e-4, 0.06}},
                                                   {"partial slip", {-6e-4, -4e-4, 0.3}},
                                                   {"near saturation", {-3e-3, -2e-3, 0.3}}};
  return regimes;
}

HertzCase::HertzCase(int n, const kalker::Creepage& creepage) {
  constexpr double kSemiAxisX = 8e-3, kSemiAxisY = 4e-3, kForce = 82e3, kCover = 1.1;
  problem.material.shear_modulus_1 = problem.material.shear_modulus_2 = 82e9;
  problem.material.poisson_1 = problem.material.poisson_2 = 0.28;
  problem.friction.kinetic = 0.3;
  shape = kalker::hertz_from_semi_axes(kSemiAxisX, kSemiAxisY, {true, kForce}, combine(problem.material));
  problem.grid = kalker::hertz_grid(shape, n, n, kCover);
  gap = kalker::hertz_gap(shape, problem.grid);
  problem.gap = gap;
  problem.normal_force = kForce;
  problem.regime = kalker::Regime::steady;
  problem.rolling.step = problem.grid.dx;
  problem.settings.eps = 1e-5;
  problem.creepage = creepage;
}

double HertzCase::saturation(const kalker::ContactSolution& solution) const {
  return std::hypot(solution.force_x, solution.force_y) / (problem.friction.static_friction() * problem.normal_force);
}

RollingMatrix::RollingMatrix(const kalker::ContactProblem& problem, const kalker::ContactSolution& normal)
    : patch(kalker::make_patch(problem.grid, kalker::Transport::forward, normal.state)),
      compliance(kalker::compliance_key(patch, problem.material, nullptr)),
      product(patch, compliance) {}

}  // namespace treadmark::bench
