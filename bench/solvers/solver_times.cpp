// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/solvers/solver_times.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

#include "treadmark/bench/solvers/solver_cases.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"

namespace treadmark::bench {
namespace {

constexpr int kTransientSteps = 3;
constexpr std::size_t kTransientFrom = 0, kTransientTo = 1;  ///< regimes: tractions have to change

/// Processor time as well, for on a busy machine the wall clock counts others' work.
template <class Work>
void time_once(LeastTime& least, double share, const Work& work) {
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  work();
  least.cpu = std::min(least.cpu, share * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
  least.wall =
      std::min(least.wall, share * std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count());
}

LeastTime not_yet() { return {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()}; }

SolverTime outcome(const char* problem, const HertzCase& c, LeastTime time, const kalker::ContactSolution& s,
                   const Report& report) {
  SolverTime out{problem,   c.problem.grid.nx, s.elements_contact,         time, report.iterations, 0.0, s.force_x,
                 s.force_y, c.saturation(s),   report.status == Status::ok};
  return out;
}

SolverTime time_normal(const HertzCase& c, int repetitions, kalker::ContactSolution& solution) {
  LeastTime least = not_yet();
  for (int i = 0; i < repetitions; ++i)
    time_once(least, 1.0, [&] { solution = kalker::ContactSolver().solve_normal(c.problem); });
  return outcome("normal", c, least, solution, solution.normal);
}

SolverTime time_steady(const HertzCase& c, int repetitions, const kalker::ContactSolution& normal) {
  LeastTime least = not_yet();
  kalker::ContactSolution s;
  for (int i = 0; i < repetitions; ++i) {
    s = normal;
    kalker::ContactSolver solver;
    time_once(least, 1.0, [&] { solver.solve_tangential(c.problem, s); });
  }
  return outcome("steady", c, least, s, s.tangential);
}

SolverTime time_transient(HertzCase& c, int repetitions, const kalker::ContactSolution& normal) {
  LeastTime least = not_yet();
  kalker::ContactSolution s;
  int iterations = 0;
  bool converged = true;
  for (int i = 0; i < repetitions; ++i) {
    kalker::ContactSolver solver;
    c.problem.creepage = creepage_regimes()[kTransientFrom].creepage;
    s = normal;
    solver.solve_tangential(c.problem, s);
    c.problem.creepage = creepage_regimes()[kTransientTo].creepage;
    kalker::ContactProblem step = c.problem;
    step.regime = kalker::Regime::transient;
    step.history = kalker::HistoryUse::keep_going;
    iterations = 0;
    time_once(least, 1.0 / kTransientSteps, [&] {
      for (int k = 0; k < kTransientSteps; ++k) {
        s = normal;
        solver.solve_tangential(step, s);
        iterations += s.tangential.iterations;
        converged = converged && s.tangential.status == Status::ok;
      }
    });
  }
  SolverTime out = outcome("transient step", c, least, s, s.tangential);
  out.iterations = (iterations + kTransientSteps - 1) / kTransientSteps;
  out.converged = converged;
  return out;
}

/// A product with the matrix and one with the preconditioner [s].
double time_of_products(const HertzCase& c, const kalker::ContactSolution& normal) {
  RollingMatrix matrix(c.problem, normal);
  std::vector<double> p(2 * matrix.patch.cell.size(), 1.0), s(p.size());
  LeastTime least = not_yet();
  for (int i = 0; i < 10; ++i)
    time_once(least, 1.0, [&] {
      matrix.product.slip(p, s);
      matrix.product.inverse_displacement(s, p);
    });
  return least.cpu;
}

}  // namespace

std::vector<SolverTime> time_solvers(int n, int repetitions) {
  HertzCase c(n, {});
  kalker::ContactSolution normal;
  std::vector<SolverTime> out{time_normal(c, repetitions, normal)};
  const double products = time_of_products(c, normal);
  for (const CreepageRegime& regime : creepage_regimes()) {
    c.problem.creepage = regime.creepage;
    out.push_back(time_steady(c, repetitions, normal));
    out.back().problem += ", " + regime.name;
    out.back().products = out.back().time.cpu / products;
  }
  out.push_back(time_transient(c, repetitions, normal));
  out.back().products = out.back().time.cpu / products;
  return out;
}

}  // namespace treadmark::bench
