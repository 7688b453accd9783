// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/fastsim/fastsim.hpp"
#include "treadmark/solvers/kalker/fastsim/flexibilities.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::kSteel;

TEST(KalkerCoefficients, ReproduceTheTableAtItsNodes) {
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(kalker_coefficients(1.0, 1.0, 0.25).c11, 4.12, kRounding);
  EXPECT_NEAR(kalker_coefficients(1.0, 1.0, 0.5).c22, 3.98, kRounding);
  EXPECT_NEAR(kalker_coefficients(0.5, 1.0, 0.0).c23, 0.827, kRounding);
  EXPECT_NEAR(kalker_coefficients(2.0, 1.0, 0.25).c22, 4.90, kRounding);
  EXPECT_NEAR(kalker_coefficients(0.7, 1.0, 0.25).c11, 3.81, kRounding);
}

TEST(KalkerCoefficients, AreContinuousBetweenNodesAndShapes) {
  // Linear in the ratio between nodes; the same from both sides at a = b.
  const double low = kalker_coefficients(0.6, 1.0, 0.25).c11, high = kalker_coefficients(0.7, 1.0, 0.25).c11;
  EXPECT_NEAR(kalker_coefficients(0.65, 1.0, 0.25).c11, 0.5 * (low + high), 1e-12);
  for (const double nu : {0.1, 0.28, 0.4}) {
    const auto below = kalker_coefficients(1.0 - 1e-9, 1.0, nu), above = kalker_coefficients(1.0 + 1e-9, 1.0, nu);
    EXPECT_NEAR(below.c11, above.c11, 1e-6);
    EXPECT_NEAR(below.c22, above.c22, 1e-6);
    EXPECT_NEAR(below.c23, above.c23, 1e-6);
  }
  // Where the asymptotic formulas take over: they are good to some per cent there.
  for (const double nu : {0.0, 0.25, 0.5}) {
    const auto inside = kalker_coefficients(0.1011, 1.0, nu), outside = kalker_coefficients(0.1009, 1.0, nu);
    EXPECT_NEAR(inside.c11 / outside.c11, 1.0, 0.05);
    EXPECT_NEAR(inside.c22 / outside.c22, 1.0, 0.05);
    const auto inside_long = kalker_coefficients(1.0, 0.1011, nu), outside_long = kalker_coefficients(1.0, 0.1009, nu);
    EXPECT_NEAR(inside_long.c11 / outside_long.c11, 1.0, 0.08);
    EXPECT_NEAR(inside_long.c22 / outside_long.c22, 1.0, 0.08);
  }
}

TEST(KalkerCoefficients, DoNotDependOnTheUnitOfLength) {
  const auto one = kalker_coefficients(3e-3, 5e-3, 0.28), other = kalker_coefficients(3.0, 5.0, 0.28);
  EXPECT_NEAR(one.c11, other.c11, 1e-12);
  EXPECT_NEAR(one.c23, other.c23, 1e-12);
}

TEST(KalkerCoefficients, RefuseWhatIsNotInTheTable) {
  EXPECT_THROW(kalker_coefficients(0.0, 1.0, 0.3), Error);
  EXPECT_THROW(kalker_coefficients(1.0, 1.0, 0.6), Error);
}

struct FastsimCase {
  ContactProblem problem;
  ContactSolution solution;
};

/// Rolling contact of 6 x 4 mm with an elliptic or parabolic pressure.
FastsimCase rolling(int n, bool parabolic = true) {
  FastsimCase c;
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 80e3}, kSteel);
  c.problem.grid = hertz_grid(shape, n, n, 1.1);
  c.problem.hertz = shape;
  c.problem.regime = Regime::steady;
  c.problem.tangential_model = TangentialModel::fastsim;
  for (int iy = 0; iy < n; ++iy)
    for (int ix = 0; ix < n; ++ix) {
      const double x = c.problem.grid.x(ix), y = c.problem.grid.y(iy);
      c.solution.pressure.push_back(parabolic ? parabolic_pressure(shape, x, y) : hertz_pressure(shape, x, y));
    }
  return c;
}

Vec2 force(const FastsimCase& c) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < c.solution.pressure.size(); ++i)
    sum += Vec2(c.solution.traction_x[i], c.solution.traction_y[i]);
  return sum * c.problem.grid.cell_area();
}

Vec2 force_at(FastsimCase& c, const Creepage& creepage) {
  c.problem.creepage = creepage;
  solve_fastsim(c.problem, c.solution);
  return force(c);
}

TEST(Fastsim, FollowsLinearTheoryForSmallCreepage) {
  FastsimCase c = rolling(200);
  const KalkerCoefficients k = kalker_coefficients(6e-3, 4e-3, kSteel.poisson);
  const double g = kSteel.shear_modulus, ab = 6e-3 * 4e-3;
  // The blending weight grows linearly with creepage; friction cuts the trailing edge; strips have finite length.
  constexpr double kLinear = 0.01;
  EXPECT_NEAR(force_at(c, {1e-7, 0, 0}).x() / (-g * ab * k.c11 * 1e-7), 1.0, kLinear);
  EXPECT_NEAR(force_at(c, {0, 1e-7, 0}).y() / (-g * ab * k.c22 * 1e-7), 1.0, kLinear);
  // One quarter is the nominal share of spin: with L3 the lateral force by spin is that of linear theory.
  const double phi = 1e-5;
  EXPECT_NEAR(force_at(c, {0, 0, phi}).y() / (-g * std::pow(ab, 1.5) * k.c23 * phi), 1.0, kLinear);
}

TEST(Fastsim, OneFlexibilityIntegratesTheRigidSlip) {
  // Without slip the springs' traction grows from the leading edge: p_x = -xi (a_j - x)/L, p_y = -phi (a_j^2 - x^2)/(2
  // L).
  FastsimCase c = rolling(200);
  c.problem.tangential_model = TangentialModel::fastsim_one_flexibility;
  const double l = c.problem.fastsim.flexibility = 2.5e-14, a = 6e-3, b = 4e-3;
  constexpr double kLinear = 0.01;
  EXPECT_NEAR(force_at(c, {1e-7, 0, 0}).x() / (-8.0 / 3.0 * a * a * b * 1e-7 / l), 1.0, kLinear);
  EXPECT_NEAR(force_at(c, {0, 1e-7, 0}).y() / (-8.0 / 3.0 * a * a * b * 1e-7 / l), 1.0, kLinear);
  EXPECT_NEAR(force_at(c, {0, 0, 1e-5}).y() / (-std::acos(-1.0) / 4.0 * a * a * a * b * 1e-5 / l), 1.0, kLinear);
}

TEST(Fastsim, OneFlexibilityEqualsThreeUnderLongitudinalCreepage) {
  FastsimCase three = rolling(44), one = rolling(44);
  const KalkerCoefficients k = kalker_coefficients(6e-3, 4e-3, kSteel.poisson);
  one.problem.tangential_model = TangentialModel::fastsim_one_flexibility;
  one.problem.fastsim.flexibility = 8.0 * 6e-3 / (3.0 * k.c11 * kSteel.shear_modulus);
  for (const double xi : {1e-5, 5e-4, 3e-3}) {
    const Vec2 f = force_at(three, {xi, 0, 0}), g = force_at(one, {xi, 0, 0});
    EXPECT_NEAR(f.x(), g.x(), 1e-9 * f.norm());
  }
}

TEST(Fastsim, RefusesAFlexibilityThatIsNotPositive) {
  FastsimCase c = rolling(10);
  c.problem.tangential_model = TangentialModel::fastsim_one_flexibility;
  for (const double flexibility : {0.0, -1e-14, std::nan("")}) {
    c.problem.fastsim.flexibility = flexibility;
    EXPECT_THROW(solve_fastsim(c.problem, c.solution), Error);
  }
}

TEST(Fastsim, SaturatesAtTheFrictionBoundAgainstTheSlip) {
  FastsimCase c = rolling(44);
  const double bound = 0.3 * [&] {
    double sum = 0.0;
    for (const double p : c.solution.pressure) sum += p;
    return sum * c.problem.grid.cell_area();
  }();
  const Vec2 f = force_at(c, {0.03, -0.04, 0});
  EXPECT_NEAR(f.x(), -0.6 * bound, 1e-3 * bound);
  EXPECT_NEAR(f.y(), 0.8 * bound, 1e-3 * bound);
}

TEST(Fastsim, RespectsFrictionEverywhere) {
  for (const bool parabolic : {true, false}) {
    FastsimCase c = rolling(44, parabolic);
    force_at(c, {1e-3, -5e-4, 0.4});
    double dissipated = 0.0;
    int slipping = 0, sticking = 0;
    for (std::size_t i = 0; i < c.solution.pressure.size(); ++i) {
      const Vec2 p(c.solution.traction_x[i], c.solution.traction_y[i]), s(c.solution.slip_x[i], c.solution.slip_y[i]);
      const double bound = 0.3 * c.solution.pressure[i];
      ASSERT_LE(p.norm(), bound * (1.0 + 1e-12));
      if (c.solution.state[i] == ElementState::slip) {
        ++slipping;
        ASSERT_NEAR(p.norm(), bound, 1e-9 * bound + 1e-9);
        dissipated += p.dot(s);
      } else {
        sticking += c.solution.state[i] == ElementState::adhesion ? 1 : 0;
        ASSERT_EQ(s.norm(), 0.0);
      }
    }
    EXPECT_LT(dissipated, 0.0) << "friction takes energy out";
    EXPECT_GT(slipping, 100);
    EXPECT_GT(sticking, 100);
  }
}

TEST(Fastsim, MirrorsWithTheLateralDirection) {
  FastsimCase c = rolling(44), mirrored = rolling(44);
  const Vec2 f = force_at(c, {5e-4, 4e-4, 0.3}), g = force_at(mirrored, {5e-4, -4e-4, -0.3});
  EXPECT_NEAR(f.x(), g.x(), 1e-9 * f.norm());
  EXPECT_NEAR(f.y(), -g.y(), 1e-9 * f.norm());
}

TEST(Fastsim, RollingBackwardsMirrorsAlongTheTrack) {
  FastsimCase c = rolling(44), backwards = rolling(44);
  const Vec2 f = force_at(c, {5e-4, 4e-4, 0.3});
  backwards.problem.rolling.chi = std::acos(-1.0);
  const Vec2 g = force_at(backwards, {-5e-4, 4e-4, -0.3});
  EXPECT_NEAR(f.x(), -g.x(), 1e-9 * f.norm());
  EXPECT_NEAR(f.y(), g.y(), 1e-9 * f.norm());
}

TEST(Fastsim, FindsCreepageForPrescribedForces) {
  FastsimCase c = rolling(44);
  c.problem.fx_relative = -0.4;
  c.problem.fy_relative = 0.3;
  solve_fastsim(c.problem, c.solution);
  ASSERT_EQ(c.solution.tangential.status, Status::ok) << c.solution.tangential.message;
  double normal = 0.0;
  for (const double p : c.solution.pressure) normal += p;
  const double bound = 0.3 * normal * c.problem.grid.cell_area();
  EXPECT_NEAR(force(c).x() / bound, -0.4, 2.0 * c.problem.settings.eps);
  EXPECT_NEAR(force(c).y() / bound, 0.3, 2.0 * c.problem.settings.eps);
  EXPECT_GT(c.solution.creepage.xi, 0.0);
  EXPECT_LT(c.solution.creepage.eta, 0.0);

  c.problem.fx_relative = -1.2;
  c.problem.fy_relative.reset();
  solve_fastsim(c.problem, c.solution);
  EXPECT_EQ(c.solution.status, Status::not_converged);
}

TEST(Fastsim, FallingFrictionLowersTheForce) {
  FastsimCase c = rolling(44);
  c.problem.friction = {FrictionLaw::Kind::exponential, 0.1, 0.2, 0.0, 1.0, 0.0};
  c.problem.rolling.velocity = 10.0;
  const double slow = force_at(c, {0.01, 0, 0}).norm(), fast = force_at(c, {0.2, 0, 0}).norm();
  EXPECT_LT(fast, 0.8 * slow);
  EXPECT_DOUBLE_EQ(c.solution.friction[0], c.problem.friction.at(2.0));
}

TEST(Fastsim, SlopeReductionWeakensSmallCreepageOnly) {
  FastsimCase c = rolling(44);
  const double plain_small = force_at(c, {1e-4, 0, 0}).norm(), plain_large = force_at(c, {0.5, 0, 0}).norm();
  c.problem.fastsim = {0.5, 0.2, 0.6};
  EXPECT_LT(force_at(c, {1e-4, 0, 0}).norm(), 0.6 * plain_small);
  EXPECT_NEAR(force_at(c, {0.5, 0, 0}).norm(), plain_large, 1e-6 * plain_large);
}

TEST(Fastsim, EquivalentEllipseOfAnEllipseIsThatEllipse) {
  const FastsimCase c = rolling(300);
  const EquivalentEllipse ellipse = equivalent_ellipse(c.problem.grid, c.solution.pressure);
  EXPECT_NEAR(ellipse.a, 6e-3, 0.01 * 6e-3);
  EXPECT_NEAR(ellipse.b, 4e-3, 0.01 * 4e-3);
}

/// Solves a step of transient rolling and returns what the next one goes on from.
ContactHistory step_on(FastsimCase& c, const ContactHistory& before) {
  solve_fastsim(c.problem, c.solution, before);
  return history_of(c.problem, c.solution);
}

TEST(Fastsim, FromRestTractionsGrowWithTheDistanceRolled) {
  // Springs that never slide: each is stretched by the creepage over the way that it has been in contact.
  FastsimCase c = rolling(20);
  c.problem.regime = Regime::transient;
  c.problem.tangential_model = TangentialModel::fastsim_one_flexibility;
  const double l = c.problem.fastsim.flexibility = 2.5e-14, xi = 1e-9, dx = c.problem.grid.dx;
  c.problem.creepage.xi = xi;
  c.problem.friction.kinetic = 1e6;
  c.problem.rolling.step = dx;
  const Grid2& g = c.problem.grid;
  ContactHistory before;
  for (int steps = 1; steps <= 30; ++steps) {
    before = step_on(c, before);
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = g.nx - 1, in_contact = 0; ix >= 0; --ix) {
        const std::size_t i = g.index(ix, iy);
        in_contact = c.solution.pressure[i] > 0.0 ? in_contact + 1 : 0;
        // the leading edge lies half an element before the middle of the first element
        const double expected = in_contact > 0 ? -xi * dx * std::min(in_contact - 0.5, 1.0 * steps) / l : 0.0;
        ASSERT_NEAR(c.solution.traction_x[i], expected, 1e-12 * std::abs(xi * dx / l) * steps);
      }
  }
  EXPECT_EQ(c.solution.rolling_step, dx);
}

TEST(Fastsim, TransientRollingEndsInSteadyRolling) {
  for (const double chi : {0.0, std::acos(-1.0)}) {
    FastsimCase steady = rolling(30);
    steady.problem.creepage = {8e-4, -4e-4, 0.3, 0.0, 0.0};
    steady.problem.rolling.chi = chi;
    solve_fastsim(steady.problem, steady.solution);
    FastsimCase c = rolling(30);
    c.problem = steady.problem;
    c.problem.regime = Regime::transient;
    c.problem.rolling.step = c.problem.grid.dx;
    ContactHistory before;
    for (int k = 0; k < 30; ++k) before = step_on(c, before);
    const double scale = steady.solution.pressure[15 * 30 + 15];
    int slipping = 0;
    for (std::size_t i = 0; i < steady.solution.state.size(); ++i) {
      ASSERT_NEAR(c.solution.traction_x[i], steady.solution.traction_x[i], 1e-9 * scale);
      ASSERT_NEAR(c.solution.traction_y[i], steady.solution.traction_y[i], 1e-9 * scale);
      ASSERT_EQ(c.solution.state[i], steady.solution.state[i]);
      slipping += c.solution.state[i] == ElementState::slip;
    }
    EXPECT_GT(slipping, 0);
    // and steady rolling, or its tractions alone, go on as they are
    ContactHistory known = history_of(steady.problem, steady.solution);
    step_on(c, known);
    EXPECT_NEAR(force(c).x(), force(steady).x(), 1e-9 * force(steady).norm());
    known.layer_x.clear(), known.layer_y.clear();
    step_on(c, known);
    EXPECT_NEAR(force(c).x(), force(steady).x(), 1e-9 * force(steady).norm());
  }
}

TEST(Fastsim, StepsOfHalfAnElementCarryLayersOn) {
  // Of a chain of springs that never slide the sum follows the way rolled, whatever the steps.
  FastsimCase whole = rolling(40), half = rolling(40);
  for (FastsimCase* c : {&whole, &half}) {
    c->problem.regime = Regime::transient;
    c->problem.creepage = {1e-9, 0.0, 0.0, 0.0, 0.0};
    c->problem.friction.kinetic = 1e6;
    c->problem.rolling.step = c->problem.grid.dx;
  }
  half.problem.rolling.step *= 0.5;
  ContactHistory before, before_half;
  for (int k = 0; k < 8; ++k) {
    before = step_on(whole, before);
    before_half = step_on(half, step_on(half, before_half));
  }
  EXPECT_NEAR(force(half).x(), force(whole).x(), 0.02 * std::abs(force(whole).x()));
}

TEST(Fastsim, RollsInAnyDirectionInTransientSteps) {
  FastsimCase along = rolling(24), across = rolling(24);
  for (FastsimCase* c : {&along, &across}) {
    c->problem.regime = Regime::transient;
    c->problem.tangential_model = TangentialModel::fastsim_one_flexibility;
    c->problem.fastsim.flexibility = 2.5e-14;
    Grid2& g = c->problem.grid;
    g = {-6e-3, -6e-3, 0.5e-3, 0.5e-3, 24, 24};
    c->problem.rolling.step = 0.5e-3;
    for (int iy = 0; iy < 24; ++iy)
      for (int ix = 0; ix < 24; ++ix)
        c->solution.pressure[g.index(ix, iy)] = std::max(0.0, 5e8 * (1.0 - std::hypot(g.x(ix), g.y(iy)) / 5e-3));
  }
  along.problem.creepage.xi = 2e-4;
  across.problem.creepage.eta = 2e-4;
  across.problem.rolling.chi = 0.5 * std::acos(-1.0);
  ContactHistory before_along, before_across;
  for (int k = 0; k < 6; ++k) {
    before_along = step_on(along, before_along);
    before_across = step_on(across, before_across);
  }
  EXPECT_LT(force(along).x(), 0.0);
  EXPECT_NEAR(force(across).y(), force(along).x(), 1e-9 * force(along).norm());
}

TEST(Fastsim, RefusesWhatItCannotDo) {
  FastsimCase c = rolling(10);
  c.problem.regime = Regime::shift;
  EXPECT_THROW(solve_fastsim(c.problem, c.solution), Error);
  c.problem.regime = Regime::steady;
  c.problem.rolling.chi = 0.3;
  EXPECT_THROW(solve_fastsim(c.problem, c.solution), Error);
  c.problem.rolling.chi = 0.0;
  c.problem.regime = Regime::transient;
  c.problem.rolling.step = 0.0;
  EXPECT_THROW(solve_fastsim(c.problem, c.solution), Error);
  c.problem.rolling.step = 1e-3;
  c.problem.tangential_model = TangentialModel::fastrip;
  EXPECT_THROW(solve_fastsim(c.problem, c.solution), Error);
  c.problem.tangential_model = TangentialModel::fastsim;
  c.solution.pressure.pop_back();
  EXPECT_THROW(solve_fastsim(c.problem, c.solution), Error);
}

}  // namespace
}  // namespace treadmark::kalker
