// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "tangential_cases.hpp"
#include "treadmark/solvers/kalker/tangential/slip_friction.hpp"

namespace treadmark::kalker::testing {
namespace {

using Kind = FrictionLaw::Kind;

class VelocityDependentFriction : public ::testing::TestWithParam<FrictionLaw> {};

/// The coefficients of the solution follow from its own slip, element by element from the leading edge.
TEST_P(VelocityDependentFriction, FitsTheSlipOfTheSolution) {
  for (const double chi : {0.0, std::numbers::pi})
    for (const double xi : {5e-4, 3e-3, 3e-2}) {
      Case c = wheel_case(24);
      c.problem.friction = GetParam();
      c.problem.rolling.chi = chi;
      c.problem.creepage = {xi, 2e-4, 0.2, 0.0, 0.0};
      ASSERT_EQ(c.solve().tangential.status, Status::ok) << xi << c.solution.tangential.message;
      const ContactSolution& s = c.solution;
      const Grid2& g = c.problem.grid;
      const FrictionLaw& law = c.problem.friction;
      const double dt = g.dx / c.problem.rolling.velocity;
      for (int iy = 0; iy < g.ny; ++iy) {
        double before = law.static_friction();
        for (int k = 0; k < g.nx; ++k) {
          const std::size_t i = g.index(chi == 0.0 ? g.nx - 1 - k : k, iy);
          if (s.state[i] == ElementState::exterior) {
            before = law.static_friction();
            EXPECT_EQ(s.friction[i], law.static_friction());
            continue;
          }
          const bool slips = s.state[i] == ElementState::slip;
          const double w = slips ? c.problem.rolling.velocity * std::hypot(s.slip_x[i], s.slip_y[i]) : 0.0;
          const double kept = law.memory_distance / (law.memory_distance + dt * std::max(w, law.memory_velocity));
          const double mu = kept * before + (1.0 - kept) * law.at(w);
          EXPECT_NEAR(s.friction[i], mu, 2e-5);
          const double p = std::hypot(s.traction_x[i], s.traction_y[i]);
          EXPECT_LE(p, s.friction[i] * s.pressure[i] * (1.0 + 1e-9));
          if (slips) {
            EXPECT_NEAR(p, s.friction[i] * s.pressure[i], 1e-4 * largest(s.pressure));
          }
          before = mu;
        }
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, VelocityDependentFriction,
                         ::testing::Values(FrictionLaw{Kind::linear, 0.2, 0.1, 0.05, 0.5, 2.0, 1e-5, 0.01},
                                           FrictionLaw{Kind::rational, 0.2, 0.1, 0.05, 0.5, 2.0, 1e-5, 0.01},
                                           FrictionLaw{Kind::exponential, 0.2, 0.1, 0.05, 0.5, 2.0, 1e-5, 0.01},
                                           FrictionLaw{Kind::exponential, 0.2, 0.1, 0.0, 0.5, 0.0, 0.0, 0.01}),
                         [](const auto& given) { return "Law" + std::to_string(given.index); });

/// Steeply falling friction without memory in a line contact (Vollebregt and Schuttelaars 2012); printed digits of the
/// reference.
TEST(FallingFriction, TheLineContactOfTheReference) {
  Case c;
  c.problem.grid = {-4.6e-3, 0.0, 0.1e-3, 0.2, 92, 1};
  std::vector<double> gap;
  for (int i = 0; i < 92; ++i) gap.push_back(std::pow(c.problem.grid.x(i), 2) / 0.92);
  c.problem.gap = gap;
  c.problem.normal_force = 622216.0;
  c.problem.settings.eps = 1e-7;
  NormalSolver().solve(c.problem, c.solution);
  c.problem.gap = {};
  c.problem.regime = Regime::steady;
  c.problem.rolling.velocity = 45.0;
  c.problem.friction = {Kind::exponential, 0.18, 0.12, 0.0, 0.1, 0.0, 0.0, 1e-3};
  c.problem.creepage.xi = -0.0009999;
  ASSERT_EQ(c.solve().tangential.status, Status::ok) << c.solution.tangential.message;
  const Totals t = totals(c);
  EXPECT_NEAR(relative(c, t.x), 0.5941, 6e-5);
  EXPECT_NEAR(t.power, -4849.0, 1.0);
  EXPECT_EQ(t.adhesion, 45);
  EXPECT_EQ(t.slip, 36);
}

TEST(FallingFriction, NoAmplitudeIsCoulomb) {
  Case a = wheel_case(20), b = a;
  a.problem.creepage = b.problem.creepage = {1e-3, 0.0, 0.3, 0.0, 0.0};
  b.problem.friction.kind = Kind::rational;
  a.solve();
  ASSERT_EQ(b.solve().tangential.status, Status::ok);
  EXPECT_LE(distance(a.solution.traction_x, b.solution.traction_x), 1e-4 * largest(a.solution.traction_x));
}

TEST(FallingFriction, AlsoForAShift) {
  Case c = wheel_case(20);
  c.problem.regime = Regime::shift;
  c.problem.friction = {Kind::exponential, 0.2, 0.1, 0.0, 2e-6, 0.0, 0.0, 0.0};  // a shift takes a second
  c.problem.creepage = {1.2e-5, 0.0, 0.0, 0.0, 0.0};
  ASSERT_EQ(c.solve().tangential.status, Status::ok) << c.solution.tangential.message;
  double low = 1.0, high = 0.0;
  for (std::size_t i = 0; i < c.solution.state.size(); ++i)
    if (c.solution.state[i] == ElementState::slip) {
      const double mu = c.problem.friction.at(std::hypot(c.solution.slip_x[i], c.solution.slip_y[i]));
      EXPECT_NEAR(c.solution.friction[i], mu, 1e-4);
      low = std::min(low, mu);
      high = std::max(high, mu);
    }
  EXPECT_LT(low + 0.01, high);
}

}  // namespace
}  // namespace treadmark::kalker::testing
