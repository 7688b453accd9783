// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/prescribed_force.hpp"

#include "tangential_cases.hpp"

namespace treadmark::kalker::testing {
namespace {

using Pair = std::array<double, 2>;

/// A creep force law with saturation: force against creepage, size tanh.
ForceSample saturating(Pair x, double scale) {
  const double size = std::hypot(x[0], x[1]) / scale;
  ForceSample f;
  const double ratio = size > 1e-8 ? std::tanh(size) / size : 1.0;
  for (std::size_t k = 0; k < 2; ++k) f.force[k] = -ratio * x[k] / scale;
  const double d = size > 1e-8 ? (1.0 / std::pow(std::cosh(std::min(size, 300.0)), 2) - ratio) / (size * size) : 0.0;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      f.derivative[i][j] = -((i == j ? ratio : 0.0) + d * x[i] * x[j] / (scale * scale)) / scale;
  f.sliding = size > 5.0;
  return f;
}

TEST(ForceSearch, OneUnknownFromRestAndFromFarBeyondSaturation) {
  for (const double start : {0.0, 1e-3, -1e-3, 0.5, -0.5})
    for (const double target : {-0.9999, -0.5, 0.0, 0.3, 0.999}) {
      ForceSearchSettings s;
      s.target = {target, 0.0};
      s.start = {start, 0.0};
      s.tolerance = 1e-9;
      s.max_iterations = 60;
      const ForceSearchResult r = find_creepage(s, [](Pair x) { return saturating({x[0], 0.0}, 1e-3); });
      EXPECT_TRUE(r.converged) << start << " " << target;
      EXPECT_NEAR(r.creepage[0], -1e-3 * std::atanh(target), 1e-9 / (1.0 - target * target) * 2e-3);
    }
}

TEST(ForceSearch, TwoUnknowns) {
  for (const Pair start : {Pair{0.0, 0.0}, Pair{1e-3, -1e-3}, Pair{0.3, 0.2}})
    for (const Pair target : {Pair{0.0, 0.0}, Pair{0.5, -0.3}, Pair{-0.7, -0.7}, Pair{0.01, 0.98}}) {
      ForceSearchSettings s;
      s.count = 2;
      s.target = target;
      s.start = start;
      s.tolerance = 1e-9;
      s.max_iterations = 60;
      const ForceSearchResult r = find_creepage(s, [](Pair x) { return saturating(x, 1e-3); });
      EXPECT_TRUE(r.converged) << start[0] << " " << target[0] << " " << target[1];
      EXPECT_LE(r.residual, 1e-9);
    }
}

TEST(ForceSearch, SaysSoWhenTheForceCannotBeReached) {
  for (const int count : {1, 2}) {
    ForceSearchSettings s;
    s.count = count;
    s.target = {1.5, 0.0};
    const ForceSearchResult r = find_creepage(s, [](Pair x) { return saturating(x, 1e-3); });
    EXPECT_FALSE(r.converged);
    EXPECT_LE(r.iterations, s.max_iterations);
    EXPECT_GT(r.residual, 0.4);
  }
}

TEST(ForceSearch, QuasiNewtonWithWrongDerivatives) {
  for (const int count : {1, 2}) {
    ForceSearchSettings s;
    s.count = count;
    s.target = {-0.6, count == 2 ? 0.2 : 0.0};
    s.exact_derivatives = false;
    s.tolerance = 1e-8;
    const ForceSearchResult r = find_creepage(s, [](Pair x) {
      ForceSample f = saturating(x, 1e-3);
      for (auto& row : f.derivative)
        for (double& d : row) d *= 1.4;
      return f;
    });
    EXPECT_TRUE(r.converged);
    EXPECT_LE(r.residual, 1e-8);
  }
}

class PrescribedForce : public ::testing::TestWithParam<Regime> {};

/// Solving for the forces of a known creepage gives the creepage back.
TEST_P(PrescribedForce, RoundTrip) {
  Case c = wheel_case(24);
  c.problem.regime = GetParam();
  const double length = GetParam() == Regime::shift ? 5e-3 : 1.0;
  const double phi = GetParam() == Regime::shift ? 5e-4 : 0.2;
  TangentialSolver solver;  // warm from case to case
  for (const Creepage& k : {Creepage{-4e-4, 2e-4, phi, 0.0, 0.0}, Creepage{1.5e-3, 5e-4, phi, 0.0, 0.0},
                            Creepage{-1e-4, -9e-4, -phi, 0.0, 0.0}}) {
    c.problem.settings.eps = 1e-8;
    c.problem.fx_relative.reset();
    c.problem.fy_relative.reset();
    c.problem.creepage = {k.xi * length, k.eta * length, k.phi, 0.0, 0.0};
    const Creepage given = c.problem.creepage;
    ASSERT_EQ(c.solve().tangential.status, Status::ok);
    const double fx = relative(c, totals(c).x), fy = relative(c, totals(c).y);

    c.problem.creepage = {0.0, 0.0, given.phi, 0.0, 0.0};
    c.problem.fx_relative = fx;
    c.problem.fy_relative = fy;
    c.problem.settings.eps = 1e-6;
    ASSERT_EQ(c.solve(solver).tangential.status, Status::ok) << c.solution.tangential.message;
    const double size = std::hypot(given.xi, given.eta);
    EXPECT_NEAR(c.solution.creepage.xi, given.xi, 2e-5 * size);
    EXPECT_NEAR(c.solution.creepage.eta, given.eta, 2e-5 * size);
    EXPECT_NEAR(relative(c, totals(c).x), fx, 1.1e-6);

    // One force, the other creepage given.
    c.problem.fx_relative.reset();
    c.problem.creepage = {given.xi, 0.0, given.phi, 0.0, 0.0};
    ASSERT_EQ(c.solve(solver).tangential.status, Status::ok) << c.solution.tangential.message;
    EXPECT_NEAR(c.solution.creepage.eta, given.eta, 2e-5 * size);
    EXPECT_EQ(c.solution.creepage.xi, given.xi);
  }
}

INSTANTIATE_TEST_SUITE_P(Regimes, PrescribedForce, ::testing::Values(Regime::steady, Regime::shift),
                         [](const auto& given) { return given.param == Regime::steady ? "Steady" : "Shift"; });

TEST(PrescribedForceLimit, UpToTheLimitAndBeyond) {
  Case c = wheel_case(20);
  for (const double target : {0.0, 0.9, 0.99, 0.999, 0.9999}) {
    c.problem.fx_relative = target;
    c.problem.fy_relative = 0.0;
    ASSERT_EQ(c.solve().tangential.status, Status::ok) << target << c.solution.tangential.message;
    EXPECT_NEAR(relative(c, totals(c).x), target, 1.1e-5);
  }
  for (const double target : {1.0, -1.7}) {
    c.problem.fx_relative = target;
    ASSERT_EQ(c.solve().tangential.status, Status::not_converged);
    EXPECT_NE(c.solution.tangential.message.find("limit of friction"), std::string::npos);
    EXPECT_NEAR(relative(c, totals(c).x), std::copysign(1.0, target), 1e-12);
    EXPECT_EQ(totals(c).adhesion, 0);
  }
}

TEST(PrescribedForceLimit, FallingFriction) {
  Case c = wheel_case(20);
  c.problem.friction = {FrictionLaw::Kind::exponential, 0.2, 0.15, 0.0, 0.3, 0.0, 1e-6, 0.01};
  c.problem.fx_relative = -0.5;
  c.problem.creepage.eta = 5e-4;
  ASSERT_EQ(c.solve().tangential.status, Status::ok) << c.solution.tangential.message;
  EXPECT_NEAR(relative(c, totals(c).x), -0.5, 1.1e-5);
  // More than kinetic and memory can give at any creepage.
  c.problem.fx_relative = -0.995;
  ASSERT_EQ(c.solve().tangential.status, Status::not_converged);
  EXPECT_FALSE(c.solution.tangential.message.empty());
}

}  // namespace
}  // namespace treadmark::kalker::testing
