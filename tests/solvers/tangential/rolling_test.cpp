// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <array>

#include "tangential_cases.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker::testing {
namespace {

constexpr double kFriction = 0.3;

/// Rolling cylinder on a plane: half width 1 mm, radius 500 mm, strip of a given length (Carter 1926).
Case cylinder(int columns, double dx, double length, double x0) {
  const double a = 1e-3, radius = 0.5, g = 82e9, nu = 0.28;
  const double p0 = g * a / (2.0 * radius * (1.0 - nu));
  Case c;
  c.problem.grid = {x0, 0.0, dx, length, columns, 1};
  c.problem.regime = Regime::steady;
  c.problem.friction.kinetic = kFriction;
  c.problem.rolling.velocity = 30.0;
  for (int i = 0; i < columns; ++i) {
    const double x = c.problem.grid.x(i);
    c.solution.pressure.push_back(std::abs(x) < a ? p0 * std::sqrt(1.0 - x * x / (a * a)) : 0.0);
  }
  return c;
}

TEST(Carter, TheLineContactOfTheReference) {
  // Solved pressures, 50 of 55 elements of 0.04 mm; printed digits of the reference.
  ContactProblem problem;
  problem.grid = {-1.05e-3, 0.0, 0.04e-3, 0.2, 55, 1};
  std::vector<double> gap;
  for (int i = 0; i < 55; ++i) gap.push_back(std::pow(problem.grid.x(i), 2));
  problem.gap = gap;
  problem.normal_force = 35780.0;
  problem.settings.eps = 1e-7;
  Case c;
  c.problem = problem;
  NormalSolver().solve(c.problem, c.solution);
  c.problem.gap = {};
  c.problem.regime = Regime::steady;
  c.problem.friction.kinetic = kFriction;
  c.problem.creepage.xi = -2.4e-4;
  c.problem.rolling.velocity = 30.0;
  ASSERT_EQ(c.solve().tangential.status, Status::ok);
  const Totals t = totals(c);
  EXPECT_EQ(t.contact, 50);
  EXPECT_NEAR(t.x, 6955.0, 1.0);
  EXPECT_NEAR(t.adhesion, 30, 1);
  EXPECT_NEAR(t.power, -47.62, 0.02);
  EXPECT_DOUBLE_EQ(c.solution.rolling_step, 0.04e-3);
}

TEST(Carter, ConvergesToTheExactTractions) {
  // Creepage xi = -(mu a/R)(1 - sqrt(1 - F/(mu N))); adhesion over d = a sqrt(1 - F/(mu N)) on either side of its
  // centre, at the leading edge.
  const double a = 1e-3, force = 0.64, d = a * std::sqrt(1.0 - force);
  std::array<double, 3> error{}, force_error{}, length_error{};
  const std::array<int, 3> sizes{50, 100, 200};
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const int n = sizes[k];
    const double dx = 2.0 * a / n;
    Case c = cylinder(n, dx, 1.0, -a + 0.5 * dx);
    c.problem.creepage.xi = -kFriction * a / 0.5 * (1.0 - std::sqrt(1.0 - force));
    ASSERT_EQ(c.solve().tangential.status, Status::ok);
    const double p0 = 82e9 * a / (2.0 * 0.5 * 0.72);
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      const double x = c.problem.grid.x(i), shifted = x - (a - d);
      const double outer = std::sqrt(1.0 - x * x / (a * a));
      const double inner = std::abs(shifted) < d ? d / a * std::sqrt(1.0 - shifted * shifted / (d * d)) : 0.0;
      sum += std::pow(c.solution.traction_x[static_cast<std::size_t>(i)] / (kFriction * p0) - (outer - inner), 2) / n;
    }
    error[k] = std::sqrt(sum);
    force_error[k] = std::abs(relative(c, totals(c).x) - force);
    length_error[k] = std::abs(totals(c).adhesion * dx - 2.0 * d) / dx;
  }
  for (std::size_t k = 0; k < sizes.size(); ++k)
    treadmark::testing::expect_documented("Carter", sizes[k], {error[k], force_error[k]});
  EXPECT_LT(error[2], 5e-3);
  EXPECT_LT(force_error[2], 4e-3);
  EXPECT_GT(std::log2(error[0] / error[2]) / 2.0, 0.8);  // first order
  EXPECT_GT(std::log2(force_error[0] / force_error[2]) / 2.0, 0.8);
  for (const double elements : length_error) EXPECT_LE(elements, 1.5);
}

/// Kalker's linear theory: F_x = -C11 G c^2 xi, F_y = -C22 G c^2 eta - C23 G c^3 phi, c = sqrt(a b).
struct LinearCase {
  double ratio;          ///< a/b
  double c11, c22, c23;  ///< for nu = 0.25 (Kalker 1990, table E3)
};

class LinearTheory : public ::testing::TestWithParam<LinearCase> {};

/// The table has three digits, and the elements of 1/40 of the semi-axis an error of first order.
constexpr double kTableTolerance = 0.02;

TEST_P(LinearTheory, SlopesOfTheCreepForces) {
  const LinearCase& expected = GetParam();
  Material material;
  material.poisson_1 = material.poisson_2 = 0.25;
  const double a = 6e-3 * std::sqrt(expected.ratio), b = 6e-3 / std::sqrt(expected.ratio), c = std::sqrt(a * b);
  const HertzShape shape = hertz_from_semi_axes(a, b, {true, 1e5}, combine(material));
  const double g = 82e9;
  std::array<double, 3> fine{}, coarse{};
  for (const int n : {40, 80}) {
    Case k = hertz_case(shape, hertz_grid(shape, n, n, 1.0));
    k.problem.material = material;
    k.problem.friction.kinetic = 1e3;  // nearly everything is in adhesion
    std::array<double, 3>& slope = n == 40 ? coarse : fine;
    TangentialSolver solver;
    k.problem.creepage = {1e-5, 0.0, 0.0, 0.0, 0.0};
    ASSERT_EQ(k.solve(solver).tangential.status, Status::ok);
    slope[0] = -totals(k).x / (g * c * c * 1e-5);
    k.problem.creepage = {0.0, 1e-5, 0.0, 0.0, 0.0};
    ASSERT_EQ(k.solve(solver).tangential.status, Status::ok);
    slope[1] = -totals(k).y / (g * c * c * 1e-5);
    const double moment = totals(k).moment;
    k.problem.creepage = {0.0, 0.0, 1e-3, 0.0, 0.0};
    ASSERT_EQ(k.solve(solver).tangential.status, Status::ok);
    slope[2] = -totals(k).y / (g * c * c * c * 1e-3);
    // C32 = -C23: the moment due to lateral creepage is the force due to spin, with the opposite sign.
    EXPECT_NEAR(moment / (g * c * c * c * 1e-5), slope[2], 0.06 * slope[2]);
  }
  // Extrapolated from both sizes.
  EXPECT_NEAR(2.0 * fine[0] - coarse[0], expected.c11, kTableTolerance * expected.c11) << coarse[0] << " " << fine[0];
  EXPECT_NEAR(2.0 * fine[1] - coarse[1], expected.c22, kTableTolerance * expected.c22) << coarse[1] << " " << fine[1];
  EXPECT_NEAR(2.0 * fine[2] - coarse[2], expected.c23, kTableTolerance * expected.c23) << coarse[2] << " " << fine[2];
}

INSTANTIATE_TEST_SUITE_P(Ellipses, LinearTheory,
                         ::testing::Values(LinearCase{0.5, 3.62, 3.01, 0.929}, LinearCase{1.0, 4.12, 3.67, 1.47},
                                           LinearCase{2.0, 5.10, 4.90, 2.62}),
                         [](const auto& given) {
                           return "AspectRatioTimesTen" + std::to_string(static_cast<int>(10 * given.param.ratio));
                         });

TEST(Spin, LateralCreepageAndSpinOnTheGridOfTheReference) {
  // Semi-axes 8 and 4 mm, 82 kN, 44 x 44 elements; printed digits of the reference.
  const HertzShape shape = hertz_from_semi_axes(8e-3, 4e-3, {true, 82000.0}, combine(Material{}));
  Case c;
  c.problem.grid = hertz_grid(shape, 44, 44, 1.1);
  const std::vector<double> gap = hertz_gap(shape, c.problem.grid);
  c.problem.gap = gap;
  c.problem.normal_force = 82000.0;
  c.problem.settings.eps = 1e-6;
  NormalSolver().solve(c.problem, c.solution);
  c.problem.gap = {};
  c.problem.regime = Regime::steady;
  c.problem.creepage = {0.0, -6.25e-4, 0.625, 0.0, 0.0};
  c.problem.rolling.velocity = 30.0;
  ASSERT_EQ(c.solve().tangential.status, Status::ok);
  const Totals t = totals(c);
  EXPECT_NEAR(relative(c, t.y), -0.6074, 1e-4);
  EXPECT_NEAR(t.moment, -48.210, 0.02);
  EXPECT_NEAR(t.power, -540.4, 0.3);
  EXPECT_EQ(t.contact, 1276);
  EXPECT_NEAR(t.adhesion, 356, 2);
}

TEST(Saturation, TheTractionCurveIsMonotoneAndEndsAtTheLimit) {
  Case c = wheel_case(24);
  TangentialSolver solver;
  double last = 0.0;
  for (double xi = 1e-4; xi < 0.3; xi *= 1.5) {
    c.problem.creepage.xi = xi;
    ASSERT_EQ(c.solve(solver).tangential.status, Status::ok) << xi;
    const double force = -relative(c, totals(c).x);
    EXPECT_GE(force, last - 1e-6) << xi;
    EXPECT_LE(force, 1.0 + 1e-12) << xi;
    last = force;
  }
  EXPECT_NEAR(last, 1.0, 1e-5);
  EXPECT_EQ(totals(c).adhesion, 0);
}

}  // namespace
}  // namespace treadmark::kalker::testing
