// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/invariants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/model/magnitudes.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"
#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/support/meant_overflow.hpp"

namespace treadmark::kalker {
namespace {

using ::testing::HasSubstr;
using testing::OwnedProblem;

/// Steady rolling of a patch of 6 mm by 4 mm under 80 kN.
OwnedProblem rolling_patch(int elements = 12) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 80e3}, combine(Material{}));
  OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, elements, elements, 1.2));
  owned.problem.regime = Regime::steady;
  owned.problem.creepage = {1e-3, -5e-4, 0.1};
  return owned;
}

TEST(Invariants, HoldForSmallContactsOfAllKinds) {
  Random random(7);
  const auto within = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  for (int trial = 0; trial < 60; ++trial) {
    const HertzShape shape =
        hertz_from_semi_axes(within(1e-3, 8e-3), within(1e-3, 8e-3), {true, within(1e3, 1e5)}, combine(Material{}));
    OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, 9, 8, 1.3));
    ContactProblem& p = owned.problem;
    for (double& h : owned.gap) h += within(0.0, 1e-6);
    p.regime = trial % 3 == 0 ? Regime::shift : trial % 3 == 1 ? Regime::transient : Regime::steady;
    p.rolling.step = p.grid.dx;
    const double size = std::pow(10.0, within(-6.0, 3.0)) * (p.regime == Regime::shift ? 1e-3 : 1.0);
    p.creepage = {within(-size, size), within(-size, size), within(-100.0 * size, 100.0 * size)};
    p.friction.kinetic = std::pow(10.0, within(-4.0, 1.0));
    if (trial % 4 == 0) p.material.poisson_1 = 0.1;
    if (trial % 5 == 0 && p.regime != Regime::shift) p.tangential_model = TangentialModel::fastsim;
    ContactSolver solver;
    for (int step = 0; step < 2; ++step) {
      const ContactSolution s = solver.solve(p);
      EXPECT_NE(s.status, Status::failed) << trial << ": " << s.tangential.message << s.normal.message;
      const auto violation = broken_invariant(p, s);
      EXPECT_FALSE(violation) << trial << ": " << violation->text;
      p.history = HistoryUse::keep_going;
    }
  }
}

struct Forgery {
  Invariant invariant;
  std::function<void(ContactSolution&)> forge;
};

std::size_t first_of(const ContactSolution& s, ElementState state) {
  return static_cast<std::size_t>(ranges::find(s.state, state) - s.state.begin());
}

TEST(Invariants, EveryBrokenOneIsNamed) {
  OwnedProblem owned = rolling_patch();
  ContactProblem& p = owned.problem;
  p.creepage.xi = 0.0;
  p.fx_relative = -0.4;
  const ContactSolution good = ContactSolver().solve(p);
  ASSERT_EQ(good.status, Status::ok) << good.tangential.message;
  ASSERT_FALSE(broken_invariant(p, good));
  ASSERT_GT(good.elements_slip, 0);
  ASSERT_GT(good.elements_adhesion, 0);

  const auto scale = [](ContactSolution& s, double factor) {
    for (std::size_t i = 0; i < s.state.size(); ++i)
      if (s.state[i] == ElementState::slip) s.traction_x[i] *= factor, s.traction_y[i] *= factor;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const std::vector<Forgery> forgeries{
      {Invariant::finite, [&](ContactSolution& s) { s.slip_y[first_of(s, ElementState::slip)] = nan; }},
      {Invariant::finite, [&](ContactSolution& s) { s.pressure[first_of(s, ElementState::slip)] = infinity; }},
      {Invariant::finite, [&](ContactSolution& s) { s.force_x = nan; }},
      {Invariant::pressure, [](ContactSolution& s) { s.pressure[first_of(s, ElementState::adhesion)] *= -1.0; }},
      {Invariant::pressure, [](ContactSolution& s) { s.pressure[first_of(s, ElementState::exterior)] = 1.0; }},
      {Invariant::penetration, [](ContactSolution& s) { s.approach *= 1.01; }},
      {Invariant::penetration,
       [&](ContactSolution& s) {
         const std::size_t i = first_of(s, ElementState::adhesion);
         s.pressure[i] = 0.0, s.state[i] = ElementState::exterior, s.displacement_n[i] *= 0.99;
       }},
      {Invariant::normal_force,
       [](ContactSolution& s) {
         for (double& pressure : s.pressure) pressure *= 1.02;
       }},
      {Invariant::traction_bound, [&](ContactSolution& s) { scale(s, 1.01); }},
      {Invariant::traction_bound, [](ContactSolution& s) { s.traction_x[first_of(s, ElementState::exterior)] = 1e6; }},
      {Invariant::traction_bound, [](ContactSolution& s) { s.force_x = -0.31 * s.force_n; }},
      {Invariant::sliding, [&](ContactSolution& s) { scale(s, 0.0); }},
      {Invariant::sliding, [&](ContactSolution& s) { scale(s, 0.99); }},
      {Invariant::tangential_force, [](ContactSolution& s) { s.force_x *= 0.99; }},
      {Invariant::dissipation,
       [](ContactSolution& s) {
         for (auto* slip : {&s.slip_x, &s.slip_y})
           for (double& value : *slip) value = -value;
       }},
  };
  for (std::size_t i = 0; i < forgeries.size(); ++i) {
    ContactSolution bad = good;
    forgeries[i].forge(bad);
    const auto violation = broken_invariant(p, bad);
    ASSERT_TRUE(violation) << i;
    EXPECT_EQ(violation->invariant, forgeries[i].invariant) << i << ": " << violation->text;
    EXPECT_GT(violation->amount, 0.0) << i;
    require_invariants(p, bad);
    EXPECT_EQ(bad.status, Status::failed);
    EXPECT_EQ(bad.tangential.status, Status::failed);
    EXPECT_THAT(bad.tangential.message, HasSubstr(std::string(to_string(forgeries[i].invariant)))) << i;
  }
  // of what is not ok already only numbers count
  ContactSolution unsettled = good;
  unsettled.status = unsettled.tangential.status = Status::not_converged;
  unsettled.force_x *= 0.5;
  EXPECT_FALSE(broken_invariant(p, unsettled));
  unsettled.force_x = nan;
  EXPECT_TRUE(broken_invariant(p, unsettled));
}

ContactSolution normal_solution(const ContactProblem& problem) {
  ContactSolution solution;
  NormalSolver().solve(problem, solution);
  return solution;
}

TEST(Invariants, SlipBeyondAllNumbersEndsWithoutSolution) {
  const treadmark::testing::MeantOverflow meant;
  OwnedProblem owned = rolling_patch(5);
  for (const double creepage : {1e290, 1e298, 1e300, 1e308}) {
    owned.problem.creepage = {creepage, 0.0, 0.0};
    for (const auto method : {SolverSettings::Method::automatic, SolverSettings::Method::sweeps}) {
      owned.problem.settings.method = method;
      ContactSolution s = normal_solution(owned.problem);
      TangentialSolver().solve(owned.problem, s);
      // Either what slides is known, or the solver says that it knows nothing.
      double force = 0.0;
      for (const double t : s.traction_x) force += t * owned.problem.grid.cell_area();
      if (s.tangential.status == Status::ok) {
        EXPECT_NEAR(force, -0.3 * 80e3, 1.0) << creepage;
      }
    }
  }
}

TEST(Invariants, HugeCreepageSlidesWithAllFriction) {
  const treadmark::testing::MeantOverflow meant;
  OwnedProblem owned = rolling_patch(8);
  for (const double creepage : {1.0, 1e6, kMostCreepage, 1e100, 1e150}) {
    owned.problem.creepage = {creepage, 0.0, 0.0};
    ContactSolution s = normal_solution(owned.problem);
    TangentialSolver().solve(owned.problem, s);
    double force = 0.0;
    for (const double t : s.traction_x) force += t * owned.problem.grid.cell_area();
    ASSERT_EQ(s.tangential.status, Status::ok) << creepage << ": " << s.tangential.message;
    EXPECT_NEAR(force, -0.3 * 80e3, 1.0) << creepage;
  }
}

TEST(Invariants, FrictionThatIsNeverReachedDoesNotMatter) {
  OwnedProblem owned = rolling_patch(8);
  owned.problem.creepage = {1e-3, 0.0, 0.0};
  const auto force = [&](double friction) {
    owned.problem.friction.kinetic = friction;
    ContactSolution s = normal_solution(owned.problem);
    TangentialSolver().solve(owned.problem, s);
    EXPECT_EQ(s.tangential.status, Status::ok) << friction << ": " << s.tangential.message;
    double sum = 0.0;
    for (const double t : s.traction_x) sum += t * owned.problem.grid.cell_area();
    return sum;
  };
  const double expected = force(1e5);
  EXPECT_LT(expected, 0.0);
  constexpr double kAccuracy = 1e-3;  // of both, some eps
  for (const double friction : {kMostFriction, 1e9, 1e12, 1e13, 1e15})
    EXPECT_NEAR(force(friction), expected, kAccuracy * -expected) << friction;
}

TEST(Invariants, MagnitudesBeyondThoseTakenAreRefused) {
  const auto refusal = [](const std::function<void(ContactProblem&)>& change) {
    OwnedProblem owned = rolling_patch(5);
    change(owned.problem);
    try {
      ContactSolver().solve(owned.problem);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::configuration);
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal([](ContactProblem& p) { p.creepage.xi = 2e12; }), HasSubstr("a creepage is 2e+12"));
  EXPECT_THAT(refusal([](ContactProblem& p) { p.creepage.phi = -2e12; }), HasSubstr("1e+12"));
  EXPECT_THAT(refusal([](ContactProblem& p) { p.friction.kinetic = 2e6; }), HasSubstr("1e+06"));
  EXPECT_THAT(refusal([](ContactProblem& p) { p.rolling.velocity = 2e9; }), HasSubstr("velocity"));
  EXPECT_THAT(refusal([](ContactProblem& p) { p.rolling.step = 2e9; }), HasSubstr("step"));
  EXPECT_THAT(refusal([](ContactProblem&) {}), ::testing::IsEmpty());
}

}  // namespace
}  // namespace treadmark::kalker
