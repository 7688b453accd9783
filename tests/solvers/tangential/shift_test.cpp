// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "tangential_cases.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker::testing {
namespace {

/// A ball of polyethylene, radius 50 mm, pressed against a plane until the contact has a radius of 1 mm (Kalker 1990).
struct Ball {
  Material material{200e6, 200e6, 0.42, 0.42, 0.0};
  HertzShape shape = hertz_from_semi_axes(1e-3, 1e-3, {true, 9.1954}, combine(material));
  double friction = 0.4;
};

Case ball_case(const Ball& ball, const Grid2& grid) {
  Case c;
  c.problem.grid = grid;
  c.problem.material = ball.material;
  c.problem.normal_force = ball.shape.force;
  c.problem.settings.eps = 1e-6;
  const std::vector<double> gap = hertz_gap(ball.shape, grid);
  c.problem.gap = gap;
  NormalSolver().solve(c.problem, c.solution);
  c.problem.gap = {};
  c.problem.friction.kinetic = ball.friction;
  c.problem.regime = Regime::shift;
  return c;
}

TEST(Shift, CattaneoOnTheGridOfTheReference) {
  const Ball ball;
  Case c = ball_case(ball, hertz_grid(ball.shape, 19, 19, 1.26667));
  c.problem.fx_relative = -0.875;
  c.problem.fy_relative = 0.0;
  ASSERT_EQ(c.solve().tangential.status, Status::ok) << c.solution.tangential.message;
  const Totals t = totals(c);
  // Printed digits of the reference (eps 1e-4).
  EXPECT_NEAR(c.solution.creepage.xi, 8.155e-6, 2e-9);
  EXPECT_NEAR(t.x, -3.218, 1e-3);
  EXPECT_EQ(t.contact, 177);
  EXPECT_NEAR(t.slip, 132, 4);
  EXPECT_NEAR(t.power, -2.750e-6, 3e-9);
  EXPECT_NEAR(t.energy, 8.525e-5 - 7.350e-5, 2e-8);
}

/// Cattaneo 1938, Mindlin 1949: two Hertzian distributions; exact for nu = 0, where the directions do not couple.
TEST(Shift, ConvergesToCattaneoMindlin) {
  Ball ball;
  ball.material.poisson_1 = ball.material.poisson_2 = 0.0;
  ball.shape = hertz_from_semi_axes(1e-3, 1e-3, {true, 9.1954}, combine(ball.material));
  const double q = 0.875, a = 1e-3, stick = a * std::cbrt(1.0 - q);
  const double p0 = hertz_max_pressure(ball.shape);
  std::array<double, 3> error{}, shift_error{};
  const std::array<int, 3> sizes{20, 40, 80};
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    Case c = hertz_case(ball.shape, hertz_grid(ball.shape, sizes[k], sizes[k], 1.0));
    c.problem.material = ball.material;
    c.problem.regime = Regime::shift;
    c.problem.friction.kinetic = 0.4;
    c.problem.fx_relative = -q;
    c.problem.fy_relative = 0.0;
    ASSERT_EQ(c.solve().tangential.status, Status::ok) << c.solution.tangential.message;
    const Grid2& g = c.problem.grid;
    double sum = 0.0, scale = 0.0;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const double r = std::hypot(g.x(ix), g.y(iy));
        const double outer = r < a ? std::sqrt(1.0 - r * r / (a * a)) : 0.0;
        const double inner = r < stick ? stick / a * std::sqrt(1.0 - r * r / (stick * stick)) : 0.0;
        const double exact = -0.4 * p0 * (outer - inner);
        sum += std::pow(c.solution.traction_x[g.index(ix, iy)] - exact, 2);
        scale += exact * exact;
      }
    error[k] = std::sqrt(sum / scale);
    // Mindlin's shift of the ball's centre: 3 mu F (2 - nu)/(16 G a) (1 - (1 - q)^(2/3)) per body.
    const double shift = 2.0 * 3.0 * 0.4 * 9.1954 * 2.0 / (16.0 * 200e6 * a) * (1.0 - std::pow(1.0 - q, 2.0 / 3.0));
    EXPECT_NEAR(c.solution.creepage.xi, shift, 0.3 / sizes[k] * shift);
    shift_error[k] = std::abs(c.solution.creepage.xi / shift - 1.0);
    treadmark::testing::expect_documented("Cattaneo", sizes[k], {error[k], shift_error[k]});
  }
  EXPECT_LT(error[2], 0.02);
  // First order: the borders of the contact and of the adhesion area run through elements.
  EXPECT_GT(std::log2(error[0] / error[2]) / 2.0, 0.7);
}

}  // namespace
}  // namespace treadmark::kalker::testing
