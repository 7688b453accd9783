// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/history/contact_history.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::largest_difference;

/// A ball of 0.3 m on a plane; about n elements across the contact.
struct Ball {
  explicit Ball(int n, double eps = 1e-8) {
    problem.force_prescribed = true;
    problem.normal_force = 1e4;
    const double a = 2.703e-3;
    const double d = 2.0 * a / n;
    const int m = n + 4;
    problem.grid = {-0.5 * (m - 1) * d, -0.5 * (m - 1) * d, d, d, m, m};
    for (int iy = 0; iy < m; ++iy)
      for (int ix = 0; ix < m; ++ix)
        gap.push_back((problem.grid.x(ix) * problem.grid.x(ix) + problem.grid.y(iy) * problem.grid.y(iy)) / 0.6);
    problem.gap = gap;
    problem.settings.eps = eps;
    problem.friction.kinetic = 0.3;
    problem.rolling = {0.0, 20.0, d, 1.0 / 6.0};
  }
  Ball(const Ball&) = delete;
  ContactSolution solve(ContactSolver& solver) {
    problem.gap = gap;
    return solver.solve(problem);
  }

  std::vector<double> gap;
  ContactProblem problem;
};

TEST(History, OtherElementsTakeTheMeanOverTheirArea) {
  ContactHistory h;
  h.grid = {0.5e-3, -1e-3, 1e-3, 2e-3, 5, 4};
  for (std::size_t i = 0; i < h.grid.size(); ++i) h.pressure.push_back(1e8 * static_cast<double>((7 * i) % 11));
  h.friction.assign(h.grid.size(), 0.2);
  const auto force = [](const Grid2& g, const std::vector<double>& field) {
    double sum = 0.0;
    for (const double p : field) sum += p * g.dx * g.dy;
    return sum;
  };
  for (const Grid2& other : {Grid2{-1.3e-3, -5e-3, 0.37e-3, 0.9e-3, 25, 20}, Grid2{-2e-3, -6e-3, 2.7e-3, 5e-3, 6, 5},
                             Grid2{0.1e-3, -2e-3, 1e-3, 2e-3, 7, 7}}) {
    const ContactHistory moved = averaged_on(h, other, 0.3, 0.0);
    ASSERT_EQ(moved.pressure.size(), other.size());
    EXPECT_NEAR(force(other, moved.pressure), force(h.grid, h.pressure), 1e-9 * force(h.grid, h.pressure));
    EXPECT_NEAR(moved.friction[other.index(other.nx - 1, other.ny - 1)], 0.3, 1e-15) << "outside";
    EXPECT_TRUE(moved.traction_x.empty());
    for (const double mu : moved.friction) EXPECT_TRUE(mu >= 0.2 - 1e-15 && mu <= 0.3 + 1e-15) << mu;
  }
  const Grid2 inside{2.3e-3, 1.1e-3, 0.2e-3, 0.2e-3, 3, 3};  // within element (2, 1)
  for (const double p : averaged_on(h, inside, 0.3, 0.0).pressure)
    EXPECT_NEAR(p, h.pressure[h.grid.index(2, 1)], 1e-6 * p);
  const Grid2 whole{h.grid.x0 + 2 * h.grid.dx, h.grid.y0 - h.grid.dy, h.grid.dx, h.grid.dy, 4, 6};
  EXPECT_EQ(averaged_on(h, whole, 0.3, 0.0), on_grid(h, whole, 0.3, 0.0));
  EXPECT_EQ(averaged_on(h, whole, 0.3, 0.0).pressure[whole.index(0, 1)], h.pressure[h.grid.index(2, 0)]);
  // whose sums would not end
  EXPECT_THROW(averaged_on(h, {0.0, 0.0, 1e290, 2e-3, 3, 3}, 0.3, 0.0), Error);
  EXPECT_THROW(averaged_on(h, {1e300, 0.0, 1e-3, 2.1e-3, 3, 3}, 0.3, 0.0), Error);
}

TEST(History, AShiftInPartsIsTheWholeShiftWhileItGrows) {
  Ball ball(16);
  ball.problem.regime = Regime::shift;
  ball.problem.creepage = {4.8e-6, 1.8e-6, 0.0};
  ContactSolver once;
  const ContactSolution whole = ball.solve(once);
  ASSERT_GT(whole.elements_slip, 20);
  ASSERT_GT(whole.elements_adhesion, 20);
  ContactSolver twice;
  ball.problem.creepage = {1.2e-6, 0.45e-6, 0.0};
  ball.solve(twice);
  ball.problem.creepage = {3.6e-6, 1.35e-6, 0.0};
  ball.problem.history = HistoryUse::keep_going;
  const ContactSolution parts = ball.solve(twice);
  // slip turns a little on its way, which the single step does not see
  EXPECT_LT(largest_difference(parts.traction_x, whole.traction_x), 0.01 * 0.3 * whole.max_pressure);
  EXPECT_NEAR(parts.force_x, whole.force_x, 1e-3 * std::fabs(whole.force_x));
  // without history the second part stands alone
  ball.problem.history = HistoryUse::start;
  EXPECT_LT(std::fabs(ball.solve(twice).force_x), 0.9 * std::fabs(whole.force_x));
}

TEST(History, UnloadingLeavesTractionsOfBothSigns) {
  // Mindlin and Deresiewicz 1953: back to zero force the rim has slipped back, the middle has not
  Ball ball(24);
  ball.problem.regime = Regime::shift;
  ball.problem.fx_relative = -0.6;
  ContactSolver solver;
  ball.solve(solver);
  ball.problem.history = HistoryUse::keep_going;
  ball.problem.fx_relative = 0.0;
  const ContactSolution s = ball.solve(solver);
  ASSERT_EQ(s.status, Status::ok) << s.tangential.message;
  EXPECT_NEAR(s.force_x, 0.0, 1e-5 * s.force_n);
  const Grid2& g = ball.problem.grid;
  const double a = 2.703e-3;
  // tractions: f(c1) - 2 f(c2) with sticking radii c1 = a (1 - 0.6)^(1/3), c2 = a (1 - 0.6/2)^(1/3)
  const double p0 = 1.5 * ball.problem.normal_force / (std::numbers::pi * a * a);
  const double c1 = a * std::cbrt(0.4), c2 = a * std::cbrt(0.7);
  const auto cattaneo = [&](double r, double c) {
    const double outer = r < a ? std::sqrt(1.0 - r * r / (a * a)) : 0.0,
                 inner = r < c ? c / a * std::sqrt(1.0 - r * r / (c * c)) : 0.0;
    return 0.3 * p0 * (outer - inner);
  };
  double worst = 0.0;
  for (int ix = 0; ix < g.nx; ++ix)
    for (int iy = 0; iy < g.ny; ++iy) {
      const double r = std::hypot(g.x(ix), g.y(iy));
      if (r > 0.85 * a) continue;
      const double expected = -cattaneo(r, c1) + 2.0 * cattaneo(r, c2);
      worst = std::max(worst, std::fabs(s.traction_x[g.index(ix, iy)] - expected));
    }
  EXPECT_LT(worst, 0.05 * 0.3 * p0);
}

TEST(History, TransientRollingBecomesSteady) {
  for (const double chi : {0.0, std::numbers::pi}) {
    Ball ball(14);
    ball.problem.rolling.chi = chi;
    ball.problem.creepage = {-8e-4, 4e-4, 0.15};
    ball.problem.regime = Regime::steady;
    ContactSolver solver;
    const ContactSolution steady = ball.solve(solver);
    ASSERT_GT(steady.elements_slip, 10);
    ASSERT_GT(steady.elements_adhesion, 10);
    ContactSolver rolling;
    ball.problem.regime = Regime::transient;
    ContactSolution s;
    for (int k = 0; k < 250; ++k) {
      ball.problem.history = k == 0 ? HistoryUse::start : HistoryUse::keep_going;
      s = ball.solve(rolling);
      ASSERT_EQ(s.status, Status::ok) << s.tangential.message;
    }
    EXPECT_LT(largest_difference(s.traction_x, steady.traction_x), 1e-5 * steady.max_pressure);
    EXPECT_LT(largest_difference(s.traction_y, steady.traction_y), 1e-5 * steady.max_pressure);
    EXPECT_LT(largest_difference(s.slip_x, steady.slip_x), 1e-8);
    EXPECT_NEAR(s.frictional_power, steady.frictional_power, 1e-4 * std::fabs(steady.frictional_power));
  }
}

TEST(History, RollingAcrossIsRollingAlongTurned) {
  const auto roll = [](double chi, Creepage creepage) {
    Ball ball(12);
    ball.problem.rolling.chi = chi;
    ball.problem.regime = Regime::transient;
    ball.problem.creepage = creepage;
    ContactSolver solver;
    ContactSolution s;
    for (int k = 0; k < 8; ++k) {
      ball.problem.history = k == 0 ? HistoryUse::start : HistoryUse::keep_going;
      s = ball.solve(solver);
    }
    return s;
  };
  const ContactSolution x = roll(0.0, {-5e-4, 2e-4, 0.1}), y = roll(0.5 * std::numbers::pi, {-2e-4, -5e-4, 0.1});
  EXPECT_NEAR(y.force_y, x.force_x, 1e-6 * x.force_n);
  EXPECT_NEAR(y.force_x, -x.force_y, 1e-6 * x.force_n);
  EXPECT_NEAR(y.moment_n, x.moment_n, 1e-6 * std::fabs(x.moment_n) + 1e-9);
  // at 45 degrees a ball feels the grid, and little else
  const double c = std::sqrt(0.5);
  const ContactSolution d = roll(0.25 * std::numbers::pi, {-5e-4 * c - 2e-4 * c, -5e-4 * c + 2e-4 * c, 0.1});
  EXPECT_NEAR(d.force_x, c * (x.force_x - x.force_y), 0.02 * x.force_n * 0.3);
  EXPECT_NEAR(d.force_y, c * (x.force_x + x.force_y), 0.02 * x.force_n * 0.3);
}

TEST(History, LongerStepsArriveAtTheSameState) {
  const auto roll = [](double step, int count) {
    Ball ball(20);
    ball.problem.rolling.step *= step;
    ball.problem.regime = Regime::transient;
    ball.problem.creepage = {-8e-4, 0.0, 0.0};
    ContactSolver solver;
    ContactSolution s;
    for (int k = 0; k < count; ++k) {
      ball.problem.history = k == 0 ? HistoryUse::start : HistoryUse::keep_going;
      s = ball.solve(solver);
    }
    return s;
  };
  const ContactSolution one = roll(1.0, 60), half = roll(0.5, 120), two = roll(2.0, 30);
  EXPECT_NEAR(half.force_x, one.force_x, 0.01 * one.force_n * 0.3);
  EXPECT_NEAR(two.force_x, one.force_x, 0.02 * one.force_n * 0.3);
}

TEST(History, SavedAndRestoredGivesTheSameBits) {
  Ball ball(14, 1e-5);
  ball.problem.regime = Regime::transient;
  const auto step = [&](ContactSolver& solver, int k) {
    ball.problem.history = k == 0 ? HistoryUse::start : HistoryUse::keep_going;
    ball.problem.creepage = {-6e-4 + 3e-4 * std::sin(0.3 * k), 2e-4 * std::cos(0.2 * k), 0.1};
    ball.problem.normal_force = 1e4 * (1.0 + 0.2 * std::sin(0.17 * k));
    return ball.solve(solver);
  };
  ContactSolver straight, first, second;
  std::vector<ContactSolution> whole;
  for (int k = 0; k < 100; ++k) whole.push_back(step(straight, k));
  for (int k = 0; k < 47; ++k) step(first, k);
  const auto saved = first.save();
  for (int k = 60; k < 70; ++k) step(first, k);  // whatever happens in between
  second.restore(saved);
  first.restore(saved);
  for (int k = 47; k < 100; ++k)
    for (ContactSolver* solver : {&first, &second}) {
      const ContactSolution s = step(*solver, k);
      ASSERT_EQ(s.pressure, whole[static_cast<std::size_t>(k)].pressure) << k;
      ASSERT_EQ(s.traction_x, whole[static_cast<std::size_t>(k)].traction_x) << k;
      ASSERT_EQ(s.slip_y, whole[static_cast<std::size_t>(k)].slip_y) << k;
      ASSERT_EQ(s.force_x, whole[static_cast<std::size_t>(k)].force_x) << k;
    }
}

TEST(History, SolvingAnInstantAgainChangesNothing) {
  Ball ball(12);
  ball.problem.regime = Regime::transient;
  ball.problem.creepage = {-6e-4, 0.0, 0.0};
  ContactSolver solver;
  ball.solve(solver);
  ball.problem.history = HistoryUse::keep_going;
  const ContactSolution second = ball.solve(solver);
  ball.problem.history = HistoryUse::same_instant;
  const ContactSolution again = ball.solve(solver);
  EXPECT_LT(largest_difference(again.traction_x, second.traction_x), 1e-7 * second.max_pressure);
  ball.problem.history = HistoryUse::keep_going;
  const ContactSolution third = ball.solve(solver);
  EXPECT_GT(largest_difference(third.traction_x, second.traction_x), 1e-2 * second.max_pressure);
}

TEST(History, GoesOnFromAnInstantOfAnotherSolver) {
  Ball ball(12);
  ball.problem.regime = Regime::transient;
  ball.problem.creepage = {-6e-4, 2e-4, 0.1};
  ContactSolver one, other;
  ball.solve(one);
  other.continue_from(one.history());
  ball.problem.history = HistoryUse::keep_going;
  const ContactSolution a = ball.solve(one), b = ball.solve(other);
  EXPECT_LT(largest_difference(a.traction_x, b.traction_x), 1e-7 * a.max_pressure);
  EXPECT_LT(largest_difference(a.traction_y, b.traction_y), 1e-7 * a.max_pressure);
}

TEST(History, MovesWithAGridOfWholeElements) {
  Ball ball(12);
  ball.problem.regime = Regime::shift;
  ball.problem.creepage = {4e-6, 0.0, 0.0};
  ContactSolver still, moved;
  ball.solve(still);
  ball.solve(moved);
  ball.problem.history = HistoryUse::keep_going;
  const ContactSolution a = ball.solve(still);
  // the same place on a grid that begins two columns earlier
  Grid2& g = ball.problem.grid;
  const Grid2 old = g;
  g.x0 -= 2 * g.dx;
  g.nx += 3;
  ball.gap.clear();
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) ball.gap.push_back((g.x(ix) * g.x(ix) + g.y(iy) * g.y(iy)) / 0.6);
  const ContactSolution b = ball.solve(moved);
  for (int iy = 0; iy < old.ny; ++iy)
    for (int ix = 0; ix < old.nx; ++ix)
      EXPECT_NEAR(b.traction_x[g.index(ix + 2, iy)], a.traction_x[old.index(ix, iy)], 1e-6 * a.max_pressure);
  // Elements that do not line up take the mean over their area: the force stays about what it was.
  g.x0 += 0.4 * g.dx;
  g.dy *= 0.9;
  g.ny += 4;
  ball.gap.clear();
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) ball.gap.push_back((g.x(ix) * g.x(ix) + g.y(iy) * g.y(iy)) / 0.6);
  ball.problem.creepage = {};
  const ContactSolution c = ball.solve(moved);
  EXPECT_EQ(c.status, Status::ok);
  EXPECT_NEAR(c.force_x, b.force_x, 0.03 * std::fabs(b.force_x));
}

struct Cycle {
  double input = 0.0, friction = 0.0, energy_change = 0.0;  // [J]
};

/// The third of three cycles of shifts; along a line or along a figure of eight. Work is that of the mean of the
/// tractions before and after a step: the elastic part of it is then exactly the change of the elastic energy (Betti).
Cycle third_cycle(bool line) {
  Ball ball(16, 1e-10);
  ball.problem.regime = Regime::shift;
  ContactSolver solver;
  const int steps = 40;
  Cycle out;
  double energy = 0.0;
  std::vector<double> px(ball.gap.size()), py(ball.gap.size());
  for (int k = 0; k < 3 * steps; ++k) {
    const double t0 = 2.0 * std::numbers::pi * k / steps, t1 = 2.0 * std::numbers::pi * (k + 1) / steps;
    const double wx = 5e-6 * (std::sin(t1) - std::sin(t0)),
                 wy = 2e-6 * (std::sin((line ? 1 : 2) * t1) - std::sin((line ? 1 : 2) * t0));
    ball.problem.creepage = {wx, wy, 0.0};
    ball.problem.history = k == 0 ? HistoryUse::start : HistoryUse::keep_going;
    const ContactSolution s = ball.solve(solver);
    EXPECT_EQ(s.status, Status::ok);
    const double area = ball.problem.grid.cell_area();
    double power = 0.0;
    for (std::size_t i = 0; i < px.size(); ++i)
      power += (s.traction_x[i] * s.slip_x[i] + s.traction_y[i] * s.slip_y[i]) * area;
    EXPECT_NEAR(s.frictional_power, power, 1e-12 + 1e-9 * std::fabs(power));
    EXPECT_LE(s.frictional_power, 1e-12);  // rounding, where hardly anything slips
    for (std::size_t i = 0; i < px.size() && k >= 2 * steps; ++i) {
      const double mx = 0.5 * (px[i] + s.traction_x[i]), my = 0.5 * (py[i] + s.traction_y[i]);
      out.input -= (mx * wx + my * wy) * area;
      out.friction -= (mx * s.slip_x[i] + my * s.slip_y[i]) * area;
    }
    if (k >= 2 * steps) out.energy_change += s.elastic_energy - energy;
    energy = s.elastic_energy;
    px = s.traction_x;
    py = s.traction_y;
  }
  return out;
}

TEST(History, WorkGoesIntoFrictionAndElasticEnergy) {
  const Cycle line = third_cycle(true);
  EXPECT_GT(line.friction, 1e-3);
  EXPECT_NEAR(line.energy_change, 0.0, 1e-6 * line.friction);
  EXPECT_NEAR(line.input, line.friction, 1e-6 * line.friction);
  // a path that turns has not come to a closed loop yet
  const Cycle eight = third_cycle(false);
  EXPECT_NEAR(eight.input, eight.friction + eight.energy_change, 1e-6 * eight.friction);
}

/// Derivatives of forces against differences of forces, in small steps so that few elements change their state.
TEST(Sensitivities, AreThoseOfSmallDifferences) {
  for (const Regime regime : {Regime::steady, Regime::shift}) {
    Ball ball(24, 1e-10);
    ball.problem.force_prescribed = false;
    ball.problem.approach = 3.0e-5;
    ball.problem.regime = regime;
    const double length = regime == Regime::shift ? 4e-3 : 1.0;
    ball.problem.creepage = {-6e-4 * length, 4e-4 * length, 0.2 * length};
    ball.problem.sensitivities = true;
    ContactSolver solver;
    const ContactSolution at = ball.solve(solver);
    ASSERT_TRUE(at.sensitivities);
    ASSERT_GT(at.elements_slip, 50);
    ASSERT_GT(at.elements_adhesion, 50);
    const auto derivative = [&](double& parameter, double step) {
      const double before = parameter;
      parameter = before + step;
      const ContactSolution more = ball.solve(solver);
      parameter = before - step;
      const ContactSolution less = ball.solve(solver);
      parameter = before;
      return std::array<double, 3>{(more.force_n - less.force_n) / (2.0 * step),
                                   (more.force_x - less.force_x) / (2.0 * step),
                                   (more.force_y - less.force_y) / (2.0 * step)};
    };
    Creepage& c = ball.problem.creepage;
    const double scale = std::fabs(at.sensitivities->by_creepage[0][0]);
    const std::array<double*, 3> parameters{&c.xi, &c.eta, &c.phi};
    for (std::size_t k = 0; k < 3; ++k) {
      const double size = k == 2 ? 0.2 * length : 5e-4 * length;
      const auto d = derivative(*parameters[k], 1e-4 * size);
      const double unit = k == 2 ? 2.7e-3 : 1.0;  // a spin acts by its lever
      EXPECT_NEAR(at.sensitivities->by_creepage[k][0], d[1], 0.01 * scale * unit) << k;
      EXPECT_NEAR(at.sensitivities->by_creepage[k][1], d[2], 0.01 * scale * unit) << k;
    }
    const auto d = derivative(ball.problem.approach, 1e-10);
    EXPECT_NEAR(at.sensitivities->by_approach[0], d[0], 1e-3 * d[0]);
    EXPECT_NEAR(at.sensitivities->by_approach[1], d[1], 0.01 * d[0]);
    EXPECT_NEAR(at.sensitivities->by_approach[2], d[2], 0.01 * d[0]);
    // Hertz: F_n grows as the 3/2 power of the approach
    EXPECT_NEAR(at.sensitivities->by_approach[0], 1.5 * at.force_n / 3.0e-5, 0.02 * at.sensitivities->by_approach[0]);
  }
}

/// Friction that falls with temperature: full sliding, so that the heat is known and the coefficient follows from it.
TEST(TemperatureFriction, FitsTheTemperature) {
  Ball ball(20, 1e-7);
  ball.problem.regime = Regime::steady;
  ball.problem.creepage = {-0.05, 0.0, 0.0};
  ball.problem.thermal.emplace();
  ball.problem.friction.kind = FrictionLaw::Kind::temperature;
  ball.problem.friction.kinetic = 0.3;
  ball.problem.friction.reference_temperature = 0.0;
  ball.problem.friction.temperature_change = -0.2;
  ball.problem.friction.temperature_range = 1000.0;
  ball.problem.friction.memory_distance = 0.0;
  ContactSolver solver;
  const ContactSolution s = ball.solve(solver);
  ASSERT_EQ(s.status, Status::ok) << s.tangential.message;
  ASSERT_GT(s.max_temperature_1, 50.0);
  double fx = 0.0;
  for (std::size_t i = 0; i < s.pressure.size(); ++i) {
    if (!(s.pressure[i] > 0.0)) continue;
    const double mu = 0.3 - 0.2 * std::clamp(s.temperature_1[i] / 1000.0, 0.0, 1.0);
    EXPECT_NEAR(s.friction[i], mu, 1e-4);
    fx += mu * s.pressure[i] * ball.problem.grid.cell_area();
  }
  EXPECT_NEAR(s.force_x, fx, 1e-4 * fx);
  EXPECT_LT(s.force_x, 0.299 * s.force_n);
}

TEST(SimplifiedTheory, RefusesFrictionAndSlipThatItWouldIgnore) {
  Ball ball(10);
  ball.problem.regime = Regime::steady;
  ball.problem.tangential_model = TangentialModel::fastsim;
  ContactSolver solver;
  EXPECT_EQ(ball.solve(solver).status, Status::ok);
  ball.problem.friction_of_row.resize(static_cast<std::size_t>(ball.problem.grid.ny));
  EXPECT_THROW(ball.solve(solver), Error);
  ball.problem.friction_of_row.clear();
  const std::vector<double> slip(ball.gap.size(), 1e-4);
  ball.problem.extra_slip_x = ball.problem.extra_slip_y = slip;
  EXPECT_EQ(ball.solve(solver).status, Status::ok);
  ball.problem.tangential_model = TangentialModel::fastrip;
  EXPECT_THROW(ball.solve(solver), Error);
}

/// Sweeps over single elements are another way to the same solution.
TEST(Sweeps, ReachTheSameSolutionOfTransientRolling) {
  Ball ball(10, 1e-8);
  ball.problem.regime = Regime::transient;
  ball.problem.creepage = {-6e-4, 3e-4, 0.1};
  ContactSolver newton, sweeps;
  for (int k = 0; k < 4; ++k) {
    ball.problem.history = k == 0 ? HistoryUse::start : HistoryUse::keep_going;
    ball.problem.settings.method = SolverSettings::Method::automatic;
    const ContactSolution a = ball.solve(newton);
    ball.problem.settings.method = SolverSettings::Method::sweeps;
    const ContactSolution b = ball.solve(sweeps);
    ASSERT_EQ(b.status, Status::ok) << b.tangential.message;
    EXPECT_LT(largest_difference(a.traction_x, b.traction_x), 1e-6 * a.max_pressure);
    EXPECT_LT(largest_difference(a.traction_y, b.traction_y), 1e-6 * a.max_pressure);
  }
}

}  // namespace
}  // namespace treadmark::kalker
