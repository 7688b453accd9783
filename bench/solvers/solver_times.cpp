// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/solvers/solver_times.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

#include "treadmark/bench/solvers/solver_cases.hpp"
#include "treadmark/core/parallel.hpp"
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

namespace {

bool same_bits(const kalker::ContactSolution& a, const kalker::ContactSolution& b) {
  return a.pressure == b.pressure && a.displacement_n == b.displacement_n && a.traction_x == b.traction_x &&
         a.traction_y == b.traction_y && a.slip_x == b.slip_x && a.slip_y == b.slip_y && a.state == b.state &&
         a.force_x == b.force_x && a.force_y == b.force_y && a.approach == b.approach;
}

template <class Solve>
ThreadGain gain(const char* problem, int threads, int repetitions, const Solve& solve) {
  const auto on = [&](int count) {
    const ThreadLimit limit(count);
    return solve();
  };
  const kalker::ContactSolution one = on(1);
  ThreadGain out{problem, one.elements_contact, 0.0, 0.0, same_bits(one, on(threads))};
  if (!out.equal) return out;
  LeastTime least_one = not_yet(), least_several = not_yet();
  for (int i = 0; i < repetitions; ++i) {
    time_once(least_one, 1.0, [&] { on(1); });
    time_once(least_several, 1.0, [&] { on(threads); });
  }
  out.one = least_one.wall;
  out.several = least_several.wall;
  return out;
}

}  // namespace

std::vector<ThreadGain> gain_by_threads(int n, int threads, int repetitions) {
  HertzCase c(n, creepage_regimes()[1].creepage);
  const kalker::ContactSolution normal = kalker::ContactSolver().solve_normal(c.problem);
  const auto tangential = [&](const kalker::ContactProblem& problem) {
    kalker::ContactSolution s = normal;
    kalker::ContactSolver().solve_tangential(problem, s);
    return s;
  };
  kalker::ContactProblem shift = c.problem;
  shift.regime = kalker::Regime::shift;
  shift.creepage = {2e-6, 1e-6, 0.0};
  return {gain("normal", threads, repetitions, [&] { return kalker::ContactSolver().solve_normal(c.problem); }),
          gain("steady, partial slip", threads, repetitions, [&] { return tangential(c.problem); }),
          gain("shift", threads, repetitions, [&] { return tangential(shift); }),
          gain("whole steady contact", threads, repetitions, [&] { return kalker::ContactSolver().solve(c.problem); })};
}

}  // namespace treadmark::bench
