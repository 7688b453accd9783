// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::hertzian;
using testing::kSteel;
using testing::OwnedProblem;

ContactSolution solve(const ContactProblem& problem) {
  NormalSolver solver;
  ContactSolution solution;
  solver.solve(problem, solution);
  return solution;
}

double rms(const std::vector<double>& field) {
  return std::sqrt(std::inner_product(field.begin(), field.end(), field.begin(), 0.0) /
                   static_cast<double>(field.size()));
}

double rms_difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return rms(a);
}

/// Displacement by a sum over all pairs of elements.
std::vector<double> direct_displacement(const Grid2& grid, const std::vector<double>& p) {
  std::vector<double> u(p.size());
  for (int j = 0; j < static_cast<int>(p.size()); ++j) {
    if (p[static_cast<std::size_t>(j)] == 0.0) continue;
    for (int i = 0; i < static_cast<int>(p.size()); ++i)
      u[static_cast<std::size_t>(i)] +=
          influence(Component::nn, (i % grid.nx - j % grid.nx) * grid.dx, (i / grid.nx - j / grid.nx) * grid.dy,
                    grid.dx, grid.dy, kSteel.poisson) /
          kSteel.shear_modulus * p[static_cast<std::size_t>(j)];
  }
  return u;
}

/// Brute force: projected Gauss-Seidel on the full matrix for a given approach.
std::vector<double> projected_gauss_seidel(const ContactProblem& problem, double approach) {
  const Grid2& grid = problem.grid;
  const int n = static_cast<int>(grid.size());
  std::vector<double> p(grid.size());
  const auto c = [&](int i, int j) {
    return influence(Component::nn, (i % grid.nx - j % grid.nx) * grid.dx, (i / grid.nx - j / grid.nx) * grid.dy,
                     grid.dx, grid.dy, kSteel.poisson) /
           kSteel.shear_modulus;
  };
  std::vector<double> matrix;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) matrix.push_back(c(i, j));
  for (int sweep = 0; sweep < 4000; ++sweep)
    for (int i = 0; i < n; ++i) {
      const auto row = static_cast<std::size_t>(i);
      if (std::isnan(problem.gap[row])) continue;
      double e = problem.gap[row] - approach;
      for (int j = 0; j < n; ++j)
        e += matrix[row * static_cast<std::size_t>(n) + static_cast<std::size_t>(j)] * p[static_cast<std::size_t>(j)];
      p[row] = std::max(0.0, p[row] - e / matrix[row * static_cast<std::size_t>(n + 1)]);
    }
  return p;
}

/// A paraboloid with bumps: several contact regions of irregular shape.
OwnedProblem rough_problem(unsigned seed) {
  const Grid2 grid{-6e-3, -4e-3, 1e-3, 0.9e-3, 13, 10};
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> gap;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix)
      gap.push_back(0.5 * (grid.x(ix) * grid.x(ix) + grid.y(iy) * grid.y(iy)) + 4e-6 * uniform(generator));
  return {grid, std::move(gap)};
}

class RoughSurfaces : public ::testing::TestWithParam<unsigned> {};

TEST_P(RoughSurfaces, MatchBruteForceForAGivenApproach) {
  OwnedProblem owned = rough_problem(GetParam());
  owned.gap[70] = std::nan("");  // excluded although in the middle
  owned.problem.force_prescribed = false;
  owned.problem.approach = 9e-6;
  owned.problem.settings.eps = 1e-8;
  const ContactSolution solution = solve(owned.problem);
  const auto expected = projected_gauss_seidel(owned.problem, 9e-6);
  ASSERT_EQ(solution.status, Status::ok);
  EXPECT_EQ(solution.pressure[70], 0.0);
  EXPECT_LT(rms_difference(solution.pressure, expected), 1e-6 * rms(expected));
}

TEST_P(RoughSurfaces, MatchBruteForceForAGivenForce) {
  OwnedProblem owned = rough_problem(GetParam());
  owned.problem.normal_force = 2000.0;
  owned.problem.settings.eps = 1e-8;
  const ContactSolution solution = solve(owned.problem);
  EXPECT_NEAR(solution.force_n, 2000.0, 1e-8);
  // The approach found must give the same pressures, and with them the force, by brute force.
  const auto expected = projected_gauss_seidel(owned.problem, solution.approach);
  EXPECT_LT(rms_difference(solution.pressure, expected), 1e-5 * rms(expected));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RoughSurfaces, ::testing::Values(1u, 2u, 3u));

TEST(NormalSolver, SatisfiesContactConditionsOnTheWholeGrid) {
  OwnedProblem owned = rough_problem(17);
  owned.problem.normal_force = 5000.0;
  const ContactSolution solution = solve(owned.problem);
  const auto u = direct_displacement(owned.problem.grid, solution.pressure);
  const double tolerance = 1e-4 * solution.approach;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double e = owned.gap[i] - solution.approach + u[i];
    ASSERT_GE(solution.pressure[i], 0.0);
    if (solution.pressure[i] > 0.0) {
      ASSERT_NEAR(e, 0.0, tolerance);
      ASSERT_EQ(solution.state[i], ElementState::adhesion);
      ASSERT_NEAR(solution.displacement_n[i], u[i], tolerance);
    } else {
      ASSERT_GE(e, -tolerance);
      ASSERT_EQ(solution.state[i], ElementState::exterior);
    }
  }
}

/// Two equal balls pressed against a plane, far apart; the second one is held back by `lag`.
OwnedProblem two_balls(double lag) {
  const Grid2 grid{-20e-3, -5.2e-3, 0.4e-3, 0.4e-3, 101, 27};
  std::vector<double> gap;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double y2 = grid.y(iy) * grid.y(iy), left = grid.x(ix) + 14e-3, right = grid.x(ix) - 14e-3;
      gap.push_back(std::min(2.0 * (left * left + y2), lag + 2.0 * (right * right + y2)));
    }
  return {grid, std::move(gap)};
}

double force_right_of_centre(const OwnedProblem& owned, const ContactSolution& solution) {
  const Grid2& grid = owned.problem.grid;
  double sum = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (static_cast<int>(i) % grid.nx > grid.nx / 2) sum += solution.pressure[i];
  return sum * grid.cell_area();
}

TEST(NormalSolver, TwoRegionsShareTheLoad) {
  OwnedProblem owned = two_balls(0.0);
  owned.problem.normal_force = 40e3;
  const ContactSolution solution = solve(owned.problem);
  EXPECT_NEAR(force_right_of_centre(owned, solution), 20e3, 20e3 * 1e-5);
  // Each ball sinks by its own Hertz approach and by the other one's load, seen as a point.
  const HertzShape one = hertz_from_curvatures(2.0, 2.0, {true, 20e3}, kSteel);
  const double by_the_other = (1.0 - kSteel.poisson) / (std::numbers::pi * kSteel.shear_modulus) * 20e3 / 28e-3;
  EXPECT_NEAR(solution.approach, one.approach + by_the_other, 3e-3 * one.approach);
}

// The bodies would lie in each other up to 1.41 semi-axes from the middle: beyond the box in which pressures are
// sought, which is that of the contact with some elements round it.
TEST(NormalSolver, DisplacesWhatWouldInterpenetrate) {
  const HertzShape shape = hertz_from_semi_axes(4e-3, 4e-3, {true, 5e4}, kSteel);
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, 41, 41, 1.6));
  owned.problem.hertz = shape;
  const Grid2& grid = owned.problem.grid;
  const ContactSolution solution = solve(owned.problem);
  const auto u = direct_displacement(grid, solution.pressure);
  int beside = 0;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      if (!(owned.gap[i] < solution.approach)) continue;
      EXPECT_NEAR(solution.displacement_n[i], u[i], 1e-9 * solution.approach) << ix << ' ' << iy;
      beside += std::max(std::abs(grid.x(ix)), std::abs(grid.y(iy))) > 1.3 * shape.semi_axis_x ? 1 : 0;
    }
  EXPECT_GT(beside, 40);
}

TEST(NormalSolver, FindsASecondRegionOutsideTheFirstBox) {
  // The second ball touches only after most of the load is on the first one, far outside the first estimate.
  OwnedProblem owned = two_balls(30e-6);
  owned.problem.normal_force = 20e3;
  const ContactSolution solution = solve(owned.problem);
  const double right = force_right_of_centre(owned, solution);
  EXPECT_GT(right, 1e3);
  EXPECT_LT(right, 9e3);
  const auto u = direct_displacement(owned.problem.grid, solution.pressure);
  for (std::size_t i = 0; i < u.size(); ++i)
    ASSERT_GE(owned.gap[i] - solution.approach + u[i], -1e-4 * solution.approach);
}

TEST(NormalSolver, ForceAndApproachAreTwoSidesOfOneProblem) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 1e5}, kSteel);
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, 40, 40, 1.2));
  const ContactSolution by_force = solve(owned.problem);
  owned.problem.force_prescribed = false;
  owned.problem.approach = by_force.approach;
  const ContactSolution by_approach = solve(owned.problem);
  EXPECT_NEAR(by_approach.force_n / by_force.force_n, 1.0, 1e-5);
  EXPECT_LT(rms_difference(by_approach.pressure, by_force.pressure), 1e-4 * rms(by_force.pressure));
}

TEST(NormalSolver, ReachesTheAccuracyItPromises) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 1e5}, kSteel);
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, 45, 45, 1.3));
  const ContactSolution coarse = solve(owned.problem);
  owned.problem.settings.eps = 1e-11;
  const ContactSolution exact = solve(owned.problem);
  EXPECT_LT(rms_difference(coarse.pressure, exact.pressure), 1e-5 * rms(exact.pressure));
  EXPECT_NEAR(coarse.approach / exact.approach, 1.0, 1e-6);
}

TEST(NormalSolver, WarmStartGivesTheSameResult) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 1e5}, kSteel);
  const Grid2 grid = hertz_grid(shape, 44, 44, 1.3);
  OwnedProblem first = hertzian(shape, grid);
  NormalSolver solver;
  ContactSolution solution;
  solver.solve(first.problem, solution);

  // The next grid is larger and displaced by whole elements, the load a little higher and off centre.
  Grid2 larger{grid.x(-3), grid.y(-2), grid.dx, grid.dy, 50, 49};
  OwnedProblem next = hertzian(shape, larger);
  for (std::size_t i = 0; i < next.gap.size(); ++i) next.gap[i] += 1e-3 * larger.x(static_cast<int>(i) % larger.nx);
  next.problem.normal_force = 1.05e5;
  ContactSolution warm;
  solver.solve(next.problem, warm);
  const ContactSolution cold = solve(next.problem);
  EXPECT_LT(rms_difference(warm.pressure, cold.pressure), 2e-5 * rms(cold.pressure));
  EXPECT_NEAR(warm.approach / cold.approach, 1.0, 2e-6);

  // Solving the same problem again costs nothing but checking it.
  ContactSolution again;
  solver.solve(next.problem, again);
  EXPECT_EQ(again.normal.iterations, 0);
  solver.reset();
  solver.solve(next.problem, again);
  EXPECT_EQ(again.pressure, cold.pressure) << "after reset nothing of the history is left";
}

TEST(NormalSolver, RecallsTheLastProblemFromRestAndNoOther) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 1e5}, kSteel);
  const OwnedProblem first = hertzian(shape, hertz_grid(shape, 40, 40, 1.2));
  NormalSolver solver;
  const auto from_rest = [&](const ContactProblem& problem) {
    ContactSolution solution;
    solver.reset();
    solver.solve(problem, solution);
    return solution;
  };
  const ContactSolution before = from_rest(first.problem);
  EXPECT_EQ(from_rest(first.problem).pressure, before.pressure);
  // Whatever differs by a little is another problem, whose answer a solver without a past gives too.
  const auto expect_solved = [&](const char* what, auto&& change) {
    OwnedProblem other = hertzian(shape, first.problem.grid);
    change(other);
    from_rest(first.problem);
    const ContactSolution found = from_rest(other.problem);
    EXPECT_EQ(found.pressure, solve(other.problem).pressure) << what;
    EXPECT_NE(found.pressure, before.pressure) << what;
  };
  expect_solved("gap", [](OwnedProblem& p) { p.gap[p.gap.size() / 2 + 20] += 1e-6; });
  expect_solved("force", [](OwnedProblem& p) { p.problem.normal_force *= 1.001; });
  expect_solved("material", [](OwnedProblem& p) { p.problem.material.shear_modulus_1 *= 1.001; });
  expect_solved("sheet", [](OwnedProblem& p) { p.problem.material.sheet_flexibility = 1e-15; });
  expect_solved("accuracy", [](OwnedProblem& p) { p.problem.settings.eps = 1e-9; });
}

TEST(NormalSolver, WorkDoesNotDependOnThePotentialArea) {
  const HertzShape shape = hertz_from_semi_axes(5e-3, 5e-3, {true, 1e5}, kSteel);
  const Grid2 tight = hertz_grid(shape, 41, 41, 1.2);
  Grid2 wide = tight;
  wide.x0 -= 60 * tight.dx;
  wide.y0 -= 60 * tight.dy;
  wide.nx = wide.ny = 161;
  const ContactSolution a = solve(hertzian(shape, tight).problem), b = solve(hertzian(shape, wide).problem);
  EXPECT_NEAR(b.approach / a.approach, 1.0, 1e-6);
  EXPECT_EQ(b.elements_contact, a.elements_contact);
  EXPECT_LE(b.normal.iterations, a.normal.iterations + 3);
}

TEST(NormalSolver, MirroredGapGivesMirroredPressure) {
  const OwnedProblem owned = rough_problem(5);
  OwnedProblem mirrored = owned;
  const Grid2& grid = owned.problem.grid;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) mirrored.gap[grid.index(ix, iy)] = owned.gap[grid.index(ix, grid.ny - 1 - iy)];
  ContactProblem one = owned.problem, other = mirrored.problem;
  one.gap = owned.gap;
  one.normal_force = other.normal_force = 3000.0;
  one.settings.eps = other.settings.eps = 1e-9;
  const ContactSolution a = solve(one), b = solve(other);
  EXPECT_NEAR(a.approach, b.approach, 1e-9 * a.approach);
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix)
      ASSERT_NEAR(a.pressure[grid.index(ix, iy)], b.pressure[grid.index(ix, grid.ny - 1 - iy)], 1e-7 * a.max_pressure);
}

TEST(NormalSolver, ScalesWithLengthAndStiffness) {
  OwnedProblem owned = rough_problem(5);
  owned.problem.normal_force = 3000.0;
  const ContactSolution plain = solve(owned.problem);
  constexpr double kLength = 1000.0, kStiffness = 1e-9;
  OwnedProblem scaled = owned;
  for (double& h : scaled.gap) h *= kLength;
  Grid2& grid = scaled.problem.grid;
  for (double* length : {&grid.x0, &grid.y0, &grid.dx, &grid.dy}) *length *= kLength;
  scaled.problem.material.shear_modulus_1 *= kStiffness;
  scaled.problem.material.shear_modulus_2 *= kStiffness;
  scaled.problem.normal_force *= kLength * kLength * kStiffness;
  const ContactSolution other = solve(scaled.problem);
  EXPECT_NEAR(other.approach / kLength / plain.approach, 1.0, 1e-6);
  EXPECT_NEAR(other.max_pressure / kStiffness / plain.max_pressure, 1.0, 1e-5);
  EXPECT_EQ(other.elements_contact, plain.elements_contact);
}

TEST(NormalSolver, DependsOnTheMaterialsOnlyThroughTheirCombination) {
  const HertzShape shape = hertz_from_semi_axes(5e-3, 5e-3, {true, 1e5}, kSteel);
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, 21, 21, 1.2));
  owned.problem.material = Material{20e9, 82e9, 0.35, 0.28};
  const CombinedMaterial pair = combine(owned.problem.material);
  const ContactSolution mixed = solve(owned.problem);
  owned.problem.material = Material{pair.shear_modulus, pair.shear_modulus, pair.poisson, pair.poisson};
  EXPECT_NEAR(solve(owned.problem).approach / mixed.approach, 1.0, 1e-12);
}

TEST(NormalSolver, LineContactSinksAsTheoryOfALongStrip) {
  const double half_length = 0.1, a = 1e-3;
  const HertzShape shape = hertz_line_from_semi_axis(a, half_length, {true, 35780.0}, kSteel);
  const ContactSolution solution = solve(hertzian(shape, hertz_grid(shape, 161, 1, 1.2)).problem);
  // Elliptic pressure on a long strip: 2 f / (pi e*) (ln(4 L / a) + 1/2) at its middle.
  const double per_length = 35780.0 / (2.0 * half_length), e_star = kSteel.shear_modulus / (1.0 - kSteel.poisson);
  const double expected = 2.0 * per_length / (std::numbers::pi * e_star) * (std::log(4.0 * half_length / a) + 0.5);
  EXPECT_NEAR(solution.approach / expected, 1.0, 5e-5);
}

TEST(NormalSolver, AssumedPressuresComeFromTheEllipse) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 1e5}, kSteel);
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, 41, 41, 1.1));
  owned.problem.hertz = shape;
  owned.problem.normal_model = NormalModel::elliptic;
  const ContactSolution elliptic = solve(owned.problem);
  EXPECT_EQ(elliptic.max_pressure, hertz_max_pressure(shape));
  EXPECT_EQ(elliptic.approach, shape.approach);
  owned.problem.normal_model = NormalModel::parabolic;
  const ContactSolution parabolic = solve(owned.problem);
  EXPECT_NEAR(parabolic.max_pressure / elliptic.max_pressure, 4.0 / 3.0, 1e-12);
  EXPECT_EQ(parabolic.elements_contact, elliptic.elements_contact);
  owned.problem.hertz.reset();
  EXPECT_THROW(solve(owned.problem), Error);
}

TEST(NormalSolver, ReportsThatThereIsNoContact) {
  OwnedProblem owned = rough_problem(1);
  owned.problem.normal_force = 0.0;
  EXPECT_EQ(solve(owned.problem).status, Status::no_contact);
  owned.problem.force_prescribed = false;
  owned.problem.approach = -1e-3;
  const ContactSolution solution = solve(owned.problem);
  EXPECT_EQ(solution.status, Status::no_contact);
  EXPECT_EQ(solution.approach, -1e-3);
  EXPECT_EQ(solution.max_pressure, 0.0);
  owned.problem.approach = 1e-3;
  std::fill(owned.gap.begin(), owned.gap.end(), std::nan(""));
  EXPECT_EQ(solve(owned.problem).status, Status::no_contact);
}

TEST(NormalSolver, ReportsThatItDidNotConverge) {
  OwnedProblem owned = rough_problem(1);
  owned.problem.normal_force = 3000.0;
  owned.problem.settings.max_iterations = 1;
  const ContactSolution solution = solve(owned.problem);
  EXPECT_EQ(solution.status, Status::not_converged);
  EXPECT_FALSE(solution.normal.message.empty());
  EXPECT_GT(solution.normal.residual, owned.problem.settings.eps);
}

TEST(NormalSolver, SingleElementSinksByItsOwnCoefficient) {
  OwnedProblem owned(Grid2{0, 0, 1e-3, 1e-3, 1, 1}, {2e-6});
  owned.problem.normal_force = 1000.0;
  const ContactSolution solution = solve(owned.problem);
  const double own = influence(Component::nn, 0, 0, 1e-3, 1e-3, kSteel.poisson) / kSteel.shear_modulus;
  EXPECT_NEAR(solution.approach, 2e-6 + own * 1e9, 1e-15);
}

TEST(NormalSolver, RefusesInconsistentInput) {
  OwnedProblem owned = rough_problem(1);
  owned.problem.normal_force = 100.0;
  const auto refused = [&](auto change) {
    ContactProblem problem = owned.problem;
    change(problem);
    EXPECT_THROW(solve(problem), Error);
  };
  refused([](ContactProblem& p) { p.gap = p.gap.first(3); });
  refused([](ContactProblem& p) { p.grid.dx = 0.0; });
  refused([](ContactProblem& p) { p.material.shear_modulus_1 = -1.0; });
  refused([](ContactProblem& p) { p.material.poisson_2 = 0.7; });
  refused([](ContactProblem& p) { p.normal_force = -1.0; });
  refused([](ContactProblem& p) {
    p.force_prescribed = false;
    p.approach = std::nan("");
  });
  refused([](ContactProblem& p) { p.settings.eps = 0.0; });
}

}  // namespace
}  // namespace treadmark::kalker
