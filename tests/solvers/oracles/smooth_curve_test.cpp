// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker {
namespace {

struct Curve {
  double largest_bend = 0.0;  ///< second difference of the force between creepages, relative to the friction bound
  double one_element = 0.0;   ///< greatest friction bound of an element, relative to that of all
  double last = 0.0;          ///< greatest force, the same
  bool rises = true;
};

/// `count` creepages of steady rolling to beyond saturation, on n elements across the contact each way.
Curve traction_curve(int n, int count) {
  const Material material;
  const HertzShape shape = hertz_from_semi_axes(5e-3, 7e-3, {true, 8e4}, combine(material));
  testing::OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, n + 2, n + 2, 1.0 + 2.0 / n));
  ContactProblem& problem = owned.problem;
  problem.regime = Regime::steady;
  problem.settings.eps = 1e-6;
  const double bound = problem.friction.kinetic * problem.normal_force;
  ContactSolver solver;
  std::vector<double> force;
  Curve curve;
  for (int i = 1; i <= count; ++i) {
    problem.creepage.xi = -6e-3 * i / count;
    const ContactSolution s = solver.solve(problem);
    EXPECT_EQ(s.status, Status::ok) << s.tangential.message;
    force.push_back(s.force_x / bound);
    curve.one_element = problem.friction.kinetic * s.max_pressure * problem.grid.cell_area() / bound;
  }
  for (std::size_t i = 1; i < force.size(); ++i) curve.rises = curve.rises && force[i] > force[i - 1] - 1e-5;
  for (std::size_t i = 1; i + 1 < force.size(); ++i)
    curve.largest_bend = std::max(curve.largest_bend, std::abs(force[i + 1] - 2.0 * force[i] + force[i - 1]));
  curve.last = force.back();
  return curve;
}

TEST(TractionCurve, HasNoJumpThroughSaturation) {
  for (const int n : {10, 20, 40}) {
    const Curve curve = traction_curve(n, 200);
    EXPECT_LT(curve.largest_bend, curve.one_element);
    EXPECT_TRUE(curve.rises);
    EXPECT_GT(curve.last, 0.999) << "the curve is to reach saturation";
    treadmark::testing::expect_documented("curve", n, {curve.largest_bend, curve.one_element});
  }
}

}  // namespace
}  // namespace treadmark::kalker
