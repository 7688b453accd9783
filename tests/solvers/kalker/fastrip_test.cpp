// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/fastsim/fastsim.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"
#include "treadmark/solvers/kalker/fastsim/strip_theory.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using std::numbers::pi;
using testing::hertzian;
using testing::kSteel;
using testing::OwnedProblem;

OwnedProblem rolling(const HertzShape& shape, int nx, int ny, const Creepage& creepage) {
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, nx, ny, 1.0));
  owned.problem.hertz = shape;
  owned.problem.normal_model = NormalModel::elliptic;
  owned.problem.tangential_model = TangentialModel::fastrip;
  owned.problem.regime = Regime::steady;
  owned.problem.creepage = creepage;
  return owned;
}

TEST(Fastrip, EveryStripOfAWideContactIsCarters) {
  // Where strips do not feel each other, pure longitudinal creepage is Carter's problem (1926) in each of them.
  const double a = 1e-3, b = 20e-3, mu = 0.3;
  const HertzShape shape = hertz_from_semi_axes(a, b, {true, 40e3}, kSteel);
  const double p0 = hertz_max_pressure(shape), radius = a * kSteel.shear_modulus / (2.0 * p0 * (1.0 - kSteel.poisson));
  const double xi = 0.3 * mu * a / radius;
  const OwnedProblem owned = rolling(shape, 400, 40, {xi, 0.0, 0.0});
  ContactSolver solver;
  const ContactSolution solution = solver.solve(owned.problem);
  const Grid2& grid = owned.problem.grid;
  int strips_in_full_slip = 0;
  for (int iy = 0; iy < grid.ny; ++iy) {
    SCOPED_TRACE("y/b = " + std::to_string(grid.y(iy) / b));
    const double half = a * std::sqrt(1.0 - std::pow(grid.y(iy) / b, 2));
    // Carter: the slip area's length is twice xi R/mu; the force what is left beside the adhesion area's parabola.
    const double shift = std::min(half, xi * radius / mu);
    double force = 0.0, adhesion = 0.0;
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      force += solution.traction_x[i] * grid.dx;
      adhesion += solution.state[i] == ElementState::adhesion ? grid.dx : 0.0;
      EXPECT_EQ(solution.traction_y[i], 0.0);
    }
    const double bound = mu * 0.5 * pi * p0 * half * half / a;
    EXPECT_NEAR(adhesion, 2.0 * (half - shift), 2.0 * grid.dx);
    EXPECT_NEAR(force / -bound, 1.0 - std::pow(1.0 - shift / half, 2), 0.02);
    strips_in_full_slip += shift == half ? 1 : 0;
  }
  EXPECT_GT(strips_in_full_slip, 0);
  EXPECT_LT(strips_in_full_slip, grid.ny / 4);
}

TEST(Fastrip, FollowsLinearTheoryForSmallCreepage) {
  for (const double ratio : {0.5, 1.0, 2.0}) {
    SCOPED_TRACE("a/b = " + std::to_string(ratio));
    const double c = 5e-3, a = c * std::sqrt(ratio), b = c / std::sqrt(ratio);
    const HertzShape shape = hertz_from_semi_axes(a, b, {true, 80e3}, kSteel);
    const KalkerCoefficients k = kalker_coefficients(a, b, kSteel.poisson);
    const double g = kSteel.shear_modulus;
    ContactSolver solver;
    // On a finite grid the slip area is a fraction of an element; the theory's adhesion reaches to the trailing edge.
    constexpr double kLinear = 0.02;
    const auto force = [&](const Creepage& creepage) {
      return solver.solve(rolling(shape, 400, 100, creepage).problem);
    };
    EXPECT_NEAR(force({1e-6, 0.0, 0.0}).force_x / (-g * c * c * k.c11 * 1e-6), 1.0, kLinear);
    EXPECT_NEAR(force({0.0, 1e-6, 0.0}).force_y / (-g * c * c * k.c22 * 1e-6), 1.0, kLinear);
    EXPECT_NEAR(force({0.0, 0.0, 1e-4}).force_y / (-g * c * c * c * k.c23 * 1e-4), 1.0, kLinear);
  }
}

/// Rate of displacement difference du/dx of two half-spaces without lateral contraction under a strip's traction, the
/// principal value of -2/(pi G) int p(s)/(x - s) ds (Johnson 1985): x lies between two nodes, which makes it symmetric.
Vec2 displacement_rate(const StripTheory& theory, const StripTheory::Solution& strip, int node, int n,
                       double shear_modulus) {
  const double step = 2.0 * strip.half_length / n, x = -strip.half_length + node * step;
  Vec2 sum = Vec2::Zero();
  for (int k = 0; k < n; ++k) {
    const double s = -strip.half_length + (k + 0.5) * step;
    sum += theory.traction(strip, s) * (step / (x - s));
  }
  return -2.0 / (pi * shear_modulus) * sum;
}

TEST(Fastrip, DoesNotSlipInTheAdhesionAreaOfAWideContact) {
  // Without lateral contraction the theory is exact for strips that do not feel each other: the deformation takes up
  // all of the rigid slip, spin included, wherever it says adhesion.
  ContactProblem problem;
  problem.material.poisson_1 = problem.material.poisson_2 = 0.0;
  const double a = 1e-3, b = 50e-3;
  const Creepage creepage{5e-4, -4e-4, 0.5};
  const StripTheory theory(problem, creepage, 0.3, 40e3, {a, b}, 1.0);
  constexpr int kNodes = 20000;
  for (const double y : {-2e-3, -1e-3, 0.0, 1e-3}) {
    SCOPED_TRACE("y = " + std::to_string(y));
    const StripTheory::Solution strip = theory.solve(a, y, 0.0);
    ASSERT_FALSE(strip.full_slip);
    EXPECT_NEAR(std::hypot(strip.kappa, strip.lambda), 1.0, 1e-12);
    for (const int node : {11000, 13000, 17000, 19000}) {
      const double x = -a + node * 2.0 * a / kNodes;
      ASSERT_TRUE(strip.adheres(x));
      const Vec2 rigid(creepage.xi - creepage.phi * y, creepage.eta + creepage.phi * x);
      const Vec2 slip = rigid - displacement_rate(theory, strip, node, kNodes, kSteel.shear_modulus);
      EXPECT_LT(slip.norm(), 2e-3 * rigid.norm());
    }
    // Where adhesion ends friction is exhausted.
    const double last = 2.0 * strip.shift - a;
    EXPECT_NEAR(theory.traction(strip, last).norm(), theory.greatest() * std::sqrt(a * a - last * last) / a,
                1e-6 * theory.greatest());
  }
}

TEST(Fastrip, RegularWhereTheFormulaDividesByZero) {
  // Scaled spin of exactly one: root of the quadratic equation that has become linear.
  ContactProblem problem;
  const EquivalentEllipse ellipse{6e-3, 4e-3};
  const double g = kSteel.shear_modulus, c23 = kalker_coefficients(6e-3, 4e-3, kSteel.poisson).c23;
  const double bound = 0.3 * 1.5 * 80e3 / (pi * 24e-6), phi = -2.0 * bound * pi / (3.0 * g * std::sqrt(24e-6) * c23);
  const auto shift = [&](double spin) {
    return StripTheory(problem, {0.0, 1e-4, spin}, 0.3, 80e3, ellipse, 1.0).solve(6e-3, 0.0, 0.0).shift;
  };
  EXPECT_GT(shift(phi), 0.0);
  EXPECT_NEAR(shift(phi), 0.5 * (shift(phi * (1.0 - 1e-6)) + shift(phi * (1.0 + 1e-6))), 1e-6 * shift(phi));
  // No creepage in the middle strip under pure spin: no slip area, and a finite traction.
  const StripTheory pure_spin(problem, {0.0, 0.0, 0.3}, 0.3, 80e3, ellipse, 1.0);
  const StripTheory::Solution middle = pure_spin.solve(6e-3, 0.0, 0.0);
  EXPECT_EQ(middle.shift, 0.0);
  EXPECT_TRUE(pure_spin.traction(middle, 0.0).allFinite());
}

TEST(Fastrip, IsCloserToFullTheoryThanFastsimUnderPureCreepage) {
  const HertzShape shape = hertz_from_semi_axes(5e-3, 5e-3, {true, 80e3}, kSteel);
  const double unit = 0.3 * 80e3 / (kSteel.shear_modulus * 25e-6 * 4.0);
  double fastrip_error = 0.0, fastsim_error = 0.0;
  for (const double share : {0.4, 0.8, 1.2}) {
    OwnedProblem owned = rolling(shape, 30, 30, {share * unit, 0.0, 0.0});
    owned.problem.normal_model = NormalModel::full;
    ContactSolver solver;
    const auto force = [&](TangentialModel model) {
      owned.problem.tangential_model = model;
      return solver.solve(owned.problem).force_x;
    };
    const double full = force(TangentialModel::full);
    fastrip_error = std::max(fastrip_error, std::abs(force(TangentialModel::fastrip) / full - 1.0));
    fastsim_error = std::max(fastsim_error, std::abs(force(TangentialModel::fastsim) / full - 1.0));
  }
  EXPECT_LT(fastrip_error, 0.03);
  EXPECT_LT(fastrip_error, 0.5 * fastsim_error);
}

TEST(Fastrip, SlopeReductionTurnsDirectionsOnly) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 80e3}, kSteel);
  ContactSolver solver;
  const auto solve = [&](const Creepage& creepage, double k0) {
    OwnedProblem owned = rolling(shape, 60, 40, creepage);
    owned.problem.fastsim = {k0, 0.3, 0.9};
    return solver.solve(owned.problem);
  };
  // Under pure creepage there is one direction.
  for (const double xi : {1e-5, 5e-4, 0.05}) {
    const ContactSolution whole = solve({xi, 0.0, 0.0}, 1.0), reduced = solve({xi, 0.0, 0.0}, 0.33);
    EXPECT_NEAR(reduced.force_x / whole.force_x, 1.0, 1e-12) << xi;
  }
  // Under spin tractions keep their size, and some their direction no longer.
  const ContactSolution whole = solve({8e-4, -6e-4, 0.4}, 1.0), reduced = solve({8e-4, -6e-4, 0.4}, 0.33);
  double largest_turn = 0.0;
  for (std::size_t i = 0; i < whole.pressure.size(); ++i) {
    const Vec2 p(whole.traction_x[i], whole.traction_y[i]), q(reduced.traction_x[i], reduced.traction_y[i]);
    ASSERT_NEAR(p.norm(), q.norm(), 1e-9 * whole.max_pressure) << i;
    largest_turn = std::max(largest_turn, (p - q).norm());
  }
  EXPECT_GT(largest_turn, 1e-3 * whole.max_pressure);
  EXPECT_GT(std::hypot(reduced.force_x, reduced.force_y), 0.9 * std::hypot(whole.force_x, whole.force_y));
}

/// Bodies that touch in some elements of a row only: pressures of an ellipse, less where `touches` says no.
template <class Touches>
ContactSolution with_holes(const HertzShape& shape, TangentialModel model, const Touches& touches) {
  OwnedProblem owned = rolling(shape, 40, 40, {4e-4, 0.0, 0.0});
  owned.problem.tangential_model = model;
  owned.problem.settings.max_coupling = 1;
  ContactSolver solver;
  ContactSolution solution = solver.solve_normal(owned.problem);
  const Grid2& grid = owned.problem.grid;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix)
      if (const std::size_t i = grid.index(ix, iy); solution.pressure[i] > 0.0 && !touches(ix, iy)) {
        solution.pressure[i] = 0.0;
        solution.state[i] = ElementState::exterior;
      }
  solver.solve_tangential(owned.problem, solution);
  EXPECT_EQ(solution.status, Status::ok);
  return solution;
}

TEST(Fastrip, RowsWithHolesAreOneStrip) {
  // Rough bodies: elements that do not touch lie all over the contact. What is left deforms as one.
  const HertzShape shape = hertz_from_semi_axes(5e-3, 5e-3, {true, 80e3}, kSteel);
  const auto rough = [](int ix, int iy) { return (7 * ix + 3 * iy) % 5 != 0; };
  const ContactSolution exact = with_holes(shape, TangentialModel::full, rough),
                        strips = with_holes(shape, TangentialModel::fastrip, rough);
  // Strips of the runs between holes: 2.1 times the exact force.
  EXPECT_NEAR(strips.force_x / exact.force_x, 1.0, 0.15);
}

TEST(Fastrip, PartsOfAPatchInARowAreStripsOfTheirOwn) {
  const HertzShape shape = hertz_from_semi_axes(5e-3, 5e-3, {true, 80e3}, kSteel);
  ContactSolver solver;
  OwnedProblem owned = rolling(shape, 20, 20, {4e-4, 0.0, 0.0});
  const ContactSolution normal = solver.solve_normal(owned.problem);
  // The same ellipse twice in a row, as one patch of two parts.
  const Grid2 one = owned.problem.grid;
  ContactProblem pair = owned.problem;
  pair.grid.nx *= 2;
  pair.hertz.reset();
  pair.sub_patches.count = 2;
  pair.sub_patches.part.assign(pair.grid.size(), 0);
  pair.sub_patches.coupling = {1.0, 0.0, 0.0, 1.0};
  ContactSolution both;
  both.pressure.assign(pair.grid.size(), 0.0);
  for (int iy = 0; iy < one.ny; ++iy)
    for (int ix = 0; ix < pair.grid.nx; ++ix) {
      const std::size_t i = pair.grid.index(ix, iy);
      both.pressure[i] = normal.pressure[one.index(ix % one.nx, iy)];
      pair.sub_patches.part[i] = ix < one.nx ? 1 : 2;
    }
  solve_fastsim(pair, both);
  for (int iy = 0; iy < one.ny; ++iy)
    for (int ix = 0; ix < one.nx; ++ix)
      ASSERT_NEAR(both.traction_x[pair.grid.index(ix, iy)], both.traction_x[pair.grid.index(ix + one.nx, iy)],
                  1e-9 * normal.max_pressure);
}

}  // namespace
}  // namespace treadmark::kalker
