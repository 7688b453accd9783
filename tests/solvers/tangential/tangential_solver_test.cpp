// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <functional>
#include <limits>

#include "tangential_cases.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::kalker::testing {
namespace {

std::string refusal(const std::function<void(Case&)>& change) {
  Case c = wheel_case(12);
  change(c);
  try {
    c.solve();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    return error.message();
  }
  return "";
}

TEST(TangentialSolver, RefusesWhatItCannotDo) {
  EXPECT_NE(refusal([](Case& c) { c.problem.friction_of_row.resize(3); }).find("friction laws"), std::string::npos);
  EXPECT_NE(refusal([](Case& c) {
              c.problem.regime = Regime::transient;
              c.problem.rolling.step = 0.0;
            }).find("rolling step"),
            std::string::npos);
  EXPECT_NE(refusal([](Case& c) { c.problem.rolling.chi = 1.0; }).find("direction"), std::string::npos);
  EXPECT_NE(refusal([](Case& c) { c.problem.rolling.velocity = 0.0; }).find("velocity"), std::string::npos);
  EXPECT_NE(refusal([](Case& c) { c.solution.pressure.pop_back(); }).find("pressure"), std::string::npos);
  EXPECT_NE(refusal([](Case& c) { c.solution.state.pop_back(); }).find("states"), std::string::npos);
  EXPECT_NE(refusal([](Case& c) { c.problem.grid.dx = 0.0; }).find("grid"), std::string::npos);
  EXPECT_NE(refusal([](Case& c) { c.problem.friction.kinetic = -0.1; }).find("friction"), std::string::npos);
  EXPECT_NE(refusal([](Case& c) { c.problem.creepage.eta = std::nan(""); }).find("finite"), std::string::npos);
  EXPECT_NE(refusal([](Case& c) {
              for (double& p : c.solution.pressure)
                if (p > 0.0) p = std::numeric_limits<double>::infinity();
            }).find("pressure"),
            std::string::npos);
  EXPECT_EQ(refusal([](Case&) {}), "");
}

TEST(TangentialSolver, NothingToDo) {
  Case c = wheel_case(12);
  ASSERT_EQ(c.solve().tangential.status, Status::ok);  // no creepage
  EXPECT_EQ(largest(c.solution.traction_x), 0.0);
  EXPECT_EQ(totals(c).slip, 0);

  Case none = wheel_case(12);
  none.solution.pressure.assign(none.solution.pressure.size(), 0.0);
  none.solution.state.assign(none.solution.pressure.size(), ElementState::exterior);
  none.problem.creepage.xi = 1e-3;
  EXPECT_EQ(none.solve().tangential.status, Status::no_contact);
  EXPECT_EQ(none.solution.traction_x.size(), none.problem.grid.size());

  Case frictionless = wheel_case(12);
  frictionless.problem.regime = Regime::frictionless;
  frictionless.problem.material.shear_modulus_2 = 26e9;  // no reason to refuse
  EXPECT_EQ(frictionless.solve().tangential.status, Status::ok);
  EXPECT_TRUE(frictionless.solution.traction_x.empty());
}

TEST(TangentialSolver, OneElement) {
  Case c;
  c.problem.grid = {0.0, 0.0, 1e-3, 1e-3, 3, 3};
  c.problem.regime = Regime::steady;
  c.solution.pressure.assign(9, 0.0);
  c.solution.pressure[4] = 1e9;
  c.problem.creepage.xi = -1e-2;
  ASSERT_EQ(c.solve().tangential.status, Status::ok);
  EXPECT_NEAR(c.solution.traction_x[4], 0.3e9, 1.0);
  EXPECT_EQ(c.solution.state[4], ElementState::slip);
}

TEST(TangentialSolver, IsAsAccurateAsAskedFor) {
  Case exact = wheel_case(40);
  exact.problem.creepage = {-4e-4, 1e-4, 0.28, 0.0, 0.0};
  exact.problem.settings.eps = 1e-11;
  ASSERT_EQ(exact.solve().tangential.status, Status::ok);
  for (const double eps : {1e-3, 1e-5, 1e-7}) {
    Case c = wheel_case(40);
    c.problem.creepage = exact.problem.creepage;
    c.problem.settings.eps = eps;
    ASSERT_EQ(c.solve().tangential.status, Status::ok);
    double sum = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < c.problem.grid.size(); ++i) {
      sum += std::pow(c.solution.traction_x[i] - exact.solution.traction_x[i], 2);
      scale += std::pow(exact.solution.traction_x[i], 2) + std::pow(exact.solution.traction_y[i], 2);
    }
    EXPECT_LE(std::sqrt(sum / scale), 2.0 * eps);
  }
}

TEST(TangentialSolver, WarmStartsGiveTheSameInFewerSteps) {
  TangentialSolver solver;
  Case c = wheel_case(40);
  c.problem.settings.eps = 1e-9;
  c.problem.creepage = {-4e-4, 1e-4, 0.28, 0.0, 0.0};
  c.solve(solver);
  const int cold_steps = c.solution.tangential.iterations;

  // The same problem, on a grid with another cut-out of the same raster.
  Case moved = c;
  Grid2& g = moved.problem.grid;
  g.x0 -= 3.0 * g.dx;
  g.y0 -= 2.0 * g.dy;
  g.nx += 5;
  g.ny += 3;
  moved.solution = {};
  moved.solution.pressure.assign(g.size(), 0.0);
  for (int iy = 0; iy < c.problem.grid.ny; ++iy)
    for (int ix = 0; ix < c.problem.grid.nx; ++ix)
      moved.solution.pressure[g.index(ix + 3, iy + 2)] = c.solution.pressure[c.problem.grid.index(ix, iy)];
  moved.problem.creepage.xi *= 1.01;
  Case cold = moved;
  moved.solve(solver);
  cold.solve();
  ASSERT_EQ(moved.solution.tangential.status, Status::ok);
  EXPECT_LT(moved.solution.tangential.iterations, cold_steps);
  EXPECT_LE(distance(moved.solution.traction_x, cold.solution.traction_x), 1e-7 * largest(cold.solution.traction_x));

  // The same problem again: nothing left to do; after a reset: all over again.
  Case again = cold;
  again.solve(solver);
  EXPECT_LE(again.solution.tangential.iterations, 1);
  solver.reset();
  again.solve(solver);
  EXPECT_EQ(again.solution.tangential.iterations, cold.solution.tangential.iterations);
}

TEST(TangentialSolver, IsRepeatable) {
  Case a = wheel_case(30), b = a;
  a.problem.creepage = b.problem.creepage = {-4e-4, 1e-4, 0.28, 0.0, 0.0};
  a.solve();
  b.solve();
  EXPECT_EQ(a.solution.traction_x, b.solution.traction_x);
  EXPECT_EQ(a.solution.slip_y, b.solution.slip_y);
}

TEST(TangentialSolver, UnrelatedProblemsInTurn) {
  // Other grids, directions, regimes: what was solved before must not matter.
  TangentialSolver solver;
  for (int k = 0; k < 6; ++k) {
    Case c = wheel_case(k % 2 == 0 ? 16 : 23);
    c.problem.settings.eps = 1e-8;
    c.problem.rolling.chi = k % 3 == 0 ? 0.0 : std::numbers::pi;
    c.problem.regime = k == 4 ? Regime::shift : Regime::steady;
    c.problem.creepage = {k == 4 ? 3e-6 : 1e-3 * (k - 2.5), 0.0, 0.0, 0.0, 0.0};
    Case alone = c;
    alone.solve();
    ASSERT_EQ(c.solve(solver).tangential.status, Status::ok);
    EXPECT_LE(distance(c.solution.traction_x, alone.solution.traction_x), 1e-6 * largest(alone.solution.traction_x));
  }
}

TEST(TangentialSolver, SaysSoWhenItMissesTheAccuracy) {
  Case c = wheel_case(24);
  c.problem.creepage = {-4e-4, 1e-4, 0.28, 0.0, 0.0};
  c.problem.settings.max_iterations = 1;
  EXPECT_EQ(c.solve().tangential.status, Status::not_converged);
  EXPECT_NE(c.solution.tangential.message.find("friction conditions"), std::string::npos);
  EXPECT_GT(c.solution.tangential.residual, 1e-5);

  c.problem.settings.max_iterations = 999;
  c.problem.settings.max_outer = 1;
  c.problem.friction = {FrictionLaw::Kind::exponential, 0.2, 0.1, 0.0, 0.5, 0.0, 0.0, 0.01};
  EXPECT_EQ(c.solve().tangential.status, Status::not_converged);
  EXPECT_NE(c.solution.tangential.message.find("slip velocity"), std::string::npos);

  c.problem.settings.max_outer = 100;
  c.problem.settings.max_force = 1;
  c.problem.fx_relative = 0.4;
  EXPECT_EQ(c.solve().tangential.status, Status::not_converged);
  EXPECT_NE(c.solution.tangential.message.find("prescribed tangential force"), std::string::npos);
}

TEST(TangentialSolver, RoughPressuresAndHugeCreepages) {
  // Elements with next to no bound beside loaded ones; from full adhesion to full sliding.
  Case c = wheel_case(24);
  for (std::size_t i = 0; i < c.solution.pressure.size(); ++i)
    if (i % 7 == 0) c.solution.pressure[i] *= 1e-6;
  TangentialSolver solver;
  for (const double xi : {1e-9, 1e-3, 10.0, -1e-3, 1e3})
    for (const double phi : {0.0, 1.0, -1e3}) {
      c.problem.creepage = {xi, 0.0, phi, 0.0, 0.0};
      ASSERT_EQ(c.solve(solver).tangential.status, Status::ok) << xi << " " << phi << c.solution.tangential.message;
      EXPECT_LT(c.solution.tangential.residual, 1e-3);
    }
}

}  // namespace
}  // namespace treadmark::kalker::testing
