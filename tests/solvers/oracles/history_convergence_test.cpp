// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker {
namespace {

constexpr double kFriction = 0.3;

/// Equal balls of steel, n elements across the contact, Poisson's ratio 0: Cattaneo's tractions are exact then.
testing::OwnedProblem balls(int n, double poisson, double eps) {
  const Material material{82e9, 82e9, poisson, poisson};
  const HertzShape shape = hertz_from_semi_axes(2.5e-3, 2.5e-3, {true, 1e4}, combine(material));
  testing::OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, n + 2, n + 2, 1.0 + 2.0 / n));
  owned.problem.material = material;
  owned.problem.hertz = shape;
  owned.problem.settings.eps = eps;
  owned.problem.friction.kinetic = kFriction;
  return owned;
}

/// Shifted by 0.8 of the friction bound and back to `force` of it: sum over Cattaneo's solutions (Mindlin & Deresiewicz
/// 1953).
std::vector<double> unloading_errors(int n) {
  const double most = 0.8, force = 0.2;
  testing::OwnedProblem owned = balls(n, 0.0, 1e-8);
  ContactProblem& problem = owned.problem;
  problem.regime = Regime::shift;
  ContactSolver solver;
  problem.fx_relative = -most;
  const ContactSolution loaded = solver.solve(problem);
  problem.history = HistoryUse::keep_going;
  problem.fx_relative = -force;
  const ContactSolution s = solver.solve(problem);
  EXPECT_EQ(s.status, Status::ok) << s.tangential.message;
  const HertzShape& shape = *problem.hertz;
  const double a = shape.semi_axis_x, p0 = hertz_max_pressure(shape);
  const double c1 = std::cbrt(1.0 - most), c2 = std::cbrt(1.0 - 0.5 * (most - force));
  const auto ellipse = [](double r, double c) { return r < c ? std::sqrt(c * c - r * r) : 0.0; };
  double sum = 0.0, size = 0.0;
  const Grid2& g = problem.grid;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const double r = std::hypot(g.x(ix), g.y(iy)) / a;
      const double exact = kFriction * p0 * (ellipse(r, 1.0) + ellipse(r, c1) - 2.0 * ellipse(r, c2));
      sum += std::pow(s.traction_x[g.index(ix, iy)] - exact, 2);
      size += exact * exact;
    }
  // shifts are proportional to 1 - (1 - F)^(2/3): that of the way back over that of the way out
  const double ratio = -2.0 * (1.0 - c2 * c2) / (1.0 - c1 * c1);
  return {std::sqrt(sum / size), s.creepage.xi / loaded.creepage.xi / ratio - 1.0};
}

TEST(HistoryConvergence, UnloadingTendsToMindlinAndDeresiewicz) {
  std::vector<double> tractions;
  for (const int n : {10, 20, 40, 80}) {
    const auto errors = unloading_errors(n);
    treadmark::testing::expect_documented("Mindlin", n, errors);
    tractions.push_back(errors[0]);
  }
  EXPECT_GT(tractions[0] / tractions[3], 6.0) << "first order: 8";
}

struct RollingBall {
  testing::OwnedProblem owned;
  double steady = 0.0, bound = 0.0;  ///< forces [N]

  explicit RollingBall(int n) : owned(balls(n, 0.28, 1e-8)) {
    ContactProblem& problem = owned.problem;
    problem.creepage.xi = -4e-4;
    problem.regime = Regime::steady;
    ContactSolver solver;
    steady = solver.solve(problem).force_x;
    bound = kFriction * problem.normal_force;
    problem.regime = Regime::transient;
  }

  /// Difference to the force of steady rolling, relative to the bound, after each of these distances in elements.
  std::vector<double> differences(double step_in_elements, const std::vector<int>& rolled) {
    ContactProblem& problem = owned.problem;
    problem.rolling.step = step_in_elements * problem.grid.dx;
    ContactSolver solver;
    ContactSolution s;
    std::vector<double> out;
    int done = 0;
    for (const int distance : rolled) {
      for (; done * step_in_elements < distance; ++done) {
        problem.history = done == 0 ? HistoryUse::start : HistoryUse::keep_going;
        s = solver.solve(problem);
        EXPECT_EQ(s.status, Status::ok) << s.tangential.message;
      }
      out.push_back((s.force_x - steady) / bound);
    }
    return out;
  }
};

TEST(HistoryConvergence, RollingFromRestTendsToSteadyRolling) {
  const std::vector<int> distances{4, 8, 16, 32, 64, 128}, shown{4, 8, 16, 32, 64};
  RollingBall rolling(20);
  const auto half = rolling.differences(0.5, distances), one = rolling.differences(1.0, distances);
  const auto two = rolling.differences(2.0, distances);
  for (std::size_t k = 0; k < shown.size(); ++k)
    treadmark::testing::expect_documented("rolled", shown[k], {half[k], one[k], two[k]});
  EXPECT_LT(std::abs(one.back()), 2e-5);
}

TEST(HistoryConvergence, LimitsOfOtherStepsApproachEachOtherOnFinerGrids) {
  double half_before = 1.0, two_before = 1.0;
  for (const int n : {10, 20, 40}) {
    RollingBall rolling(n);
    const double half = rolling.differences(0.5, {8 * n}).back(), two = rolling.differences(2.0, {8 * n}).back();
    treadmark::testing::expect_documented("limit", n, {half, two});
    EXPECT_LT(std::abs(half), half_before / 1.3);
    EXPECT_LT(std::abs(two), two_before / 2.0);
    half_before = std::abs(half);
    two_before = std::abs(two);
  }
}

}  // namespace
}  // namespace treadmark::kalker
