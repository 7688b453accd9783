// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Small contacts of any kind, solved by the solvers and by brute force. TREADMARK_DIFFERENTIAL of the environment says
// how many, TREADMARK_DIFFERENTIAL_SEED from which one: a contact depends on its number alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/brute_contact.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::BruteSolution;
using testing::Coefficients;
using testing::OwnedProblem;

constexpr double kEps = 1e-9;
/// The solvers stop where the estimated error of tractions is below eps of their rms; elements at the border of
/// contact, adhesion and slip make the largest error larger than that, and bodies that act on each other repeat it by
/// their rounds.
constexpr double kTolerance = 1e3 * kEps, kCoupledTolerance = 1e4 * kEps;
/// Of the quadrature beside the closed forms.
constexpr double kQuadratureTolerance = 1e-6;
constexpr int kUsual = 400, kQuadratureEvery = 40;

long from_environment(const char* name, long usual) {
  const char* wanted = std::getenv(name);
  return wanted != nullptr ? std::atol(wanted) : usual;
}

/// A contact of at most 8 x 8 elements.
OwnedProblem random_contact(unsigned long number) {
  std::mt19937_64 generator(number);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(generator); };
  const auto power = [&](double a, double b) { return std::pow(10.0, between(a, b)); };
  const auto one_in = [&](double n) { return between(0.0, n) < 1.0; };
  Grid2 grid;
  grid.nx = 1 + static_cast<int>(between(0.0, 8.0));
  grid.ny = 1 + static_cast<int>(between(0.0, 8.0));
  grid.dx = power(-4.0, -3.0);
  grid.dy = grid.dx * power(-0.3, 0.3);
  grid.x0 = -0.5 * (grid.nx - 1) * grid.dx * between(0.0, 2.0);
  grid.y0 = -0.5 * (grid.ny - 1) * grid.dy * between(0.0, 2.0);
  const double depth = grid.dx * power(-4.0, -2.0), a = power(-1.0, 1.0), b = power(-1.0, 1.0),
               rough = between(0.0, 0.5);
  std::vector<double> gap;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x = grid.x(ix) / (4.0 * grid.dx), y = grid.y(iy) / (4.0 * grid.dy);
      gap.push_back(one_in(30) ? std::nan("") : depth * (a * x * x + b * y * y + rough * between(0.0, 1.0)));
    }
  OwnedProblem owned(grid, std::move(gap));
  ContactProblem& p = owned.problem;
  p.settings.eps = kEps;
  p.material.shear_modulus_1 = p.material.shear_modulus_2 = power(8.0, 11.5);
  p.material.poisson_1 = p.material.poisson_2 = between(0.0, 0.5);
  if (one_in(3)) {
    p.material.shear_modulus_1 *= power(-1.0, 0.0);
    p.material.poisson_1 = between(0.0, 0.5);
  }
  const double least = [&] {
    double value = std::numeric_limits<double>::infinity();
    for (const double h : owned.gap) value = std::fmin(value, h);
    return std::isfinite(value) ? value : 0.0;
  }();
  p.force_prescribed = one_in(2);
  p.approach = least + depth * between(-0.02, 1.0);
  p.normal_force = p.material.shear_modulus_1 * depth * grid.dx * power(-1.0, 1.0);
  constexpr Regime kRegimes[] = {Regime::frictionless, Regime::shift, Regime::transient, Regime::steady};
  p.regime = kRegimes[static_cast<int>(between(0.0, 4.0))];
  p.friction.kinetic = power(-2.0, 0.0);
  p.rolling.chi = one_in(2) ? 0.0 : std::numbers::pi;
  p.rolling.step = grid.dx * between(0.3, 1.0);
  // From adhesion nearly everywhere to slip everywhere.
  const double size = 4.0 * grid.dx,
               slip = p.friction.kinetic * depth * power(-2.0, 0.7) / (p.regime == Regime::shift ? 1.0 : size);
  const double angle = between(0.0, 2.0 * std::numbers::pi);
  p.creepage = {slip * std::cos(angle), slip * std::sin(angle), one_in(2) ? 0.0 : slip / size * between(-1.0, 1.0),
                size * between(-0.2, 0.2), size * between(-0.2, 0.2)};
  return owned;
}

double difference(const std::vector<double>& a, const Eigen::VectorXd& b) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < b.size(); ++i) most = std::max(most, std::abs(a[static_cast<std::size_t>(i)] - b[i]));
  return most;
}

TEST(Differential, SmallContactsAgreeWithBruteForce) {
  const long count = from_environment("TREADMARK_DIFFERENTIAL", kUsual);
  const auto first = static_cast<unsigned long>(from_environment("TREADMARK_DIFFERENTIAL_SEED", 1));
  const auto start = std::chrono::steady_clock::now();
  ContactSolver solver;
  long compared = 0, apart = 0, unsolved = 0, undecided = 0, adhesion = 0, slip = 0;
  double worst = 0.0;
  for (unsigned long number = first; number < first + static_cast<unsigned long>(count); ++number) {
    const OwnedProblem owned = random_contact(number);
    const ContactProblem& problem = owned.problem;
    SCOPED_TRACE("contact " + std::to_string(number));
    solver.reset();
    const ContactSolution s = solver.solve(problem);
    const bool quadrature = number % kQuadratureEvery == 0;
    const auto brute_at = [&](double approach) {
      return testing::solve_by_force(problem, approach,
                                     quadrature ? Coefficients::quadrature : Coefficients::closed_form);
    };
    if (s.status == Status::no_contact) {
      ++apart;
      if (!problem.force_prescribed) {
        EXPECT_EQ(brute_at(problem.approach).pressure.maxCoeff(), 0.0);
      }
      continue;
    }
    if (s.status != Status::ok) {  // it says so
      ++unsolved;
      EXPECT_FALSE(s.normal.message.empty() && s.tangential.message.empty());
      continue;
    }
    const BruteSolution brute = brute_at(s.approach);
    if (!brute.found) {
      ++undecided;
      continue;
    }
    const bool coupled = combine(problem.material).difference != 0.0;
    const double tolerance = (coupled ? kCoupledTolerance : kTolerance) + (quadrature ? kQuadratureTolerance : 0.0);
    const double scale = brute.pressure.maxCoeff();
    const double bound = std::max(problem.friction.kinetic, coupled ? 1.0 : 0.0) * scale;
    const double p_apart = difference(s.pressure, brute.pressure) / scale;
    EXPECT_LE(p_apart, tolerance);
    EXPECT_NEAR(s.force_n, brute.pressure.sum() * problem.grid.cell_area(),
                tolerance * scale * problem.grid.cell_area() * 64);
    if (problem.force_prescribed) {
      EXPECT_NEAR(s.force_n, problem.normal_force, tolerance * problem.normal_force);
    }
    double q_apart = 0.0;
    if (problem.regime != Regime::frictionless) {
      q_apart =
          std::max(difference(s.traction_x, brute.traction_x), difference(s.traction_y, brute.traction_y)) / bound;
      EXPECT_LE(q_apart, tolerance);
      adhesion += s.elements_adhesion;
      slip += s.elements_slip;
    }
    worst = std::max({worst, p_apart / tolerance, q_apart / tolerance});
    ++compared;
    if (HasFailure() && count > kUsual) break;  // of a campaign the first find is enough
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf(
      "%ld contacts, %.0f a second: %ld compared, %ld apart, %ld unsolved, %ld undecided; worst %.2g of the "
      "tolerance\n",
      count, static_cast<double>(count) / seconds, compared, apart, unsolved, undecided, worst);
  constexpr long kFew = 20;  // one in so many
  EXPECT_LE(unsolved, count / kFew + 1);
  EXPECT_LE(undecided, count / kFew + 1);
  if (count >= kUsual) {
    EXPECT_GT(compared, count / 2);
    EXPECT_GT(adhesion, count);  // both kinds of elements were put to the test
    EXPECT_GT(slip, count);
  }
}

}  // namespace
}  // namespace treadmark::kalker
